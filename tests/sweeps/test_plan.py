"""Plans: the cases they describe, and plans that describe none."""

import math

import pytest

import softlube
from softlube.sweeps.plan import make_plan, read_plan
from softlube.sweeps.work import content_key

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s", "load": "100 mN"}
TOML = """
[sweep]
accuracy = 0.01

[parameters]
radius = "2 mm"
young_modulus = "3 MPa"
viscosity = "2 Pa s"
load = "100 mN"
speed = "0.1 mm/s"
"""


def speeds(plan):
    return [case.inputs["speed"] for case in plan.cases]


def test_a_single_contact_is_the_contact():
    (case,) = make_plan(BALL).cases
    assert case.contact == softlube.Contact(**BALL)
    assert case.problem.beta_load == pytest.approx(softlube.Contact(**BALL).problem().beta_load, rel=1e-11)


def test_lists_ranges_and_the_product_last_axis_fastest():
    log = {"from": "25 um/s", "to": "1 mm/s", "count": 5}
    plan = make_plan({"load": ["18.6 mN", 0.2381], **{name: BALL[name] for name in BALL if name != "load"}, "speed": log})
    assert len(plan.cases) == 10
    assert speeds(plan)[:5] == pytest.approx([2.5e-5 * 40 ** (i / 4) for i in range(5)])
    assert [case.inputs["load"] for case in plan.cases] == pytest.approx([0.0186] * 5 + [0.2381] * 5)
    linear = make_plan(BALL | {"speed": log | {"spacing": "linear"}})
    assert speeds(linear)[2] == pytest.approx((2.5e-5 + 1e-3) / 2)


def test_zipped():
    plan = make_plan(BALL | {"load": [0.1, 0.2], "speed": ["1 mm/s", "2 mm/s"]}, combine="zip")
    assert [(case.inputs["load"], case.inputs["speed"]) for case in plan.cases] == [(0.1, 1e-3), (0.2, 2e-3)]
    with pytest.raises(softlube.InputError, match="load: has 2 values and another parameter 3"):
        make_plan(BALL | {"load": [0.1, 0.2], "speed": [1.0, 2.0, 3.0]}, combine="zip")


def test_columns_of_one_file_go_together(tmp_path):
    (tmp_path / "cases.csv").write_text("N [mN]; speed [mm/s]\n50; 0,1\n100; 0,2\n")
    columns = {"load": {"csv": "cases.csv", "column": "N"}, "speed": {"csv": "cases.csv"}}
    plan = make_plan(BALL | columns | {"viscosity": [1.0, 2.0]}, folder=tmp_path)
    assert [(c.inputs["viscosity"], c.inputs["load"], c.inputs["speed"]) for c in plan.cases] == [
        pytest.approx(row) for row in [(1, 0.05, 1e-4), (1, 0.1, 2e-4), (2, 0.05, 1e-4), (2, 0.1, 2e-4)]
    ]
    assert plan.sources == (tmp_path / "cases.csv",)


def test_contacts_of_equal_beta_are_one_problem():
    plan = make_plan(BALL | {"viscosity": ["2 Pa s", "1 Pa s", "0.7 Pa s"], "speed": [1e-4, 2e-4, 2e-4 / 0.7]}, combine="zip")
    assert len({case.problem for case in plan.cases}) == 1


def test_dimensionless_cases():
    plan = make_plan({"beta": {"from": 10, "to": 1000, "count": 3}, "cavitation": ["reynolds", "none"]})
    assert [case.problem.beta for case in plan.cases] == pytest.approx([10, 10, 100, 100, 1000, 1000])
    assert plan.cases[1].problem.cavitation == "none"
    assert plan.cases[0].contact is None


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"speed": []}, "speed: the list is empty"),
        ({"speed": "3 MPa"}, "speed: 3 MPa has the wrong dimension"),
        ({"speed": ["1 mm/s", "-1 mm/s"]}, "speed: expected a positive"),
        ({"speed": {"from": "1 mm/s"}}, "speed: expected a value, a list, a column or a range"),
        ({"speed": {"from": 1.0, "to": 2.0, "count": 1}}, "speed: count: expected a whole number from 2"),
        ({"speed": {"from": 1.0, "to": 2.0, "count": True}}, "speed: count"),
        ({"speed": {"from": 1.0, "to": 2.0, "count": 3, "spacing": "cubic"}}, "speed: spacing: expected 'log' or 'linear'"),
        ({"speed": {"csv": 3}}, "speed: csv: expected the name of a file"),
        ({"speed": {"csv": "none.csv"}}, "none.csv: the file does not exist"),
        ({"speed": {"csv": "a.csv", "colum": "v"}}, "speed: 'colum' is not known"),
        ({"friction": "1 N"}, "friction: no parameter of a contact"),
        ({"sped": "1 m/s"}, "sped: no parameter of a contact"),
        ({"beta": 10.0}, "beta, radius: give a dimensionless or a physical contact"),
        ({"indentation": "1 um"}, "load, indentation: are both given"),
        ({"cavitation": 3}, "cavitation: expected a text"),
        ({"speed": {"from": 1e-4, "to": 1e-3, "count": 99_999}, "load": [0.1, 0.2]}, "speed: the plan has 199998 cases"),
    ],
)
def test_no_plan(change, message):
    with pytest.raises(softlube.InputError, match=message):
        make_plan(BALL | change)


