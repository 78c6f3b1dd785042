"""Hertz limit of power-law liquids: full solutions at growing β against the inlet problem, which knows nothing of them."""

import numpy as np
import pytest

from softlube import limits
from softlube.model.liquids import NewtonianLaw, OstwaldLaw
from softlube.model.problem import Problem
from softlube.steady.solve import solve_problem

BETAS = np.array([1e4, 3e4, 1e5, 3e5, 1e6])
CASES = [(0.8, 2.0), *(pytest.param(*case, marks=pytest.mark.slow) for case in ((0.8, 0.0), (0.5, 2.0)))]


def film(beta, index, slide_to_roll):
    """Film at the centre where β is formed with the viscosity that the liquid has at the shear rate v/|h₀|."""
    liquid = OstwaldLaw(NewtonianLaw(), 1 / beta, index)
    return float(solve_problem(Problem(beta=beta, liquid=liquid, slide_to_roll=slide_to_roll)).quantities["film_center"])


@pytest.mark.parametrize(("index", "slide_to_roll"), CASES)
def test_film_of_full_solutions_tends_to_the_inlet_s(index, slide_to_roll):
    """Constant within 0.1 %, exponent of the speed within 0.001, after what is left out has been extrapolated away.

    That is the flow which the Hertz pressure drives inside the contact, a share of order β^(−1/(3n+2)) with sliding and
    β^(−1/(n(3n+2))) without, and β^(−2/(3n+2)).
    """
    found = np.array([film(beta, index, slide_to_roll) for beta in BETAS])
    first = 1 / (3 * index + 2) if slide_to_roll else 1 / (index * (3 * index + 2))
    second = 2 / (3 * index + 2)
    powers = [first, second] if abs(first - second) > 1e-9 else [first, 1.5 * first]

    def extrapolated(beta, values):
        return np.linalg.lstsq(np.stack([beta**0.0, *(beta**-power for power in powers)], axis=1), values, rcond=None)[0][0]

    ratio = found / limits.film_center_power_law(BETAS, index, slide_to_roll)
    assert extrapolated(BETAS, ratio) == pytest.approx(1, abs=1e-3)
    assert np.all(np.diff(ratio) > 0)
    exponent = np.diff(np.log(found)) / np.diff(np.log(BETAS))  # β goes like speed^(−n)
    assert -index * extrapolated(np.sqrt(BETAS[1:] * BETAS[:-1]), exponent) == pytest.approx(
        3 * index / (3 * index + 2), abs=1e-3
    )


@pytest.mark.slow
def test_film_in_pure_rolling_is_near_the_inlet_s_already():
    """What is left out is small for n = 1/2 without sliding; from β = 10⁵ on these contacts are not solved."""
    betas = np.array([1e4, 3e4])
    found = np.array([film(beta, 0.5, 0.0) for beta in betas])
    assert found / limits.film_center_power_law(betas, 0.5, 0.0) == pytest.approx(1, abs=1e-3)
    exponent = -0.5 * np.diff(np.log(found)) / np.diff(np.log(betas))
    assert exponent == pytest.approx(3 / 7, abs=1e-3)
