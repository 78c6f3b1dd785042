"""The 2020 paper as published: its numerical method, whole, as the baseline for the modern solver.

`solve_relaxation` and `solve_cartesian` take a `softlube.Problem` and return a `softlube.Solution`; `march_relaxation` yields
one for each β.
"""

from softlube.paper.method.relaxation import RelaxationError, Sweeps
from softlube.paper.method.solver import march_relaxation, solve_cartesian, solve_relaxation

__all__ = ["RelaxationError", "Sweeps", "march_relaxation", "solve_cartesian", "solve_relaxation"]
