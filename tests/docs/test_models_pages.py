"""The worked examples of docs/how-to/layers.md and docs/how-to/viscosity.md are what the command makes."""

import re
from pathlib import Path

import pytest

import softlube
from softlube.cli.main import main
from softlube.model.dry import dry_contact_at
from softlube.model.exact import HERTZ_LOAD
from softlube.model.liquids import BarusLaw
from softlube.model.substrates import LayerKernel
from softlube.theory.engineering import BETA_LOAD_OF_M, alpha_of_moes, moes_film

DOCS = Path(__file__).parents[2] / "docs"
BALL = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "100 mN"]


def test_paper_s_slab(capsys):
    assert main(["solve", *BALL, "--thickness", "2 mm"]) == 0
    said = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("Warning:"))
    text = " ".join((DOCS / "how-to" / "layers.md").read_text(encoding="utf-8").split())
    assert said in text


def test_soft_contact_and_an_oil(capsys):
    assert main(["solve", *BALL, "--pressure-viscosity", "20 GPa^-1"]) == 0
    said = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("Warning:"))
    assert said in (DOCS / "how-to" / "viscosity.md").read_text(encoding="utf-8")


def test_barus_from_python():
    beta_load = BETA_LOAD_OF_M * 20 ** (4 / 3)
    solution = softlube.solve(beta_load=beta_load, liquid=BarusLaw(float(alpha_of_moes(20, 2.5))))
    assert float(moes_film(solution.film_center, beta_load)) == pytest.approx(2.364, abs=1e-3)


def test_layer_from_python():
    solution = softlube.solve(beta=100, substrate=LayerKernel(1.0))
    assert float(solution.load) == pytest.approx(2.4097, abs=1e-4)


def test_table_of_dry_loads():
    text = (DOCS / "notes" / "layers.md").read_text(encoding="utf-8")
    row = next(line for line in text.splitlines() if line.startswith("| softlube |"))
    for chi, shown in zip((0.1, 0.2, 1 / 3, 0.5, 0.7, 1.0, 10 / 3), re.findall(r"\d+\.\d+", row), strict=True):
        assert dry_contact_at(LayerKernel(1 / chi), indentation=1.0).load / HERTZ_LOAD == pytest.approx(float(shown), rel=6e-5)
