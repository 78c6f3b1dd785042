"""The flow of a power-law liquid in a film against quadrature across the film, and its limits."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from softlube.errors import InputError
from softlube.theory.power_law import PowerLawFlow

X = np.geomspace(1e-9, 1e3, 60)
CASES = [(0.2, 0.01), (0.35, 2.0), (0.5, 0.5), (0.5, 2.0), (0.8, 5.0), (1.4, 2.0)]


@pytest.mark.parametrize(("index", "slide_to_roll"), CASES)
@pytest.mark.parametrize("x", [0.1, 0.3, 1.0, 5.0])
def test_backflow_by_quadrature_across_the_film(index, slide_to_roll, x):
    """In physical units: γ̇ = |τ/K|^(1/n) sign τ, τ = m + z p′, ∫γ̇ dz = ΔU, and the flux driven back is ∫zγ̇ dz."""
    film, mean_speed, consistency = 0.7, 1.3, 2.1
    unit = consistency * (2 * mean_speed / film) ** index
    gradient = 2 * unit / film * x * ((2 * index + 1) / index) ** index

    def across(moment, middle):
        zero = np.clip(-middle / gradient, -film / 2, film / 2)
        parts = [(-film / 2, zero), (zero, film / 2)]
        return sum(
            quad(
                lambda z: (
                    z**moment * np.sign(middle + z * gradient) * abs((middle + z * gradient) / consistency) ** (1 / index)
                ),
                *part,
                epsabs=0,
                epsrel=1e-11,
            )[0]
            for part in parts
        )

    highest = 10 * (gradient * film + unit * (1 + slide_to_roll) ** index)
    middle = brentq(lambda at: across(0, at) - slide_to_roll * mean_speed, 0, highest, xtol=1e-14 * highest)
    found, _ = PowerLawFlow(index, slide_to_roll).backflow(np.array(x))
    assert found * film * mean_speed == pytest.approx(across(1, middle), rel=1e-9)


@pytest.mark.parametrize(("index", "slide_to_roll"), [*CASES, (0.5, 0.0)])
def test_gradient_is_the_inverse(index, slide_to_roll):
    flow = PowerLawFlow(index, slide_to_roll)
    c, slope = flow.backflow(X)
    x, inverse_slope = flow.gradient(c)
    assert x == pytest.approx(X, rel=1e-12)
    assert slope * inverse_slope == pytest.approx(np.ones_like(X), rel=1e-12)
    h = 1e-5
    numerical = (flow.backflow(X * (1 + h))[0] - flow.backflow(X * (1 - h))[0]) / (2 * h * X)
    assert slope == pytest.approx(numerical, rel=1e-6)
    assert flow.backflow(-X)[0] == pytest.approx(-c)
    assert flow.gradient(-c)[0] == pytest.approx(-x)


def test_limits():
    assert PowerLawFlow(1.0, 2.0).backflow(X)[0] == pytest.approx(X)
    assert PowerLawFlow(0.5, 0.0).backflow(X)[0] == pytest.approx(X**2)
    assert PowerLawFlow(0.5, 1e-9).backflow(X[X > 1e-3])[0] == pytest.approx(X[X > 1e-3] ** 2, rel=1e-5)
    nearly = PowerLawFlow(1 - 1e-9, 2.0).backflow(X)[0]
    assert nearly == pytest.approx(X, rel=1e-7)


def test_a_small_gradient_meets_the_viscosity_of_the_sheared_film():
    """Sliding alone has the rate ΔU/u; the gradient adds to its stress, of which dτ/dγ̇ is n times the ratio."""
    index, slide_to_roll = 0.6, 2.0
    found, _ = PowerLawFlow(index, slide_to_roll).backflow(np.array(1e-8))
    # 2c = t ∫ξ² dξ/(n m^(1 − 1/n)) with m = (Σ/2)ⁿ
    t = 1e-8 * ((2 * index + 1) / index) ** index
    assert found == pytest.approx(t / (3 * index) * (slide_to_roll / 2) ** (1 - index), rel=1e-6)


@pytest.mark.parametrize(("index", "slide_to_roll"), [(0.0, 1.0), (5.0, 1.0), (float("nan"), 1.0), (0.5, -1.0), (0.5, 1e6)])
def test_refusals(index, slide_to_roll):
    with pytest.raises(InputError, match=r"index|slide_to_roll"):
        PowerLawFlow(index, slide_to_roll)
