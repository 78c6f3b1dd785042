"""The density of mineral oils: as published, and what it does to film and mass."""

from dataclasses import replace

import numpy as np
import pytest

import softlube
from softlube.cli.main import main
from softlube.model.liquids import BarusLaw, DowsonHigginson, DowsonHigginsonLaw, NewtonianLaw
from softlube.model.problem import Problem
from softlube.readout.flow import net_flux
from softlube.steady.level import solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime

BALL = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "100 mN"]


def test_density_of_dowson_and_higginson():
    """ρ/ρ₀ = (0.59 + 1.34 p)/(0.59 + p) with p in GPa, as published; its derivative; and never a hole under tension."""
    law = DowsonHigginsonLaw.of(NewtonianLaw(), 1e9)
    p = np.array([0.0, 0.3, 1.1])
    assert law.density(p)[0] == pytest.approx((0.59 + 1.34 * p) / (0.59 + p))
    p, step = np.array([-0.5, 0.2, 0.9]), 1e-6
    assert law.density(p)[1] == pytest.approx((law.density(p + step)[0] - law.density(p - step)[0]) / (2 * step), abs=1e-9)
    assert law.density(np.array([-10.0]))[0] > 0.5
    assert law.in_units(4.0).density(p / 2)[0] == pytest.approx(law.density(p)[0])


def test_a_stiff_liquid_is_incompressible():
    problem = Problem(beta=200.0, liquid=BarusLaw(3.0))
    grid = grid_for(Regime.of(problem), 18)
    plain = solve_level(Regime.of(problem), grid).level.values
    stiff = solve_level(Regime.of(Problem(beta=200.0, liquid=DowsonHigginsonLaw(BarusLaw(3.0), 1e7))), grid).level.values
    for name, value in plain.items():
        assert stiff[name] == pytest.approx(value, rel=1e-6, abs=1e-9), name


def test_a_denser_liquid_makes_a_thinner_film_and_keeps_its_mass():
    """The film under the centre is thinner, but not by the whole of the density there: what comes in is denser, too."""
    beta, liquid = 100.0, DowsonHigginsonLaw(BarusLaw(3.0), 0.3)
    plain, dense = (softlube.solve(beta, liquid=liquid, cavitation="none", accuracy=1e-4) for liquid in (BarusLaw(3.0), liquid))
    density = float(liquid.density(np.array([dense.pressure_center]))[0][0])
    assert density > 1.1
    assert plain.film_center / density < dense.film_center < 0.95 * plain.film_center
    for radius in (0.4, 0.8, 1.5):
        assert abs(net_flux(dense, radius)) < 5e-5
        # Volume alone does not balance.
        assert abs(net_flux(replace(dense, fields=replace(dense.fields, liquid=BarusLaw(3.0))), radius)) > 1e-3


def test_the_command_says_when_the_density_does_not_matter(capsys):
    assert main(["solve", *BALL, "--density-law", "dowson-higginson"]) == 0
    assert "the density rises by 0.0" in capsys.readouterr().out


def test_the_part_is_the_law_in_si():
    part = DowsonHigginson("870 kg/m^3")
    assert part.density == 870
    assert part.law(NewtonianLaw(), 1e9) == DowsonHigginsonLaw(NewtonianLaw(), 0.59)
