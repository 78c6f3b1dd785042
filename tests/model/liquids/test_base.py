"""Viscosity laws, and what they do to the equation, the film and the friction."""

import numpy as np
import pytest
from scipy.integrate import quad

import softlube
from softlube.discretization.grid import PolarGrid
from softlube.discretization.reynolds import ReynoldsOperator
from softlube.discretization.system import ContactSystem
from softlube.model.liquids import BarusLaw, DowsonHigginsonLaw, NewtonianLaw, RoelandsLaw, from_plain, to_plain
from softlube.model.problem import Problem
from softlube.steady.level import solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime

LAWS = [BarusLaw(3.0), RoelandsLaw(3.0, 0.6, 0.4), DowsonHigginsonLaw(BarusLaw(3.0), 0.6)]
BALL = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "100 mN"]


@pytest.mark.parametrize("law", [NewtonianLaw(), *LAWS])
def test_fluidity_is_the_inverse_of_viscosity_with_its_derivative(law):
    p = np.linspace(0, 1.5, 7)
    fluidity, slope = law.fluidity(p)
    assert fluidity * law.viscosity(p) == pytest.approx(1)
    step = 1e-6
    assert slope == pytest.approx((law.fluidity(p + step)[0] - law.fluidity(p - step)[0]) / (2 * step), abs=1e-8)


@pytest.mark.parametrize("law", [NewtonianLaw(), *LAWS, RoelandsLaw(50.0, 0.68, 0.07), RoelandsLaw(1e-3, 1e-4, 0.5)])
def test_reduced_pressure_is_the_integral_of_the_fluidity(law):
    p = np.array([-0.05, 1e-9, 0.1, 0.3, 0.6])
    expected = [quad(lambda x: float(law.fluidity(np.array(x))[0]), 0, end, epsrel=1e-12, epsabs=0)[0] for end in p]
    assert law.reduced_pressure(p) == pytest.approx(expected, rel=2e-7, abs=0)
    # What is left of it keeps its digits where the liquid is all but solid.
    step = 1e-5
    slope = (law.reduced_pressure(p + step) - law.reduced_pressure(p - step)) / (2 * step)
    assert slope == pytest.approx(law.fluidity(p)[0], rel=2e-6, abs=1e-12)


@pytest.mark.parametrize("law", [NewtonianLaw(), *LAWS])
def test_weakened_to_nothing_is_constant_viscosity(law):
    p = np.array([0.0, 0.2, 1.0])
    assert law.weakened(0.0).viscosity(p) == pytest.approx(1)
    assert law.weakened(0.0).reduced_pressure(p) == pytest.approx(p)
    assert law.weakened(1.0) == law


@pytest.mark.parametrize("law", [BarusLaw(60.0), RoelandsLaw(60.0, 0.68, 0.06)])
def test_flux_is_the_gradient_of_the_reduced_pressure(law):
    """Under a uniform film the equation is Laplace's for q, whatever the fluidity does between two nodes (here e³⁰ in all)."""
    grid = PolarGrid(24, 10)
    operator = ReynoldsOperator.on(grid)
    pressure = np.random.default_rng(2).random(grid.shape).ravel() / 2
    film = np.full_like(pressure, 0.7)
    constant = operator.residual(law.reduced_pressure(pressure), film, 0.3)
    assert operator.residual(pressure, film, 0.3, law) == pytest.approx(constant, abs=1e-12 * np.abs(constant).max())


def test_a_solid_liquid_carries_the_film_along_to_third_order():
    """Without fluidity the equation is ∂u/∂x = 0, taken from upstream."""
    errors = []
    for n in (32, 64, 128):
        grid = PolarGrid(3 * n, n, edge_width=0.25, side_width=1.0)
        x, y = grid.r[:, None] * np.cos(grid.theta), grid.r[:, None] * np.sin(grid.theta)
        bump = np.exp(-((x - 0.3) ** 2) - y**2)
        residual = ReynoldsOperator.on(grid).residual(np.full(x.size, 1.0), (2 + bump).ravel(), 1.0, BarusLaw(200.0))
        area = grid.r[:, None] * grid.dr_dxi(grid.r)[:, None] * grid.dtheta_ds(grid.s)
        expected = area * 2 * (x - 0.3) * bump
        within = (grid.r[: grid.n_r] > 0.3) & (grid.r[: grid.n_r] < 10)
        errors.append(np.max(np.abs(residual.reshape(grid.n_r, -1) - expected[: grid.n_r])[within] / area[: grid.n_r][within]))
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all(orders > 2.7), (errors, orders)


