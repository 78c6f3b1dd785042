"""The discrete Reynolds equation: exactness, order, conservation, exact derivatives."""

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve

from softlube.discretization.grid import PolarGrid
from softlube.discretization.reynolds import ReynoldsOperator
from softlube.model.exact import kapitza_pressure
from softlube.model.film_section import EXACT, film_section
from softlube.model.liquids import (
    BarusLaw,
    CarreauYasudaLaw,
    DowsonHigginsonLaw,
    EyringLaw,
    NewtonianLaw,
    OstwaldLaw,
    RoelandsLaw,
)

GRID = PolarGrid(16, 10, edge_width=0.2)


def smooth_fields(grid):
    """A film and a pressure without symmetry about 90°, smooth at the centre."""
    x, y = grid.r[:, None] * np.cos(grid.theta), grid.r[:, None] * np.sin(grid.theta)
    film = 0.5 + 0.2 * x + (x**2 + y**2) / 2 + 0.1 * np.exp(-((x - 0.5) ** 2) - y**2)
    pressure = np.exp(-((x - 0.3) ** 2) - 1.5 * y**2)
    return pressure.ravel(), film.ravel()


def test_uniform_film_carries_no_pressure():
    operator = ReynoldsOperator.on(GRID)
    residual = operator.residual(np.zeros(GRID.r.size * GRID.theta.size), np.full(GRID.r.size * GRID.theta.size, 0.7), 3.0)
    assert np.max(np.abs(residual)) < 1e-12


def exact_balance(grid, speed):
    """−(∇·(u³∇p) + speed ∂u/∂x) r r′ θ′ of `smooth_fields`, differentiated by complex steps in x and y."""
    x, y = grid.r[:, None] * np.cos(grid.theta), grid.r[:, None] * np.sin(grid.theta)

    def film(x, y):
        return 0.5 + 0.2 * x + (x**2 + y**2) / 2 + 0.1 * np.exp(-((x - 0.5) ** 2) - y**2)

    def slopes(x, y):
        p = np.exp(-((x - 0.3) ** 2) - 1.5 * y**2)
        return -2 * (x - 0.3) * p, -3 * y * p

    step = 1e-30j
    divergence = (film(x + step, y) ** 3 * slopes(x + step, y)[0]).imag / 1e-30
    divergence += (film(x, y + step) ** 3 * slopes(x, y + step)[1]).imag / 1e-30
    drag = speed * film(x + step, y).imag / 1e-30
    measure = (grid.r * grid.dr_dxi(grid.r))[:, None] * grid.dtheta_ds(grid.s)
    return -(divergence + drag) * measure


@pytest.mark.parametrize("direction", ["r", "theta"])
def test_the_order_on_a_manufactured_solution(direction):
    """Fourth along r, sixth along θ."""
    sizes = np.array([24, 36, 54])
    errors = []
    for n in sizes:
        grid = PolarGrid(n, 160, edge_width=0.5, reach=6) if direction == "r" else PolarGrid(300, n, edge_width=0.5, reach=6)
        pressure, film = smooth_fields(grid)
        residual = ReynoldsOperator.on(grid).residual(pressure, film, 0.3).reshape(grid.n_r, -1)
        # The first ring presumes that no liquid is left at the centre, which holds for solutions only.
        inner = (grid.r[: grid.n_r] < 2) & (np.arange(grid.n_r) > 0)
        errors.append(np.max(np.abs(residual - exact_balance(grid, 0.3)[: grid.n_r])[inner]))
    order = -np.polyfit(np.log(sizes), np.log(errors), 1)[0]
    assert order == pytest.approx(4 if direction == "r" else 6, abs=0.35)


def test_kapitza_solution_converges_at_fourth_order():
    """Rigid sphere: the linear problem for a given film, with the exact pressure imposed at the rim."""
    beta, gap, errors, sizes = 2.0, 0.15, [], np.array([24, 36, 54])
    for n in sizes:
        grid = PolarGrid(2 * n, n, edge_width=0.4, side_width=1.0, reach=10)
        exact = kapitza_pressure(grid.r[:, None], grid.theta, beta, gap).ravel()
        film = np.repeat(gap + grid.r**2 / 2, grid.theta.size)
        operator, known = ReynoldsOperator.on(grid), exact.copy()
        known[: grid.n_unknown] = 0
        flow = operator.at(known, film, 1 / beta)
        matrix = -(operator.differences.divergence @ flow.derivatives[0])[:, : grid.n_unknown]
        found = spsolve(matrix.tocsc(), -operator.residual(known, film, 1 / beta))
        errors.append(np.max(np.abs(found - exact[: grid.n_unknown])) / exact.max())
    order = -np.polyfit(np.log(sizes), np.log(errors), 1)[0]
    assert errors[-1] < 3e-5
    assert order == pytest.approx(4, abs=0.3)


