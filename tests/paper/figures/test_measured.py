"""Measured friction for figure 13: both forms of the file, and refusals."""

import numpy as np
import pytest

import softlube
from softlube.paper.figures import FIGURES
from softlube.paper.figures.base import BALL_ON_RUBBER
from softlube.paper.figures.measured import read_friction


def test_measured_points_in_both_forms(tmp_path, solutions):
    """A contact solved under a load, as an experimenter would write it down, falls on the theory's curve."""
    solution = softlube.Contact(**BALL_ON_RUBBER).solve(accuracy=0.01)
    force = float(solution.dimensional["friction_domain"])
    physical = tmp_path / "physical.csv"
    physical.write_text(
        "# a comment\nradius [mm],young_modulus [MPa],viscosity [Pa s],speed [mm/s],load [mN],friction [uN],operator\n"
        f"2,3,2,0.1,100,{force * 1e6},A. B.\n",
        encoding="utf-8",
    )
    points = read_friction(physical)
    assert points.beta == pytest.approx(solution.beta_load)
    assert points.friction == pytest.approx(float(solution.friction_domain), rel=1e-6)
    plain = tmp_path / "plain.csv"
    plain.write_text(f"beta,friction\n{points.beta[0]},{points.friction[0]}\n", encoding="utf-8")
    assert read_friction(plain).friction == pytest.approx(points.friction)
    german = tmp_path / "german.csv"
    german.write_text(f"beta;friction\n{str(points.beta[0]).replace('.', ',')};0,5\n", encoding="utf-8")
    assert read_friction(german).beta == pytest.approx(points.beta)
    assert read_friction(german).friction == pytest.approx(0.5)
    wide = {case: solutions[case] for case in FIGURES["13"].cases}
    drawn = FIGURES["13"].draw(wide, physical)
    table = next(table for table in drawn.tables if table.name == "measured").columns
    assert np.asarray(table["friction"]) == pytest.approx(np.asarray(table["theory r <= 2"]), rel=0.02)
    assert any("measured" in text.get_text() for text in drawn.figure.axes[0].get_legend().get_texts())


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("beta,friction\n", "data.csv, line 1: there are no rows below the header"),
        (
            "drag,load [N]\n1,2\n",
            "line 1: expected columns 'beta' and 'friction' (normalised by the load, Eqs. 26, 29, 30), or",
        ),
        ("beta,drag\n1,2\n", "line 1: no column friction"),
        ("beta,friction\n1,-2\n", "line 2: friction: expected a positive, finite number under 'friction', got '-2'"),
        ("beta,friction\n1,2\nx,2\n", "line 3: beta: 'x' under 'beta' is no number"),
        ("beta,friction\n1\n", "line 2: 1 cells under 2 columns"),
        (
            "radius [mm],young_modulus [MPa],viscosity [Pa s],speed [mm/s],load [kg],friction [mN]\n1,1,1,1,1,1\n",
            "line 1: load cannot be in 'kg'; expected a unit of a force",
        ),
        (
            "radius,young_modulus [MPa],viscosity [Pa s],speed [mm/s],load [N],friction [mN]\n1,1,1,1,1,1\n",
            "line 1: radius has no unit; expected one in the header, as in 'radius [mm]'",
        ),
    ],
)
def test_bad_measurements_are_refused(tmp_path, text, message):
    path = tmp_path / "data.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(softlube.InputError, match=r"^data: ") as error:
        read_friction(path)
    assert message in str(error.value)


def test_missing_measurements_are_refused(tmp_path):
    with pytest.raises(softlube.InputError, match="does not exist"):
        read_friction(tmp_path / "none.csv")