def test_a_solid_compressible_liquid_carries_its_mass_along_to_third_order():
    """The equation is ∂(ρu)/∂x = 0 then, whatever the pressures are that make the density."""
    liquid, errors = DowsonHigginsonLaw(BarusLaw(400.0), 0.6), []
    for n in (32, 64, 128):
        grid = PolarGrid(3 * n, n, edge_width=0.25, side_width=1.0)
        x, y = grid.r[:, None] * np.cos(grid.theta), grid.r[:, None] * np.sin(grid.theta)
        film, pressure = 2 + np.exp(-((x - 0.3) ** 2) - y**2), 1 + 0.5 * np.exp(-((x + 0.2) ** 2) - 2 * y**2)
        residual = ReynoldsOperator.on(grid).residual(pressure.ravel(), film.ravel(), 1.0, liquid)
        density = 1 + 0.34 * pressure / (0.6 + pressure)
        compression = 0.34 * 0.6 / (0.6 + pressure) ** 2
        slope = -2 * (x - 0.3) * (film - 2) * density - 2 * (x + 0.2) * (pressure - 1) * compression * film
        area = grid.r[:, None] * grid.dr_dxi(grid.r)[:, None] * grid.dtheta_ds(grid.s)
        within = (grid.r[: grid.n_r] > 0.3) & (grid.r[: grid.n_r] < 10)
        difference = residual.reshape(grid.n_r, -1) / area[: grid.n_r] + slope[: grid.n_r]
        errors.append(np.max(np.abs(difference)[within]))
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all(orders > 2.7), (errors, orders)


@pytest.mark.parametrize("law", LAWS)
def test_units_leave_alpha_p_alone(law):
    p = np.array([0.2])
    assert law.in_units(4.0).viscosity(p / 2) == pytest.approx(law.viscosity(p))


@pytest.mark.parametrize("law", LAWS)
def test_derivatives_of_the_reynolds_equation(law):
    grid = PolarGrid(12, 8)
    operator = ReynoldsOperator.on(grid)
    generator = np.random.default_rng(1)
    pressure, film, dp, du = (0.2 + generator.random(grid.shape).ravel() for _ in range(4))
    flow, none = operator.at(pressure, film, 0.3, law), np.zeros(film.size)
    step = 1e-6

    def change(p, u):
        ahead, behind = (operator.residual(pressure + sign * step * p, film + sign * step * u, 0.3, law) for sign in (1, -1))
        return (ahead - behind) / (2 * step)

    scale = np.max(np.abs(flow.change(none, du)))
    assert flow.change(dp, none) == pytest.approx(change(dp, 0 * du), abs=1e-7 * scale)
    assert flow.change(none, du) == pytest.approx(change(0 * dp, du), abs=1e-7 * scale)


@pytest.mark.parametrize("law", LAWS)
def test_global_mass_balance_to_round_off(law):
    problem = Problem(beta=100.0, cavitation="none", liquid=law)
    grid = grid_for(Regime.of(problem), 18)
    x = solve_level(Regime.of(problem), grid).x
    system = ContactSystem(problem, grid)
    residual = system.linearise(x).residual[: grid.n_unknown].reshape(grid.n_r, -1).copy()
    residual[:, [0, -1]] /= 2
    assert abs(residual.sum()) < 1e-11 * np.abs(system.speed * system.reynolds.drag).sum()


def test_a_layer_with_barus_and_its_file(tmp_path):
    contact = softlube.Contact(
        radius="2 mm",
        young_modulus="30 MPa",
        poisson_ratio=0.4,
        viscosity="2 Pa s",
        speed="1 mm/s",
        load="1 N",
        thickness="1 mm",
        base="frictionless",
        pressure_viscosity="40 GPa^-1",
        viscosity_law="roelands",
        density_law="dowson-higginson",
    )
    solution = contact.solve(accuracy=1e-2)
    solution.save(tmp_path / "a.nc")
    again = softlube.load(tmp_path / "a.nc")
    assert again.problem == solution.problem
    assert again.contact == contact
    assert again.friction_within(1.5) == pytest.approx(solution.friction_within(1.5), rel=1e-12)


def test_round_trip_in_plain_values():
    for law in (NewtonianLaw(), *LAWS):
        assert from_plain(to_plain(law)) == law
    assert from_plain(None) == NewtonianLaw()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"viscosity_law": "roelands"}, "viscosity_law, pressure_viscosity: the first means nothing without the second"),
        (
            {"viscosity_law": "dowson", "pressure_viscosity": 1e-8},
            "viscosity_law: expected 'barus' or 'carreau' or .* or 'newtonian' or 'power-law' or 'roelands'",
        ),
        ({"density_law": "barus"}, "density_law: expected 'constant' or 'dowson-higginson'"),
        ({"viscosity_law": "roelands", "pressure_viscosity": 1e-6, "viscosity": 0.01}, "use 'barus'"),
        ({"pressure_viscosity": "20 GPa"}, "pressure_viscosity: 20 GPa has the wrong dimension"),
        ({"poisson_ratio": "half"}, "poisson_ratio: cannot read 'half': it does not begin with a number; expected a number"),
    ],
)
def test_bad_liquids_are_refused(change, message):
    inputs = {"radius": 2e-3, "young_modulus": 3e6, "viscosity": 2.0, "speed": 1e-4, "load": 0.1}
    with pytest.raises(softlube.InputError, match=message):
        softlube.Contact(**(inputs | change)).problem()
