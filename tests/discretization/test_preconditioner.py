"""The local stiffness and the preconditioned Newton equation, against dense algebra."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import sparse

from softlube.discretization.differences import Differences
from softlube.discretization.elasticity import elastic_operator
from softlube.discretization.grid import PolarGrid
from softlube.discretization.preconditioner import Border, FilmBalance, FilmEquation, local_stiffness
from softlube.discretization.system import ContactSystem
from softlube.model.problem import Problem
from softlube.solvers.newton import newton
from softlube.steady.level import solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime

GRID = PolarGrid(20, 10, edge_width=0.1)
PROBLEMS = [
    Problem(beta=50.0),
    Problem(beta=50.0, cavitation="none"),
    Problem(beta_load=80.0),
    Problem(beta_load=80.0, cavitation="none"),
]


@pytest.fixture(scope="module")
def elasticity():
    substrate = elastic_operator(GRID, "none")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("softlube.discretization.preconditioner.SMALLEST", 0.0)  # every entry
        return substrate, local_stiffness(GRID, substrate)


def test_small_entries_of_the_stiffness_are_left_out(elasticity):
    whole, sparse = elasticity[1], local_stiffness(GRID, elasticity[0])
    assert sparse.nnz < 0.5 * whole.nnz
    assert abs(whole - sparse).max() <= 0.01 * whole.diagonal().max()


def deflected(substrate, pressure):
    return substrate.deflection(pressure.ravel())[: GRID.n_unknown]


def test_stiffness_undoes_a_ring_s_own_deflection_and_that_of_its_neighbours(elasticity):
    """Exactly, by construction: a pressure on one ring comes back on it, and on the rings next to it none."""
    substrate, stiffness = elasticity
    for ring in (0, 1, 9, GRID.n_r - 1):
        pressure = np.zeros((GRID.n_r, GRID.shape[1]))
        pressure[ring] = 1 + np.cos(GRID.theta) + 0.3 * np.random.default_rng(ring).normal(size=GRID.shape[1])
        back = (stiffness @ deflected(substrate, pressure)).reshape(pressure.shape)
        near = slice(max(0, ring - 1), ring + 2)
        assert back[near] == pytest.approx(pressure[near], abs=1e-10 * np.abs(pressure).max())
        assert np.abs(np.delete(back, np.arange(GRID.n_r)[near], axis=0)).max() > 1e-3  # it is no exact inverse


def test_stiffness_sees_the_next_ring_and_no_farther(elasticity):
    row, column = elasticity[1].nonzero()
    apart = np.abs(row // GRID.shape[1] - column // GRID.shape[1])
    assert set(apart) == {0, 1}


def test_stiffness_inverts_ripples_and_overrates_waves_that_reach_farther(elasticity):
    """Films that alternate from ring to ring belong to pressures that do; long waves come back too large."""
    substrate, stiffness = elasticity

    def returned(pressure):
        return stiffness @ deflected(substrate, pressure) @ pressure.ravel() / np.sum(pressure**2)

    r, ring = GRID.r[: GRID.n_r, None], np.arange(GRID.n_r)[:, None]
    envelope = np.exp(-(r**2)) * np.ones(GRID.shape[1])
    assert returned(envelope * (-1.0) ** ring) == pytest.approx(1, abs=0.05)
    assert returned(envelope * np.cos(5 * GRID.theta)) == pytest.approx(1, abs=0.05)
    assert returned(envelope * r * np.cos(GRID.theta)) == pytest.approx(1.56, abs=0.05)
    assert returned(envelope) == pytest.approx(1.68, abs=0.05)


# --- the equation, where the stiffness is an exact inverse ----------------------------------------------------------

SIZE = 24


@pytest.fixture
def double(monkeypatch):
    """Factors that nothing is lost in."""
    monkeypatch.setattr("softlube.solvers.band.PRECISION", np.float64)


def banded(rng, diagonal):
    bands = [rng.normal(size=SIZE - abs(k)) + (diagonal if k == 0 else 0) for k in (-2, -1, 0, 1, 2)]
    return sparse.csr_array(sparse.diags_array(bands, offsets=[-2, -1, 0, 1, 2]))


class Exact:
    """An equation in which K is the inverse of a band matrix S, so that nothing is approximate."""

    def __init__(self, seed, bordered, held=()):
        rng = np.random.default_rng(seed)
        self.by_pressure, self.by_film, self.stiffness = banded(rng, 9), banded(rng, 7), banded(rng, 12)
        self.film = 0.1 + rng.random(SIZE)
        self.free = ~np.isin(np.arange(SIZE), held)
        self.jacobian = self.by_pressure.toarray() + self.by_film.toarray() @ np.linalg.inv(self.stiffness.toarray())
        self.border = Border(rng.normal(size=SIZE), rng.normal(size=SIZE), 2.0, 1.0) if bordered else None
        if bordered:
            self.jacobian = np.block(
                [[self.jacobian, self.border.column[:, None]], [self.border.row, np.array([self.border.corner])]]
            )

    def equation(self, border=None):
        # Each node its own face, so that the derivatives of the fluxes are those of the balance.
        identity = sparse.csr_array(sparse.eye_array(SIZE))
        balance = FilmBalance(Differences(self.by_pressure, self.by_pressure, self.by_pressure, -identity), self.stiffness)
        return FilmEquation(
            lambda step: self.jacobian @ step,
            balance,
            balance.entries(self.by_pressure.data, self.by_film.data),
            self.free,
            self.film,
            border or self.border,
        )

    def residual(self):
        values = np.random.default_rng(5).normal(size=self.jacobian.shape[0])
        values[:SIZE][~self.free] = 0
        return values


def matrix_of(equation, size=None):
    size = size or SIZE + (equation._border is not None)
    return np.stack([equation.operator(unit) for unit in np.eye(size)], axis=1)


@pytest.mark.parametrize("bordered", [False, True])
def test_with_an_exact_stiffness_the_operator_is_the_identity(bordered, double):
    case = Exact(1, bordered)
    assert matrix_of(case.equation()) == pytest.approx(np.eye(case.jacobian.shape[0]), abs=1e-11)


@pytest.mark.parametrize("bordered", [False, True])
def test_with_an_exact_stiffness_the_right_hand_side_is_the_solution_with_nodes_held_too(bordered, double):
    case = Exact(2, bordered, held=[0, 5, 6, 7, 23])
    equation, residual = case.equation(), case.residual()
    right = equation.right(residual)
    assert equation.operator(right) == pytest.approx(right, abs=1e-11 * np.abs(right).max())
    # Held rows may enter the free ones but no more than that, so GMRES is done after two steps from anywhere.
    off = matrix_of(equation) - np.eye(right.size)
    assert off @ off == pytest.approx(np.zeros_like(off), abs=1e-10)
    free = np.append(case.free, True) if bordered else case.free
    step = equation.step(right)
    assert np.all(step[~free] == 0)
    assert step[free] == pytest.approx(np.linalg.solve(case.jacobian[np.ix_(free, free)], residual[free]), rel=1e-9)


@pytest.mark.parametrize("change", [{"column": -1.0}, {"row": 0.5}, {"corner": 3.0}])
def test_a_wrong_border_spoils_the_identity(change, double):
    case = Exact(3, bordered=True)
    wrong = replace(case.border, **{name: factor * getattr(case.border, name) for name, factor in change.items()})
    identity = np.eye(SIZE + 1)
    assert matrix_of(case.equation()) == pytest.approx(identity, abs=1e-11)
    assert np.abs(matrix_of(case.equation(wrong)) - identity).max() > 0.05


# --- the equation of a contact --------------------------------------------------------------------------------------


def linearised(problem):
    """Next to a solution, with some nodes held that lie apart and in a patch."""
    system = ContactSystem(problem, GRID)
    x = newton(system, system.start()).x
    free = np.ones(x.size, dtype=bool)
    free[[3, 40, 41, 42, 52, 53, 150]] = False
    return system.linearise(x), free


@pytest.mark.parametrize("problem", PROBLEMS)
def test_the_equation_is_newton_s(problem, double):
    """Solved as it stands it gives the step of the exact dense Jacobian; only the way there is approximate."""
    at, free = linearised(problem)
    equation = at.equation(free)
    expected = np.where(free, np.random.default_rng(6).normal(size=free.size), 0.0)
    expected[: GRID.n_unknown] /= np.repeat((1 + GRID.r[: GRID.n_r]) ** 4, GRID.shape[1])
    residual = np.where(free, at.times(expected), 0.0)
    step = equation.step(np.linalg.solve(matrix_of(equation, free.size), equation.right(residual)))
    assert np.all(step[~free] == 0)
    assert step == pytest.approx(expected, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("problem", PROBLEMS)
def test_an_old_preconditioner_serves_the_next_jacobian(problem, double):
    """`at` keeps what is approximate and takes the new Jacobian: solved, it is that of the new state."""
    at, free = linearised(problem)
    old = at.equation(free)
    near = at.system.linearise(at.x * 1.003)
    equation = old.at(near.times)
    expected = np.where(free, np.random.default_rng(7).normal(size=free.size), 0.0)
    expected[: GRID.n_unknown] /= np.repeat((1 + GRID.r[: GRID.n_r]) ** 4, GRID.shape[1])
    residual = np.where(free, near.times(expected), 0.0)
    step = equation.step(np.linalg.solve(matrix_of(equation, free.size), equation.right(residual)))
    assert step == pytest.approx(expected, rel=1e-6, abs=1e-9)
    assert old.operator(expected) != pytest.approx(equation.operator(expected), rel=1e-4)  # the old one is left as it was


@pytest.mark.parametrize("problem", PROBLEMS)
def test_its_unknowns_are_relative_changes_of_the_film(problem):
    """What the step in pressures does to the film is about what the unknown says; S overrates long waves."""
    at, free = linearised(problem)
    equation, film = at.equation(np.ones_like(free)), at.film[: GRID.n_unknown]
    unknown = np.zeros(free.size)
    unknown[: GRID.n_unknown] = np.exp(-(((GRID.r[: GRID.n_r, None] - 0.6) / 0.3) ** 2) - GRID.theta**2).ravel()
    change = at.system.film_change(equation.step(unknown))[: GRID.n_unknown] / film
    cosine = change @ unknown[: GRID.n_unknown] / np.linalg.norm(change) / np.linalg.norm(unknown)
    assert cosine > 0.8
    assert 0.5 < np.linalg.norm(change) / np.linalg.norm(unknown) < 2


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
@pytest.mark.parametrize("name", ["beta", "beta_load"])
@pytest.mark.parametrize("value", [1e-3, 1.0, 1e3, 1e6])
def test_a_dozen_iterations_suffice_at_every_beta(name, value, cavitation):
    problem = Problem(**{name: value}, cavitation=cavitation)
    history = solve_level(Regime.of(problem), grid_for(Regime.of(problem), 12)).level.history
    assert max(iteration.krylov for iteration in history) <= 15


def test_they_hardly_grow_with_the_grid():
    regime = Regime.of(Problem(beta=1e4))
    most = [max(iteration.krylov for iteration in solve_level(regime, grid_for(regime, n)).level.history) for n in (12, 24)]
    assert most[1] <= most[0] + 5
