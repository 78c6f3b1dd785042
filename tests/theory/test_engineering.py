"""Formulas against numbers worked out by hand from the publications' definitions, and against the solver."""

import numpy as np
import pytest

import softlube
from softlube import engineering


def test_circular_contact_in_round_numbers():
    """The forms in which textbooks quote them: 2.8 U^0.65 W^−0.21 and 3.3 U^0.64 W^−0.22."""
    assert engineering.hamrock_dowson_min(1.0, 1.0) == pytest.approx(2.80, abs=0.01)
    assert engineering.hamrock_dowson_center(1.0, 1.0) == pytest.approx(3.34, abs=0.01)
    assert engineering.hamrock_dowson_min(2e-8, 1e-3, 6.0) > engineering.hamrock_dowson_min(2e-8, 1e-3)


def test_moes_asymptotes():
    """For a circular contact 41.4 M^−2 (rigid), 2.42 M^−2/15 (elastic), 0.91 L^2/3 and 1.25 M^−1/12 L^3/4 (piezo-viscous)."""
    assert engineering.nijenbanning_venner_moes(1e7) / 1e7 ** (-2 / 15) == pytest.approx(2.42, rel=0.02)
    # the rigid asymptote is reached where H is large against h00 = 1.8, the film of vanishing load
    m = 1e-3
    assert engineering.nijenbanning_venner_moes(m) * m**2 == pytest.approx(41.4, rel=0.01)
    assert engineering.nijenbanning_venner_moes(1e7, 100.0) == pytest.approx(1.25 * 1e7 ** (-1 / 12) * 100**0.75, rel=0.01)
    assert engineering.nijenbanning_venner_moes(1e3, 1e5) == pytest.approx(0.91 * 1e5 ** (2 / 3), rel=0.01)
    assert engineering.nijenbanning_venner_moes([100.0], [0.0])[0] == engineering.nijenbanning_venner_moes(100.0)


def test_parameters_of_a_physical_contact():
    """U, W and M from SI values against the conversion from β."""
    radius, shear, viscosity, speed, load = 2e-3, 1e6, 2.0, 1e-4, 0.1
    contact = softlube.Contact(radius=radius, shear_modulus=shear, viscosity=viscosity, speed=speed, load=load)
    solution = contact.solve()
    modulus = 2 * 3 * shear / (1 - 0.25)
    u, w = viscosity * speed / 2 / (modulus * radius), load / (modulus * radius**2)
    assert engineering.moes_load(solution.beta_load) == pytest.approx(w * (2 * u) ** -0.75, rel=1e-9)
    film = float(solution.dimensional["film_center"])
    expected = film / radius / np.sqrt(2 * u)
    assert engineering.moes_film(solution.film_center, solution.beta_load) == pytest.approx(expected, rel=1e-6)
    by_depth = solution.normalised("indentation")["film_center"]
    assert engineering.moes_film(by_depth, solution.beta) == pytest.approx(expected, rel=1e-6)


def test_formulas_describe_the_solutions_within_their_range(solution):
    m = engineering.moes_load(solution.beta_load)
    film = engineering.moes_film(solution.film_center, solution.beta)
    thinnest = engineering.moes_film(solution.film_min, solution.beta)
    assert film == pytest.approx(engineering.nijenbanning_venner_moes(m), rel=0.1)
    speed = 2e-8
    load = m * (2 * speed) ** 0.75
    assert engineering.LOADS_OF_HAMROCK_DOWSON[0] < load < engineering.LOADS_OF_HAMROCK_DOWSON[1]
    assert thinnest * np.sqrt(2 * speed) == pytest.approx(engineering.hamrock_dowson_min(speed, load), rel=0.05)
    assert film * np.sqrt(2 * speed) == pytest.approx(engineering.hamrock_dowson_center(speed, load), rel=0.15)
