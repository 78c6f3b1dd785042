"""Hard contacts: the march in the viscosity, the Petrusevich spike, and what is said where no grid resolves it."""

import json
import runpy
from pathlib import Path

import numpy as np
import pytest

import softlube
from softlube.cli.main import main
from softlube.discretization.system import ContactSystem
from softlube.model.exact import HERTZ_PRESSURE
from softlube.model.liquids import BarusLaw, DowsonHigginsonLaw, RoelandsLaw
from softlube.model.problem import Problem
from softlube.model.quantities import Quantity
from softlube.readout.flow import net_flux
from softlube.steady.level import solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.refinements.spike.detection import doubts, is_open
from softlube.steady.regime import Regime
from softlube.theory.engineering import (
    BETA_LOAD_OF_M,
    alpha_of_moes,
    hamrock_dowson_hard_center,
    hamrock_dowson_hard_min,
    moes_film,
    nijenbanning_venner_moes,
)

HARD = [
    "--radius",
    "10 mm",
    "--young-modulus",
    "82.5 GPa",
    "--viscosity",
    "0.05 Pa s",
    "--speed",
    "1.17 m/s",
    "--load",
    "5.17 N",
]
"""M = 20 and L = 10 with an oil of 20/GPa."""


def moes(m, material):
    """A contact in Moes' parameters."""
    return Problem(beta_load=BETA_LOAD_OF_M * m ** (4 / 3), liquid=BarusLaw(float(alpha_of_moes(m, material))))


def solve(m, material, accuracy):
    problem = moes(m, material)
    return softlube.solve(beta_load=problem.beta_load, liquid=problem.liquid, accuracy=accuracy)


@pytest.fixture(scope="module")
def spiked():
    """M = 20, L = 10: αp_H = 9.9."""
    return solve(20, 10, 1e-2)


def test_alpha_p_hertz_of_moes():
    """αp_H = (L/π)(3M/2)^(1/3)."""
    assert Regime.of(moes(20, 10)).thickening == pytest.approx(10 / np.pi * 30 ** (1 / 3))


@pytest.mark.parametrize("law", [None, RoelandsLaw(48.8, 0.68, 3.33 / 48.8)])
def test_march_ends_where_it_should(law):
    problem = moes(20, 10) if law is None else Problem(beta_load=moes(20, 10).beta_load, liquid=law)
    grid = grid_for(Regime.of(problem), 12)
    solved = solve_level(Regime.of(problem), grid)
    residual = ContactSystem(problem, grid).linearise(solved.x).residual
    assert np.abs(residual[:-1][solved.x[:-1] > 0]).max() < 1e-6 * np.abs(residual).max()
    # GMRES does not notice that the fluidity vanishes: the film is the preconditioner's unknown.
    assert max(step.krylov for step in solved.level.history) <= 15


def test_a_spike_that_is_resolved():
    """M = 20, L = 5, αp_H = 4.9: 1.3856 p_H on the finest grids, with and without the refinement at the crest."""
    solution = solve(20, 5, 1e-2)
    assert not solution.warnings
    height = solution.pressure_max / HERTZ_PRESSURE
    assert height == pytest.approx(1.3856, abs=float(solution.pressure_max.error) / HERTZ_PRESSURE)
    assert solution.pressure_max.error < 3e-2 * solution.pressure_max
    assert abs(height - 1.3856) < 2e-3
    assert height > 1.3 * solution.pressure_center / HERTZ_PRESSURE
    assert float(moes_film(solution.film_center, solution.beta_load)) == pytest.approx(3.2810, abs=3e-4)


def test_films_where_no_grid_resolves_the_spike(spiked):
    unit = float(moes_film(1.0, spiked.beta_load))
    assert unit * spiked.film_center == pytest.approx(4.8580, abs=unit * spiked.film_center.error)
    assert unit * spiked.film_min == pytest.approx(3.0185, abs=unit * spiked.film_min.error)
    assert spiked.film_center.error < 1e-3 * spiked.film_center
    assert spiked.film_min.error < 2e-3 * spiked.film_min


