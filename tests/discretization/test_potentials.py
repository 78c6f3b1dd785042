"""Potentials of rings against quadrature and a closed form."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from softlube.discretization.potentials import ring_kernels
from softlube.model.exact import disc_displacement


@pytest.mark.parametrize(("r", "source"), [(1.0, 1.0001), (1.0, 1.02), (0.3, 0.5), (0.01, 2.0), (5.0, 1.0), (20.0, 0.02)])
def test_ring_kernels_against_quadrature(r, source):
    kernels = ring_kernels(np.arange(31), np.array(r), np.array(source))
    for m in (0, 1, 2, 7, 30):
        # ∫ cos mφ/|x − x'| dφ = c^{-1/2} ∫ ..., with the near-singularity at φ = 0 resolved by φ = sinh-like breakpoints
        width = abs(r - source) / np.sqrt(r * source)
        points = np.unique(np.clip([0, width, 5 * width, 30 * width, np.pi], 0, np.pi))
        expected = 2 * sum(
            quad(
                lambda phi, m=m: np.cos(m * phi) / np.sqrt((r - source) ** 2 + 4 * r * source * np.sin(phi / 2) ** 2),
                low,
                high,
                limit=400,
                epsabs=1e-13,
            )[0]
            for low, high in itertools.pairwise(points)
        )
        assert kernels[m] == pytest.approx(expected, rel=1e-9, abs=1e-11 * kernels[0])


def test_uniform_pressure_on_a_disc_from_the_kernel():
    r = 0.6
    total = sum(
        quad(lambda s: float(ring_kernels(np.arange(1), np.array(r), np.array(s))[0]) * s, low, high, limit=200)[0]
        for low, high in ((0, r), (r, 1))
    )
    assert -total == pytest.approx(disc_displacement(r), rel=1e-9)
