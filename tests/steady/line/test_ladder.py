"""Errors of a line contact: they cover what finer meshes say, and accuracies that cannot be reached are refused."""

import numpy as np
import pytest

from softlube.discretization.line.measure import LineFields, measure
from softlube.errors import NotConvergedError
from softlube.model.liquids import BarusLaw, NewtonianLaw
from softlube.model.problem import Problem
from softlube.model.quantities import LINE
from softlube.model.substrates import HalfSpaceKernel, ViscoelasticKernel
from softlube.steady.line import ladder
from softlube.steady.line.ladder import solve_on_ladder
from softlube.steady.line.march import resolved, solve_on, transferred


def random_problem(generator):
    liquid = BarusLaw(generator.uniform(0, 25)) if generator.random() < 0.3 else NewtonianLaw()
    substrate = HalfSpaceKernel()
    if generator.random() < 0.4:
        substrate = ViscoelasticKernel((generator.uniform(0.1, 0.9),), (10 ** generator.uniform(-2, 2),))
    cavitation = "reynolds" if generator.random() < 0.7 else "none"
    return Problem(beta_load=10 ** generator.uniform(-2, 6), cavitation=cavitation, substrate=substrate, liquid=liquid)


def test_errors_cover_finer_meshes():
    generator = np.random.default_rng(5)
    within, all_of_them = 0, 0
    for _ in range(8):
        problem = random_problem(generator)
        stage, quantities = solve_on_ladder(problem, 1e-3)
        mesh = stage.panels.split(np.ones(stage.panels.number, dtype=bool)).with_points(14)
        finer = resolved(solve_on(problem, mesh, transferred(stage, mesh)), 1e-7)
        exact = measure(LineFields(finer.equations, finer.state))
        within += sum(abs(q - exact[name]) <= q.error for name, q in quantities.items() if name != "load")
        all_of_them += len(quantities) - 1
        assert all(q.error <= 1e-3 * LINE[name].size(exact) for name, q in quantities.items() if not LINE[name].place)
    assert within >= 0.97 * all_of_them


def test_progress_and_refusal(monkeypatch):
    said = []
    solve_on_ladder(Problem(beta_load=100.0), 1e-5, said.append)
    assert [each.done for each in said] == [1, 2]
    assert "beta 100 solved on" in str(said[-1])
    monkeypatch.setattr(ladder, "ROUNDS", 1)
    with pytest.raises(NotConvergedError, match=r"do not reach the accuracy 1e-09: \w+ .* Try accuracy="):
        solve_on_ladder(Problem(beta_load=1e4), 1e-9)