def test_no_number_for_what_no_grid_resolves(spiked, tmp_path):
    assert np.isnan([spiked.pressure_max, spiked.friction_domain, spiked.friction_contact, spiked.boundary_layer]).all()
    assert np.isnan(spiked.normalised("indentation")["pressure_max"])
    assert np.isfinite([spiked.pressure_center, spiked.height, spiked.film_outlet_min]).all()
    assert "a spike at r = 0.6" in spiked.warnings[0]
    plain = json.loads(json.dumps(spiked.to_dict(), allow_nan=False))
    assert plain["quantities"]["pressure_max"] == {"value": None, "error": None}
    spiked.save(tmp_path / "a.nc")
    again = softlube.load(tmp_path / "a.nc")
    assert np.isnan(again.pressure_max)
    assert again.fields.film_at(0.66, np.pi) == pytest.approx(spiked.fields.film_at(0.66, np.pi), rel=1e-12)
    spiked.plot(tmp_path / "a.png")


def test_needle_grows_with_the_grid(spiked):
    """Which is why it has no number: three grids, each higher than the last, by 44 % or more in all."""
    heights = [level.values["pressure_max"] for level in spiked.levels[-3:]]
    assert heights[2] > heights[1] > heights[0]
    assert heights[2] > 1.44 * heights[0]
    assert is_open(spiked.fields)
    films = [level.values["film_center"] for level in spiked.levels[-3:]]
    assert abs(films[2] - films[1]) < 1e-4 * films[2]


def test_mass_balance_over_discs(spiked):
    """What is dragged and pressed into a disc comes out again, taken from the fields by another quadrature."""
    fields = spiked.fields
    theta = (np.arange(720) + 0.5) * np.pi / 720
    for r in (0.2, 0.4, 0.8, 0.9):  # within the crest of the spike, and around it
        xi, s = fields.chart.xi_of(r), fields.chart.s_of(theta)
        film, pressure = fields.film_at(r, theta), fields.pressure_spline(xi, s)[0]
        slope = fields.pressure_spline(xi, s, dx=1)[0] / fields.chart.dr_dxi(r)
        inflow = film**3 * fields.liquid.fluidity(pressure)[0] * slope + film * np.cos(theta) / fields.beta
        assert abs(inflow.sum()) < 1e-5 * np.abs(inflow).sum()


def test_global_mass_balance_of_the_discrete_equations(spiked):
    """Ring by ring: the balance of every disc inside the free boundary, to Newton's tolerance."""
    problem, fields = spiked.problem, spiked.fields
    system = ContactSystem(problem, fields.chart)
    x = np.append(fields.pressure[: fields.chart.n_r].ravel(), fields.height)
    residual = system.linearise(x).residual[:-1].reshape(fields.chart.n_r, -1)
    rings = residual[:, 1:-1].sum(axis=1) + (residual[:, 0] + residual[:, -1]) / 2
    within = fields.r[: fields.chart.n_r] < 0.8
    radial = system.reynolds.drag[: fields.chart.n_unknown].reshape(fields.chart.n_r, -1)
    through = np.abs(system.speed * radial).sum(axis=1)
    assert np.max(np.abs(np.cumsum(rings))[within] / through.max()) < 1e-6


def dense(m, material, law):
    """A contact in Moes' parameters with a liquid of 20/GPa and 0.05 Pa s, denser under pressure."""
    problem = moes(m, material)
    unit = problem.liquid.alpha / 20e-9
    thick = problem.liquid if law == "barus" else RoelandsLaw.of(20e-9, 0.05, unit)
    return problem.beta_load, DowsonHigginsonLaw.of(thick, unit)


@pytest.fixture(scope="module")
def resolved():
    """M = 20, L = 10 with the liquid of the published formulas: RoelandsLaw, Dowson & Higginson."""
    beta_load, liquid = dense(20, 10, "roelands")
    return softlube.solve(beta_load=beta_load, liquid=liquid, accuracy=1e-2)


