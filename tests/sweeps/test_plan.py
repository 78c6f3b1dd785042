"""Plans: the cases they describe, and plans that describe none."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import softlube
from softlube.sweeps.plan import make_plan, read_plan

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


VALUES = [
    "nan",
    "1e999",
    "9" * 5000,
    "9" * 4000,
    "[" * 900 + "]" * 900,
    "[" * 300 + "]" * 300,
    '{ csv = "a\\u0000b" }',
    '{ csv = "/dev/zero" }',
    '{ csv = "." }',
    '{ from = 1.0, to = 2.0, count = 3, spacing = ["log"] }',
    '{ from = "1 m", to = [1], count = 3 }',
    "{ from = -1e308, to = 1e308, count = 9, spacing = 'linear' }",
    '"\\u001b[2J"',
    "1979-05-27",
]


@pytest.mark.parametrize("value", VALUES)
@pytest.mark.parametrize("name", ["speed", "cavitation", "beta", "history", "combine"])
def test_hostile_values_end_in_one_line(tmp_path, name, value):
    path = tmp_path / "plan.toml"
    place, text = ("[sweep]\n", TOML) if name == "combine" else ("[parameters]\n", TOML.replace('speed = "0.1 mm/s"\n', ""))
    path.write_text(text.replace(place, f"{place}{name} = {value}\n"))
    with pytest.raises(softlube.InputError) as caught:
        read_plan(path)
    assert len(str(caught.value)) <= 300
    assert str(caught.value).isprintable()


def test_what_is_no_plan(tmp_path):
    (tmp_path / "dots.toml").write_text("a = 1\n" + ".".join("a" * 400_000) + " = 1\n")
    with pytest.raises(softlube.InputError, match=r"dots.toml, line 2: a key or a value is longer"):
        read_plan(tmp_path / "dots.toml")
    (tmp_path / "long.toml").write_text("#" * 1_000_001)
    for name, message in [
        ("long.toml", "has 1e.06 bytes"),
        (".", "is a folder"),
        ("/dev/zero", "is a device"),
        ("a\0", "no name"),
    ]:
        with pytest.raises(softlube.InputError, match=f"^plan: .* {message}"):
            read_plan(tmp_path / name)


@settings(max_examples=150, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    place=st.integers(0, len(TOML)),
    cut=st.integers(0, 20),
    put=st.text(max_size=20) | st.sampled_from(VALUES) | st.text('0123456789"[]{}=,.# \n', max_size=9),
)
def test_a_plan_is_read_or_refused_in_one_line(tmp_path, place, cut, put):
    path, said = tmp_path / "plan.toml", ""
    path.write_bytes((TOML[:place] + put + TOML[place + cut :]).encode("utf-8", "surrogatepass"))
    try:
        assert read_plan(path).cases
    except softlube.InputError as error:
        said = str(error)
    assert len(said) <= 300
    assert not said or said.isprintable()