def test_mass_is_conserved_to_round_off():
    """What leaves all cells together crosses the rim: interior changes of the fields do not alter the sum."""
    operator = ReynoldsOperator.on(GRID)
    ring = np.full(GRID.theta.size, 1.0)
    ring[[0, -1]] = 0.5
    rng = np.random.default_rng(1)
    film, pressure = 1 + rng.random((2, *GRID.shape))
    total = []
    for bump in (0.0, 1.0):
        changed_film, changed_pressure = film.copy(), pressure.copy()
        changed_film[: GRID.n_r - 5] += bump * rng.random((GRID.n_r - 5, GRID.theta.size))
        changed_pressure[: GRID.n_r - 5] += bump * rng.random((GRID.n_r - 5, GRID.theta.size))
        residual = operator.residual(changed_pressure.ravel(), changed_film.ravel(), 0.7).reshape(GRID.n_r, -1)
        total.append(np.sum(residual * ring))
    assert np.max(np.abs(residual)) > 1
    assert total[0] == pytest.approx(total[1], abs=1e-10 * np.abs(residual).sum())


def test_derivatives_against_complex_step():
    operator = ReynoldsOperator.on(GRID)
    rng = np.random.default_rng(2)
    film, pressure, change = rng.random((3, GRID.r.size * GRID.theta.size)) + 0.5
    flow = operator.at(pressure, film, 0.4)
    step = 1e-30

    def residual(p, u):
        return operator.residual(p, u, 0.4)

    numeric = residual(pressure + 1j * step * change, film + 0j).imag / step
    assert flow.change(change, 0 * change) == pytest.approx(numeric, rel=1e-12, abs=1e-12)
    numeric = residual(pressure + 0j, film + 1j * step * change).imag / step
    assert flow.change(0 * change, change) == pytest.approx(numeric, rel=1e-12, abs=1e-12)


THINNING = [
    OstwaldLaw(NewtonianLaw(), 0.1, 0.6),
    CarreauYasudaLaw(NewtonianLaw(), 30.0, 0.5, 0.01),
    EyringLaw(BarusLaw(3.0), 0.05),
    DowsonHigginsonLaw(CarreauYasudaLaw(RoelandsLaw(3.0, 0.6, 0.4), 30.0, 0.4), 0.6),
]


@pytest.mark.parametrize("ratio", [0.0, 0.7, 2.0])
@pytest.mark.parametrize("law", THINNING)
def test_derivatives_of_a_thinning_liquid_against_differences(law, ratio):
    rng = np.random.default_rng(3)
    operator = ReynoldsOperator.on(GRID)
    pressure, film = smooth_fields(GRID)
    pressure = 0.2 * pressure + 0.01 * rng.random(pressure.size)
    step = pressure * rng.standard_normal(pressure.size), film * rng.standard_normal(film.size)
    change = operator.at(pressure, film, 0.02, law, ratio).change(*step)
    ahead, behind = (operator.residual(pressure + h * step[0], film + h * step[1], 0.02, law, ratio) for h in (1e-6, -1e-6))
    assert change == pytest.approx((ahead - behind) / 2e-6, abs=1e-7 * np.max(np.abs(change)))


def thinning_balance(grid, law, speed, ratio):
    """Minus the divergence of φu²m/6 + speed u e_x under `smooth_fields`, by central differences of high order in x and y."""

    def flux(x, y):
        film = 0.5 + 0.2 * x + (x**2 + y**2) / 2 + 0.1 * np.exp(-((x - 0.5) ** 2) - y**2)
        p = np.exp(-((x - 0.3) ** 2) - 1.5 * y**2)
        fluidity = law.fluidity(p)[0]
        difference = 6 * film * np.stack([-2 * (x - 0.3) * p, -3 * y * p])
        section = film_section(law, difference.reshape(2, -1), (speed * ratio / 2 / film / fluidity).ravel(), EXACT)
        moment = section.moment.reshape(difference.shape)
        return fluidity * film**2 * moment[0] / 6 + speed * film, fluidity * film**2 * moment[1] / 6

    x, y = grid.r[:, None] * np.cos(grid.theta), grid.r[:, None] * np.sin(grid.theta)
    h, total = 4e-3, 0.0
    for k, weight in ((1, 3 / 4), (2, -3 / 20), (3, 1 / 60)):
        total = total + weight * (flux(x + k * h, y)[0] - flux(x - k * h, y)[0] + flux(x, y + k * h)[1] - flux(x, y - k * h)[1])
    return -total / h * (grid.r * grid.dr_dxi(grid.r))[:, None] * grid.dtheta_ds(grid.s)


@pytest.mark.parametrize(
    ("law", "ratio"), [(CarreauYasudaLaw(NewtonianLaw(), 1.0, 0.5, 0.01), 2.0), (EyringLaw(BarusLaw(1.0), 1.0), 0.7)]
)
def test_a_thinning_liquid_is_of_fourth_order_on_a_manufactured_solution(law, ratio):
    sizes, errors = np.array([24, 36, 54]), []
    for n in sizes:
        grid = PolarGrid(3 * n, 2 * n, edge_width=0.5, reach=6)
        pressure, film = smooth_fields(grid)
        residual = ReynoldsOperator.on(grid).residual(pressure, film, 0.3, law, ratio).reshape(grid.n_r, -1)
        inner = (grid.r[: grid.n_r] < 2) & (grid.r[: grid.n_r] > 0.3)
        area = (grid.r * grid.dr_dxi(grid.r))[: grid.n_r, None] * grid.dtheta_ds(grid.s)
        errors.append(np.max(np.abs((residual - thinning_balance(grid, law, 0.3, ratio)[: grid.n_r]) / area)[inner]))
    order = -np.polyfit(np.log(sizes), np.log(errors), 1)[0]
    assert order > 3.5, (errors, order)
