"""Flow of a power-law liquid in a thin film along one direction, in closed form: what the inlet problem asks of a liquid.

With τ = K γ̇|γ̇|^(n−1), a pressure gradient p′ and walls of mean speed Ū whose speeds differ by ΔU = Σ Ū, the stress at the
height uξ/2 over the middle of a film u is τₘ + (u/2) p′ ξ, and with φ(y) = y|y|^(1/n−1)

    Σ = ∫₋₁¹ φ(m + tξ) dξ          fixes the mean stress m in each film
    2c = ∫₋₁¹ ξ φ(m + tξ) dξ       is the flux c·uŪ that the gradient drives back

in units of the stress K(2Ū/u)^n.  So c is a function of one variable.  That is taken as x = t [n/(2n + 1)]^n, for which
c = φ(x) in pure rolling (Σ = 0) and c = x for a Newtonian liquid (n = 1, any Σ).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError

Array = NDArray[np.floating]

SMALLEST_INDEX, LARGEST_INDEX = 0.1, 3.0
"""Power-law indices taken."""
LARGEST_SLIDE_TO_ROLL = 1e3
TINIEST = 1e-300
"""Magnitude as which a vanishing argument counts, of whose logarithm something is asked."""
SMOOTH = 1.5
"""Ratio of mean to greatest driven stress from which on φ is smooth enough across the film for Gauss's rule."""
GAUSS, WEIGHTS = np.polynomial.legendre.leggauss(40)
NEWTON_STEPS = 60
"""More than are needed: in logarithms the functions are nearly straight on both sides of a bend."""


@dataclass(frozen=True)
class PowerLawFlow:
    """Backflow of a power-law liquid under a pressure gradient, in the units of this module.

    Parameters
    ----------
    index : float
        n; 1 is a Newtonian liquid, less is a thinning one.
    slide_to_roll : float
        Σ, difference of the surface speeds over their mean, ≥ 0; 2 where one surface rests.

    Raises
    ------
    InputError
        If n is not from 0.1 to 3 or Σ not from 0 to 1000.
    """

    index: float = 1.0
    slide_to_roll: float = 0.0

    def __post_init__(self) -> None:
        if not SMALLEST_INDEX <= self.index <= LARGEST_INDEX:
            raise InputError(f"index: expected a number from {SMALLEST_INDEX:g} to {LARGEST_INDEX:g}, got {self.index!r}")
        if not 0 <= self.slide_to_roll <= LARGEST_SLIDE_TO_ROLL:
            raise InputError(
                f"slide_to_roll: expected a number from 0 to {LARGEST_SLIDE_TO_ROLL:g}, got {self.slide_to_roll!r}"
            )

    @property
    def _power(self) -> float:
        return 1 / self.index

    @property
    def _sheared(self) -> bool:
        """Whether sliding changes the backflow."""
        return self.index != 1 and self.slide_to_roll > 0

    def backflow(self, x: Array) -> tuple[Array, Array]:
        """The backflow c at gradients x, and dc/dx."""
        size, power = np.maximum(np.abs(x), TINIEST), self._power
        if not self._sheared:
            slope = size ** (power - 1)
            return x * slope, power * slope
        target = np.log(self.slide_to_roll) - power * np.log(size) - np.log(2 + power)
        start = np.where(target > 0, target * min(self.index, 1.0), target)
        mean, first, mean_slope, first_slope = self._where((1, 0), target, start)
        c = self.slide_to_roll / 2 * np.exp(first - mean)
        return np.sign(x) * c, c / size * (mean_slope - first_slope) / (self.index * mean_slope)

    def gradient(self, c: Array) -> tuple[Array, Array]:
        """The gradient x that drives a backflow c, and dx/dc; the inverse of `backflow`."""
        size = np.maximum(np.abs(c), TINIEST)
        if not self._sheared:
            slope = size ** (self.index - 1)
            return c * slope, self.index * slope
        target = np.log(2 * size / self.slide_to_roll)
        mean, _, mean_slope, first_slope = self._where((-1, 1), target, -target)
        x = np.exp(self.index * (np.log(self.slide_to_roll / (2 + self._power)) - mean))
        return np.sign(c) * x, x / size * self.index * mean_slope / (mean_slope - first_slope)

    def _where(self, weights: tuple[int, int], target: Array, start: Array) -> tuple[Array, Array, Array, Array]:
        """The moments at the ρ where a weighted sum of the logarithms of I₀ and I₁ has a value; Newton's method in ln ρ."""
        at = start
        for _ in range(NEWTON_STEPS):
            mean, first, mean_slope, first_slope = self._moments(at)
            step = (target - weights[0] * mean - weights[1] * first) / (weights[0] * mean_slope + weights[1] * first_slope)
            at = at + step
            if np.max(np.abs(step)) < 1e-13:
                break
        return self._moments(at)

    def _moments(self, log_ratio: Array) -> tuple[Array, Array, Array, Array]:
        """Logarithms of I₀ = ∫φ(ρ + ξ) dξ and I₁ = ∫ξφ(ρ + ξ) dξ over −1 < ξ < 1, and their slopes against ln ρ."""
        power, ratio = self._power, np.exp(log_ratio)
        far = ratio > SMOOTH
        near = np.where(far, 1.0, ratio)
        # Differences of powers as a hyperbolic sine, without cancellation for small ρ.
        above, below = np.log1p(near), np.log(np.maximum(np.abs(1 - near), 1e-30))
        below = np.where(near < 0.5, np.log1p(-np.minimum(near, 0.5)), below)
        middle = (power + 1) / 2
        mean = 2 * np.exp(middle * (above + below)) * np.sinh(middle * (above - below)) / (power + 1)
        sign = np.sign(1 - near)
        first = (np.exp((power + 2) * above) + sign * np.exp((power + 2) * below)) / (power + 2) - near * mean
        upper, lower = np.exp(power * above), -sign * np.exp(power * below)
        slopes = near * (upper - lower) / mean, near * (upper + lower - mean) / first
        # φ(ρ + ξ) = ρ^(1/n) (1 + ξ/ρ)^(1/n), of which I₁ sees only what differs from 1.
        distant = np.where(far, ratio, 2.0)
        logarithm = np.log1p(GAUSS / distant[..., None])
        mean_far = np.exp(power * logarithm) @ WEIGHTS
        first_far = np.expm1(power * logarithm) @ (WEIGHTS * GAUSS)
        slopes_far = (
            power * np.exp((power - 1) * logarithm) @ WEIGHTS / mean_far,
            power * np.expm1((power - 1) * logarithm) @ (WEIGHTS * GAUSS) / first_far,
        )
        scale = power * np.log(distant)
        return (
            np.where(far, scale + np.log(mean_far), np.log(mean)),
            np.where(far, scale + np.log(first_far), np.log(first)),
            np.where(far, slopes_far[0], slopes[0]),
            np.where(far, slopes_far[1], slopes[1]),
        )
