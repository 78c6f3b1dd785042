"""Constant viscosity is what the other laws become without their dependence on the pressure."""

import pytest

from softlube.model.liquids import BarusLaw, Newtonian, NewtonianLaw
from softlube.model.problem import Problem
from softlube.steady.level import solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime


def test_no_pressure_dependence_is_constant_viscosity():
    problem = Problem(beta=200.0)
    grid = grid_for(Regime.of(problem), 18)
    plain = solve_level(Regime.of(problem), grid).level.values
    for law in (BarusLaw(0.0), BarusLaw(1e-9)):
        level = solve_level(Regime.of(Problem(beta=200.0, liquid=law)), grid).level.values
        for name, value in plain.items():
            assert level[name] == pytest.approx(value, rel=1e-6, abs=1e-9), name


def test_the_part_is_the_law_in_si():
    assert Newtonian("2000 cP").viscosity == pytest.approx(2)
    assert Newtonian(2.0).law(1e6) == NewtonianLaw()