def test_a_compressible_liquid_has_a_spike_with_a_height(resolved):
    """1.534 p_H at 0.7286 on the outlet axis, 1.5586 p_H beside it: 58 angles, cells of 10⁻⁵."""
    assert not resolved.warnings
    quantities = resolved.quantities
    for name, expected in (("spike_pressure", 1.534 * HERTZ_PRESSURE), ("spike_radius", 0.7286), ("friction_contact", 158.7)):
        assert abs(quantities[name] - expected) < quantities[name].error < 0.01 * expected, name
    assert resolved.pressure_max == pytest.approx(1.5586 * HERTZ_PRESSURE, abs=float(resolved.pressure_max.error))
    unit = float(moes_film(1.0, resolved.beta_load))
    assert unit * resolved.film_center == pytest.approx(4.1572, abs=5e-4)
    assert unit * resolved.film_min == pytest.approx(2.8534, abs=2e-3)
    # Between the two formulas, which were fitted to such liquids.
    assert unit * resolved.film_center == pytest.approx(float(nijenbanning_venner_moes(20, 10)), rel=0.03)
    assert unit * resolved.film_center == pytest.approx(float(hamrock_dowson_hard_center(20, 10)), rel=0.1)


def test_a_spike_goes_into_files_and_tables(resolved, tmp_path):
    resolved.save(tmp_path / "a.nc")
    again = softlube.load(tmp_path / "a.nc")
    assert again.problem == resolved.problem
    assert again.spike_radius == resolved.spike_radius
    assert again.to_dict()["quantities"]["spike_pressure"]["value"] == pytest.approx(float(resolved.spike_pressure))


def test_mass_is_conserved_across_a_spike(resolved):
    for r in (0.4, 0.8, 0.9):
        assert abs(net_flux(resolved, r)) < 1e-4


@pytest.fixture(scope="module")
def steep():
    """M = 20, L = 10 with Barus's law and that density: the spike falls off within 10⁻⁴."""
    beta_load, liquid = dense(20, 10, "barus")
    return softlube.solve(beta_load=beta_load, liquid=liquid, accuracy=1e-2)


def test_a_steep_spike_is_given_with_its_error(steep):
    """1.975 p_H at 0.7467, on other meshes (58 angles, cells of 10⁻⁵); only the friction hangs on more than they tell."""
    for name, expected in (("spike_pressure", 1.975 * HERTZ_PRESSURE), ("spike_radius", 0.7467)):
        assert abs(steep.quantities[name] - expected) < steep.quantities[name].error < 0.01 * expected, name
    assert steep.pressure_max == pytest.approx(2.155 * HERTZ_PRESSURE, abs=float(steep.pressure_max.error))
    assert (
        "hardly resolve; not given, because the error would be above 10 %: friction_total, friction_contact, friction"
        in steep.warnings[0]
    )
    assert np.isnan([steep.friction_contact, steep.friction_domain]).all()
    unit = float(moes_film(1.0, steep.beta_load))
    assert unit * steep.film_center == pytest.approx(4.3423, abs=5e-4)
    for name, quantity in steep.quantities.items():
        assert np.isnan(quantity) or quantity.error <= 0.1 * abs(quantity) or name.endswith(("_deg", "_radius", "height")), name


def test_a_steep_spike_in_the_other_normalisation(steep):
    """Pressures and lengths go like the root of the unit; what is not known stays unknown."""
    other = steep.normalised("indentation")
    for name in ("spike_pressure", "spike_radius", "pressure_max"):
        assert other[name] * np.sqrt(-steep.height) == pytest.approx(float(steep.quantities[name])), name
        assert other[name].error / other[name] == pytest.approx(steep.quantities[name].error / steep.quantities[name]), name
    assert np.isnan(other["friction_domain"])
    assert 0 < other["boundary_layer"].error < 0.1