@pytest.mark.parametrize("options", [{"combine": "cross"}, {"accuracy": 3}, {"accuracy": "fine"}, {"accuracy": True}])
def test_settings_are_checked(options):
    with pytest.raises(softlube.InputError, match=next(iter(options))):
        make_plan(BALL, **options)


def test_a_file_with_a_byte_order_mark(tmp_path):
    path = tmp_path / "plan.toml"
    path.write_text("\ufeff" + TOML)
    plan = read_plan(path)
    assert plan.accuracy == 0.01
    assert len(plan.cases) == 1
    assert plan.sources == (path,)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('speed = "0.1 mm/s"', "speed = ", "plan.toml, line 10: no TOML"),
        ('speed = "0.1 mm/s"', 'speed = "0.1 mm"', "plan.toml, line 10: speed: 0.1 mm has the wrong dimension"),
        ('speed = "0.1 mm/s"', 'speed = "-0.1 mm/s"', "plan.toml, line 10: speed: expected a positive"),
        ('speed = "0.1 mm/s"', "", "speed: missing"),
        ('load = "100 mN"', 'load = "100"', "plan.toml, line 9: load: '100' has no unit"),
        ('load = "100 mN"', 'load = "1 N"\nload = "2 N"', "plan.toml, line 10: no TOML: Cannot overwrite"),
        ("accuracy = 0.01", "acuracy = 0.01", "plan.toml, line 3: 'acuracy' is no setting"),
        ("accuracy = 0.01", 'accuracy = "fine"', "plan.toml, line 3: accuracy: expected a number"),
        ("accuracy = 0.01", 'combine = "cross"', "plan.toml, line 3: combine: expected"),
        ("[parameters]", "[params]", "plan.toml, line 5: 'params' is not known here"),
        (TOML, "", "plan.toml, line 1: parameters: none are given; a contact needs radius"),
        (TOML, '[sweep]\nmotion = "squeeze"', "plan.toml, line 1: parameters: none are given; a squeeze film needs"),
        (TOML, "parameters = 3", r"plan.toml, line 1: 'parameters' must be a table"),
        ('speed = "0.1 mm/s"', 'speed = { csv = "c.csv" }', "c.csv, line 3: speed: 'x' under"),
    ],
)
def test_files_that_are_no_plan_name_the_line(tmp_path, old, new, message):
    (tmp_path / "c.csv").write_text("speed [mm/s]\n1\nx\n")
    path = tmp_path / "plan.toml"
    assert old in TOML
    path.write_text(TOML.replace(old, new))
    with pytest.raises(softlube.InputError, match=message):
        read_plan(path)


def test_absent_and_unreadable_plans(tmp_path):
    with pytest.raises(softlube.InputError, match="does not exist"):
        read_plan(tmp_path / "none.toml")
    (tmp_path / "latin.toml").write_bytes("# Größe".encode("latin-1"))
    with pytest.raises(softlube.InputError, match="not UTF-8"):
        read_plan(tmp_path / "latin.toml")


def test_ranges_end_where_they_should():
    values = speeds(make_plan(BALL | {"speed": {"from": 3e-5, "to": 7e-4, "count": 7}}))
    assert (values[0], values[-1]) == (3e-5, 7e-4)
    assert math.log(values[1] / values[0]) == pytest.approx(math.log(values[6] / values[5]))


def test_layers_and_oils_are_parameters_like_any_other():
    plan = make_plan(
        BALL
        | {"thickness": ["1 mm", "2 mm"], "base": ["bonded", "frictionless"], "poisson_ratio": 0.45, "pressure_viscosity": 2e-8}
    )
    assert len(plan.cases) == 4
    assert len({content_key(case.task, 1e-3) for case in plan.cases}) == 4
    assert plan.cases[0].contact == softlube.Contact(
        **BALL, thickness="1 mm", poisson_ratio=0.45, base="bonded", pressure_viscosity="20 GPa^-1"
    )


@pytest.mark.parametrize("name", ["thickness", "base", "viscosity_law"])
def test_a_dimensionless_case_takes_no_layer_and_no_oil(name):
    value = {"thickness": "1 mm", "base": "bonded", "viscosity_law": "barus"}[name]
    with pytest.raises(softlube.InputError, match=f"beta, {name}: give a dimensionless or a physical contact"):
        make_plan({"beta": 100, name: value})
