"""Barus' law in a contact, and where it does not matter."""

import json

import pytest

import softlube
from softlube.cli.main import main
from softlube.model.liquids import Barus, BarusLaw
from softlube.theory.engineering import BETA_LOAD_OF_M, alpha_of_moes, moes_film, nijenbanning_venner_moes

BALL = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "100 mN"]


def test_a_thickening_liquid_makes_a_thicker_film_and_more_friction():
    m, material = 20.0, 2.5
    beta_load = BETA_LOAD_OF_M * m ** (4 / 3)
    plain = softlube.solve(beta_load=beta_load)
    thick = softlube.solve(beta_load=beta_load, liquid=BarusLaw(float(alpha_of_moes(m, material))))
    assert thick.film_center > plain.film_center
    assert thick.friction_domain > 1.5 * plain.friction_domain
    # The published formula is a fit over all M and L; without pressure dependence it is as far off here.
    for solution, parameter in ((plain, 0.0), (thick, material)):
        ours = moes_film(solution.film_center, beta_load)
        assert ours == pytest.approx(float(nijenbanning_venner_moes(m, parameter)), rel=0.15)


def test_the_command_says_when_it_does_not_matter(capsys):
    assert main(["solve", *BALL, "--pressure-viscosity", "20 GPa^-1"]) == 0
    assert "the viscosity rises by 0.86 % at most" in capsys.readouterr().out
    assert main(["solve", *BALL, "--pressure-viscosity", "20 GPa^-1", "--viscosity-law", "roelands", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["quantities"]["film_min"]["value"] > 0


def test_the_part_is_the_law_in_si():
    part = Barus("2 Pa s", pressure_viscosity="20 GPa^-1")
    assert part.law(1e9).alpha == pytest.approx(20)
    assert part.viscosity == 2
    assert isinstance(part.law(1.0), BarusLaw)