def test_the_shear_rate_does_not_know_the_spike(spiked, steep):
    """It goes by the gradient of q, which is smooth where the pressure is not."""
    for solution in (spiked, steep):
        before, last = (level.values["shear_rate_max"] for level in solution.levels[-2:])
        assert last == pytest.approx(before, rel=4e-3)
        assert solution.shear_rate_max.error < 5e-3 * solution.shear_rate_max


def test_no_talk_of_spikes_where_there_is_none():
    """A number may be missing for other reasons: that is no spike's doing."""
    solution = softlube.solve(beta_load=100.0, accuracy=1e-2)
    assert doubts(solution.fields, {"boundary_layer": Quantity(np.nan)}) == ()


def test_what_is_too_thick_is_refused_at_once():
    with pytest.raises(softlube.NotConvergedError, match=r"rise by a factor of e\^73 under the dry contact's pressure"):
        solve(1000, 20, 1e-2)


def test_command_in_si_units(capsys):
    assert main(["solve", *HARD, "--pressure-viscosity", "20 GPa^-1", "--accuracy", "0.01"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "Warning: the pressure has a spike at r = 0.6" in said
    assert "maximum pressure none" in said


@pytest.mark.slow
@pytest.mark.parametrize(
    ("m", "law", "height", "place"),
    [
        (20, "barus", 1.975, 0.7467),
        (200, "barus", 1.0586, 0.93256),
        (20, "roelands", 1.5339, 0.7286),
        (200, "roelands", 0.8851, 0.92852),
    ],
)
def test_spikes_of_the_textbook_cases(m, law, height, place):
    """The values are those of 58 angles and cells of 10⁻⁵, see benchmarks/spike_sphere.py."""
    beta_load, liquid = dense(m, 10, law)
    solution = softlube.solve(beta_load=beta_load, liquid=liquid)
    assert (
        abs(solution.spike_pressure / HERTZ_PRESSURE - height) < solution.spike_pressure.error / HERTZ_PRESSURE < 0.015 * height
    )
    assert abs(solution.spike_radius - place) < solution.spike_radius.error < 5e-4


@pytest.mark.slow
def test_the_line_contact_has_the_same_story():
    """By other code, on ever finer cells: at αp₀ = 7 the spike grows without end, or to 1.335 p₀ where p₀ = 0.494 GPa."""
    find_spike = runpy.run_path(str(Path(__file__).parents[4] / "benchmarks" / "spike_line.py"))["find_spike"]
    with np.errstate(all="ignore"):
        for hertz in (0.0, 0.494):
            coarse, middle, fine = (find_spike(7.0, -0.5, width, hertz=hertz).height for width in (0.03, 0.01, 0.003))
            if hertz:
                assert [middle, fine] == pytest.approx([1.3346, 1.3351], abs=1e-3)
                assert fine - middle < (middle - coarse) / 4
            else:
                assert fine > 1.3 * middle > 1.3**2 * coarse


@pytest.mark.slow
@pytest.mark.parametrize(("m", "center", "lowest"), [(20, 4.8580, 3.0185), (200, 4.5122, 1.8841)])
def test_textbook_cases_at_the_default_accuracy(m, center, lowest):
    solution = solve(m, 10, 1e-3)
    unit = float(moes_film(1.0, solution.beta_load))
    assert unit * solution.film_center == pytest.approx(center, abs=2e-4)
    assert unit * solution.film_min == pytest.approx(lowest, abs=1e-3)
    assert solution.film_center.error < 1e-4 * solution.film_center
    assert solution.film_min.error < 1e-3 * solution.film_min
    # Formulas fitted to compressible liquids and, the minimum, to elliptic contacts on coarse grids.
    assert unit * solution.film_center == pytest.approx(float(hamrock_dowson_hard_center(m, 10)), rel=0.2)
    assert unit * solution.film_min == pytest.approx(float(hamrock_dowson_hard_min(m, 10)), rel=0.2)
    assert unit * solution.film_center == pytest.approx(float(nijenbanning_venner_moes(m, 10)), rel=0.2)
