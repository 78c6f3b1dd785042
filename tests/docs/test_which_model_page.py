"""The numbers of docs/which-model.md are those of solutions."""

import re
from pathlib import Path

import pytest

import softlube
from softlube import curve, limits

PAGE = (Path(__file__).parents[2] / "docs" / "which-model.md").read_text(encoding="utf-8")
BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s", "load": "100 mN"}


def solved(**other):
    return softlube.Contact(**{**BALL, **other}).solve().dimensional


@pytest.fixture(scope="module")
def plain():
    return solved()


@pytest.mark.parametrize(
    ("other", "film", "friction"),
    [
        ({"young_modulus": "2.6 MPa", "poisson_ratio": 0.3}, 17, 7),  # the same shear modulus
        ({"ball_young_modulus": "300 MPa"}, 0.5, 0.2),
        ({"ball_young_modulus": "3 MPa"}, 38, 14),
        ({"pressure_viscosity": "20 GPa^-1"}, 0.1, 0.4),
    ],
)
def test_changes(plain, other, film, friction):
    found = solved(**other)
    for name, shown in (("film_center", film), ("friction_total", friction)):
        change = 100 * (float(found[name] / plain[name]) - 1)
        assert change == pytest.approx(shown, abs=0.5 if shown >= 5 else 0.05), name
        assert re.search(rf"film \+?{film:g} %, friction \+?{friction:g} %", PAGE)


@pytest.mark.parametrize(("modulus", "exponent", "film", "friction"), [("30 MPa", 0.04, 0.5, 1.9), ("300 MPa", 0.18, 2.8, 9)])
def test_oil_in_harder_contacts(modulus, exponent, film, friction):
    without = solved(young_modulus=modulus)
    oil = solved(young_modulus=modulus, pressure_viscosity="20 GPa^-1")
    assert 20e-9 * float(without["pressure_max"]) == pytest.approx(exponent, abs=0.005)
    assert 100 * (float(oil["film_center"] / without["film_center"]) - 1) == pytest.approx(film, abs=0.05)
    assert 100 * (float(oil["friction_total"] / without["friction_total"]) - 1) == pytest.approx(friction, abs=0.5)
    assert f"at {exponent}: film {film} %, friction {friction} %" in PAGE


def test_frictions(plain):
    for name, shown in (("friction_domain", "−8 %"), ("friction_contact", "−11 %")):
        change = 100 * (float(plain[name] / plain["friction_total"]) - 1)
        assert f"{change:.0f} %".replace("-", "−") == shown
        assert f"| `{name}` | {shown} |" in PAGE


@pytest.mark.parametrize(("beta_load", "film", "ratio"), [(1, 5.5, 1), (10, 0.26, 0.73), (1e3, 0.016, 0.61), (1e5, None, 0.35)])
def test_kinds_of_contact(beta_load, film, ratio):
    (center, _), (least, _) = curve.film_center(beta_load=beta_load), curve.film_min(beta_load=beta_load)
    if film is not None:
        assert float(center) == pytest.approx(film, rel=0.03)
    assert float(least / center) == pytest.approx(ratio, abs=0.01)


def test_formulas():
    def off(law, beta):
        return float(getattr(limits, f"{law}_asymptote")(beta) / getattr(curve, law)(beta)[0]) - 1

    assert off("film_center", 100) == pytest.approx(-0.05, abs=0.005)
    assert off("film_center", 1e4) == pytest.approx(-0.007, abs=0.0005)
    assert off("film_min", 1e5) == pytest.approx(0.03, abs=0.005)
    assert max(abs(off("friction_contact", beta)) for beta in (1e2, 3e2, 1e3, 3e3, 1e4, 1e5)) < 0.0155
