"""The ladder of grids: accepted where a grid is fine enough, refused with advice where none is."""

import time

import pytest

import softlube
import softlube.steady.ladder
from softlube.errors import NotConvergedError
from softlube.model.indenters import PowerShape
from softlube.model.problem import Problem
from softlube.solvers.budget import OutOfTime
from softlube.steady import level
from softlube.steady.error_estimate import GRIDS, SMOOTH
from softlube.steady.ladder import climb, ladder_of
from softlube.steady.refinements import Refinement
from softlube.steady.regime import Regime


@pytest.mark.parametrize("beta", [30.0, 1000.0, 2e4])
def test_an_accuracy_that_no_grid_reaches_is_refused_with_one_that_a_grid_reaches(monkeypatch, beta):
    monkeypatch.setattr("softlube.steady.ladder.LADDER", (11, 19, 27))
    with pytest.raises(softlube.NotConvergedError, match=r"does not reach the accuracy") as refusal:
        softlube.solve(beta=beta, accuracy=1e-4)
    advised = float(str(refusal.value).partition("Try accuracy=")[2].rstrip("."))
    assert softlube.solve(beta=beta, accuracy=advised).accuracy == advised
    with pytest.raises(softlube.NotConvergedError):
        softlube.solve(beta=beta, accuracy=0.85 * advised)


def test_a_grid_that_would_be_fine_enough_but_has_no_solution_leaves_the_advice_of_the_others(monkeypatch):
    real = softlube.steady.ladder.solve_level

    def failing(regime, grid, before=None):
        if grid.n_theta > 30:
            raise softlube.NotConvergedError("no solution")
        return real(regime, grid, before)

    monkeypatch.setattr("softlube.steady.ladder.solve_level", failing)
    with pytest.raises(softlube.NotConvergedError, match="Try accuracy="):
        softlube.solve(beta=1000, accuracy=1e-4)


def test_a_budget_that_is_spent_on_a_fine_grid_leaves_the_accuracy_of_the_others(monkeypatch):
    real = softlube.steady.ladder.solve_level

    def dear(regime, grid, before=None):
        if grid.n_theta > 30:
            raise OutOfTime
        return real(regime, grid, before)

    monkeypatch.setattr("softlube.steady.ladder.solve_level", dear)
    with pytest.raises(softlube.NotConvergedError, match="it would take more than 60 s") as refusal:
        softlube.solve(beta=1000, accuracy=1e-4)
    advised = float(str(refusal.value).partition("Try accuracy=")[2].partition(" or budget=180")[0])
    assert softlube.solve(beta=1000, accuracy=advised).accuracy == advised


def test_two_grids_tell_no_error(monkeypatch):
    monkeypatch.setattr("softlube.steady.ladder.LADDER", (11, 19))
    with pytest.raises(softlube.NotConvergedError, match="nothing tells"):
        softlube.solve(beta=1000)


def test_progress_is_reported_for_each_grid():
    lines = []
    result = softlube.solve(beta=50, progress=lines.append)
    assert len(lines) == len(result.levels)


def test_the_narrow_minimum_of_a_deep_contact_takes_no_fourth_grid():
    assert len(softlube.solve(beta_load=1.3e6).levels) == GRIDS


@pytest.mark.parametrize("exponent", [5.0, 8.0])
def test_a_very_blunt_contact_has_a_solution_on_the_coarsest_grid(exponent):
    """A grid without one is passed over."""
    regime = Regime.of(Problem(beta=3e4, indenter=PowerShape(0.1, 1.0, exponent)))
    assert next(climb(regime)).grid.n_theta == ladder_of(regime)[0] == 9


def test_a_grid_without_a_solution_is_passed_over(monkeypatch):
    """And progress says so."""
    coarsest = 9

    def solve_level(regime, grid, before):
        if grid.n_theta == coarsest:
            raise NotConvergedError("none")
        return level.solve_level(regime, grid, before)

    monkeypatch.setattr("softlube.steady.ladder.solve_level", solve_level)
    lines = []
    solution = softlube.solve(beta=100.0, progress=lines.append)
    assert "too few: no solution" in str(lines[0])
    assert min(each.n_theta for each in solution.levels) > coarsest
    assert len(solution.levels) >= GRIDS


def test_grids_too_coarse_to_be_judged_are_no_solution(monkeypatch):
    """Where a refinement forbids a verdict on every grid, nothing has accepted the result, and it is refused."""
    monkeypatch.setattr("softlube.steady.ladder.LADDER", (11, 19, 27))

    class Anywhere(Refinement):
        feature = "a feature that is everywhere"

        def determines(self, fields, values):
            return {"pressure_max": SMOOTH}

    monkeypatch.setattr("softlube.steady.refinements.KINDS", (Anywhere,))
    with pytest.raises(softlube.NotConvergedError, match="no grid is fine enough for a feature that is everywhere"):
        softlube.solve(beta=100)


@pytest.mark.slow
def test_a_contact_whose_grids_grow_too_dear_is_refused_long_before_its_budget_is_spent():
    hard = softlube.Contact(
        radius="0.115 mm",
        young_modulus="167 GPa",
        viscosity="3.46 Pa s",
        cavitation="none",
        indentation="0.233 um",
        thickness="32.4 um",
        poisson_ratio=0.3,
        pressure_viscosity="30.25 GPa^-1",
        viscosity_law="roelands",
        density_law="dowson-higginson",
        ball_young_modulus="150 GPa",
        speed="66.8 m/s",
    )
    began = time.thread_time()
    with pytest.raises(softlube.NotConvergedError, match="it would take more than 60 s"):
        hard.solve(accuracy=0.05)
    assert time.thread_time() - began < 25
