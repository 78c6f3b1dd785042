"""The 2020 paper as published: its numerical method, whole, as the baseline for the modern solver.

`solve_relaxation` and `solve_cartesian` take a `softlube.problem.Problem` and return a `softlube.solution.Solution`;
`march_relaxation` yields one for each β.
"""

from softlube.paper.relaxation import RelaxationError, Sweeps
from softlube.paper.solver import march_relaxation, solve_cartesian, solve_relaxation

__all__ = ["RelaxationError", "Sweeps", "march_relaxation", "solve_cartesian", "solve_relaxation"]
