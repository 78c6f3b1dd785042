"""Steady sliding as a case of a sweep: which problem it is, and its row of the table."""

import pytest

import softlube
from softlube.sweeps.plan import make_plan
from softlube.sweeps.steady import Steady, SteadyTask
from softlube.sweeps.tasks import Outcome
from softlube.sweeps.work import content_key

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s", "load": "100 mN"}


def test_a_single_contact_is_the_contact():
    (case,) = make_plan(BALL).cases
    assert case.contact == softlube.Contact(**BALL)
    assert case.problem.beta_load == pytest.approx(softlube.Contact(**BALL).problem().beta_load, rel=1e-11)


def test_contacts_of_equal_beta_are_one_problem():
    plan = make_plan(BALL | {"viscosity": ["2 Pa s", "1 Pa s", "0.7 Pa s"], "speed": [1e-4, 2e-4, 2e-4 / 0.7]}, combine="zip")
    assert len({case.problem for case in plan.cases}) == 1
    assert plan.cases[0].problem.beta_load == float(f"{softlube.Contact(**BALL).problem().beta_load:.12g}")


def test_dimensionless_cases():
    plan = make_plan({"beta": {"from": 10, "to": 1000, "count": 3}, "cavitation": ["reynolds", "none"]})
    assert [case.problem.beta for case in plan.cases] == pytest.approx([10, 10, 100, 100, 1000, 1000])
    assert plan.cases[1].problem.cavitation == "none"
    assert plan.cases[0].contact is None


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


ROUGH = 0.02


def test_warnings_are_a_column():
    table = softlube.sweep(SEVERAL | {"load": "50 mN", "roughness": ["1 nm", "1 mm"]}, accuracy=ROUGH, workers=1).table
    one = softlube.Contact(**BALL | {"load": "50 mN", "speed": "1 mm/s", "roughness": "1 mm"}).solve(accuracy=ROUGH)
    assert table["warnings"].tolist()[:3] == ["", "; ".join(one.warnings), ""]  # at 1 mm/s, then at 3 mm/s
    assert all("times the roughness (boundary" in text for text in table["warnings"][1::2])
    assert table["lubrication"].tolist() == ["full film", "boundary"] * 2
    assert table["lambda_ratio"].tolist() == pytest.approx([table["film_min [m]"][i] / (1e-9, 1e-3)[i % 2] for i in range(4)])


@pytest.mark.slow
def test_a_spike_without_a_height_is_warned_of_in_the_table():
    hard = {"radius": "10 mm", "young_modulus": "82.5 GPa", "viscosity": "0.05 Pa s", "speed": "1.17 m/s", "load": "5.17 N"}
    table = softlube.sweep(hard | {"pressure_viscosity": "20 GPa^-1"}, accuracy=ROUGH, workers=1).table
    assert "spike" in table["warnings"][0]


SEVERAL = BALL | {"speed": ["1 mm/s", "3 mm/s"]}


def test_a_failure_keeps_its_beta():
    (case,) = make_plan(BALL).cases
    assert case.numbers(Outcome("too light")) == {"beta_load": case.problem.beta_load}
    (case,) = make_plan({"beta": 1e12}).cases
    assert case.numbers(Outcome("outside")) == {"beta": 1e12}


def test_a_row_is_the_contact_s_own_interpretation():
    """One outcome, two contacts of equal β: twice the viscosity at half the speed has the films, and half the shear rate."""
    thin, thick = make_plan(BALL | {"viscosity": ["1 Pa s", "2 Pa s"], "speed": ["0.2 mm/s", "0.1 mm/s"]}, combine="zip").cases
    assert thin.task == thick.task
    outcome = thin.task.solve(0.02, False)
    rows = thin.numbers(outcome), thick.numbers(outcome)
    assert rows[0]["film_min [m]"] == rows[1]["film_min [m]"]
    assert rows[0]["shear_rate_max [1/s]"] == pytest.approx(2 * rows[1]["shear_rate_max [1/s]"])
    solved = softlube.Contact(**BALL).solve(accuracy=0.02)
    assert rows[1]["friction_domain [N]"] == pytest.approx(solved.dimensional["friction_domain"], rel=1e-9)


def test_fields_become_a_file_of_the_case(tmp_path):
    (case,) = make_plan(BALL).cases
    outcome = case.task.solve(0.02, True)
    case.write(outcome.fields, tmp_path / "a.nc")
    loaded = softlube.load(tmp_path / "a.nc")
    assert loaded.contact == case.contact
    assert loaded.dimensional["film_min"] == case.numbers(outcome)["film_min [m]"]


def test_tasks_that_are_neighbours_share_grids():
    assert SteadyTask(softlube.Problem(beta=10)).place < SteadyTask(softlube.Problem(beta=11)).place


@pytest.mark.parametrize("accuracy", [0, 0.2, "fine", True])
def test_an_accuracy_that_cannot_be_is_refused(accuracy, tmp_path):
    assert Steady(tmp_path).accuracy(None, ()) == 1e-3
    with pytest.raises(softlube.InputError, match="accuracy: expected a number up to"):
        Steady(tmp_path).accuracy(accuracy, ())


def test_two_bodies_and_rolling_are_parameters_like_any_other():
    bodies = {name: value for name, value in BALL.items() if name != "speed"} | {"thickness": "1 mm"}
    rig = {"ball_young_modulus": ["5 MPa", "5 GPa"], "substrate_radius": "-5 mm", "entrainment_speed": "0.05 mm/s"}
    plan = make_plan(bodies | rig | {"slide_to_roll": [0, 2]})
    assert len(plan.cases) == 4
    # the film does not depend on the slide-to-roll ratio: one solution for both
    assert len({content_key(case.task, 1e-3) for case in plan.cases}) == 2
    assert plan.cases[0].contact == softlube.Contact(**bodies | rig | {"ball_young_modulus": "5 MPa"}, slide_to_roll=0)
