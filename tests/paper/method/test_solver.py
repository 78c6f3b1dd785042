"""The paper's method as a whole, against the modern solver."""

import numpy as np
import pytest

import softlube
from softlube.errors import InputError, NotConvergedError
from softlube.model.problem import Problem
from softlube.paper.method import RelaxationError, march_relaxation, solve_cartesian, solve_relaxation

COMPARED = ("film_center", "film_min", "load")


@pytest.fixture(scope="module")
def march():
    """The published mesh, β = 10 … 1000 in one march."""
    return {solution.beta: solution for solution in march_relaxation([10, 30, 100, 300, 1000])}


@pytest.fixture(scope="module")
def exact():
    """The modern solver's."""
    return {beta: softlube.solve(beta=beta) for beta in (10, 100, 300, 1000)}


def deviation(solution, exact):
    return {name: abs(solution.quantities[name] / exact.quantities[name] - 1) for name in COMPARED}


def test_agrees_with_the_modern_solver_within_3_percent(march, exact):
    for beta in (100, 300, 1000):
        assert max(deviation(march[beta], exact[beta]).values()) < 0.03, beta


@pytest.mark.slow
def test_the_difference_shrinks_on_a_refined_mesh(march, exact):
    refined = solve_relaxation(Problem(beta=300), n_r=75, n_theta=45)
    coarse, fine = deviation(march[300], exact[300]), deviation(refined, exact[300])
    assert fine["film_min"] < 0.65 * coarse["film_min"]
    # The rest of the load's difference is the domain's, which no refinement takes away: the pressure beyond r = 2.
    f = exact[300].fields
    assert exact[300].load - softlube.discretization.measure.load_within(f, 2.0) > 0.5 * abs(refined.load - exact[300].load)


def test_at_small_beta_the_cut_domain_dominates(march, exact):
    assert deviation(march[10], exact[10])["load"] > 0.1
    refined = solve_relaxation(Problem(beta=10), n_r=75, n_theta=45)
    assert deviation(refined, exact[10])["load"] > 0.1


def test_a_single_mesh_does_not_know_its_error_and_two_do(march, exact):
    assert np.isnan(march[100].film_center.error)
    assert march[100].method == "relaxation"
    both = solve_relaxation(Problem(beta=100), mesh_error=True)
    assert [level.n_r for level in both.levels] == [33, 50]
    # Inside the contact the mesh is what limits it.
    assert abs(both.film_min - exact[100].film_min) < 1.5 * both.film_min.error
    assert both.film_min.error < 0.1 * both.film_min


def test_without_cavitation():
    solution = solve_relaxation(Problem(beta=10, cavitation="none"))
    reference = softlube.solve(beta=10, cavitation="none")
    assert solution.fields.pressure.min() == pytest.approx(reference.fields.pressure.min(), rel=0.1)
    # The domain cut at r = 2 costs as much here as with the Reynolds condition; of the odd far field the load sees less.
    assert max(deviation(solution, reference).values()) < 0.05
    assert [run.floor for run in solution.levels[-1].history][-1] == -np.inf


def test_the_cartesian_twin(exact):
    solution = solve_cartesian(Problem(beta=100), n_x=60, n_y=30)
    assert solution.method == "cartesian"
    assert deviation(solution, exact[100])["film_center"] < 0.03
    assert deviation(solution, exact[100])["load"] < 0.03
    assert 0.002 < deviation(solution, exact[100])["film_min"] < 0.06


def test_cartesian_elasticity_dense_or_by_fft_is_one_method():
    fft, dense = (solve_cartesian(Problem(beta=10), n_x=24, n_y=12, elasticity=kind) for kind in ("fft", "dense"))
    for name in COMPARED:
        assert dense.quantities[name] == pytest.approx(fft.quantities[name], rel=1e-9)


def test_a_cold_start_at_a_large_beta_fails_with_its_history():
    with pytest.raises(NotConvergedError, match=r"did not converge at beta = 1e\+05.*no beta converged") as caught:
        solve_relaxation(Problem(beta=1e5), n_r=24, n_theta=12, cold=True)
    assert isinstance(caught.value, RelaxationError)
    history = caught.value.history
    assert len(history) > 3
    assert all(run.outcome != "converged" for run in history)
    assert history[-1].factor < 0.01
    assert str(history[-1]) in str(caught.value)


@pytest.mark.parametrize("solve", [solve_relaxation, solve_cartesian])
def test_unsuitable_problems_are_refused(solve):
    with pytest.raises(InputError, match="beta_load"):
        solve(Problem(beta_load=100))
    for beta in (9.0, 1e7):
        with pytest.raises(InputError, match="expected 10 to"):
            solve(Problem(beta=beta))


def test_impossible_meshes_are_refused():
    with pytest.raises(InputError, match="n_r"):
        solve_relaxation(Problem(beta=100), n_r=4)
    with pytest.raises(InputError, match="n_x"):
        solve_cartesian(Problem(beta=100), n_x=4)
    with pytest.raises(InputError, match="order"):
        next(march_relaxation([100, 30]))


@pytest.mark.slow
def test_one_autonomous_march_to_ten_thousand():
    betas = [10, 30, 100, 300, 1000, 3000, 10000]
    solutions = list(march_relaxation(betas))
    assert [solution.beta for solution in solutions] == betas
    for solution in solutions[2:6]:
        assert max(deviation(solution, softlube.solve(beta=solution.beta)).values()) < 0.03
    finest = deviation(solutions[-1], softlube.solve(beta=10000))
    assert finest["film_center"] < 0.01
    assert finest["film_min"] < 0.08


@pytest.mark.slow
def test_without_cavitation_at_a_larger_beta():
    solution = solve_relaxation(Problem(beta=100, cavitation="none"))
    assert solution.fields.pressure.min() < -0.05
    assert max(deviation(solution, softlube.solve(beta=100, cavitation="none")).values()) < 0.03


@pytest.mark.slow
def test_every_difference_shrinks_on_a_refined_mesh():
    for coarse, fine in zip(
        march_relaxation([10, 100, 1000]), march_relaxation([10, 100, 1000], n_r=75, n_theta=45), strict=True
    ):
        exact = softlube.solve(beta=coarse.beta)
        before, after = deviation(coarse, exact), deviation(fine, exact)
        assert all(after[name] < before[name] for name in COMPARED)
