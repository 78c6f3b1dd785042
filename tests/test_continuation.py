"""Marching in β: the same solution as a direct start, and a march that cannot go on says so."""

import numpy as np
import pytest

from softlube.continuation import march
from softlube.errors import NotConvergedError
from softlube.grid import PolarGrid
from softlube.meshing import grid_for
from softlube.newton import newton
from softlube.problem import Problem
from softlube.solver import solve_level
from softlube.system import ContactSystem


@pytest.mark.parametrize("problem", [Problem(beta=900.0), Problem(beta=2.0), Problem(beta_load=900.0)])
def test_march_ends_at_the_direct_solution(problem):
    grid = grid_for(problem, 12)
    states = list(march(problem, grid))
    system = ContactSystem(problem, grid)
    direct = newton(system, system.start())
    assert all(state.converged for state in states)
    assert len(states) == 1 + int(np.ceil(abs(np.log(problem.parameter / 30)) / np.log(3)))
    assert states[-1].x == pytest.approx(direct.x, abs=1e-9)


UNRESOLVED = Problem(beta=3e5)
COARSE = PolarGrid(9, 6, layer=0.5)


def test_a_march_that_cannot_go_on_ends_unconverged():
    states = list(march(UNRESOLVED, COARSE))
    assert states[0].converged
    assert not states[-1].converged


def test_such_a_case_is_refused_with_a_diagnosis():
    with pytest.raises(NotConvergedError, match=r"did not converge at beta = 3e\+05 on 9 x 6 cells: after \d+ steps"):
        solve_level(UNRESOLVED, COARSE, None)
