"""The flux that the pressure drives along a line, of any liquid, and what lies beyond the mesh where the film opens."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from softlube.model.film_section import EXACT, Section, film_section
from softlube.model.liquids import Liquid
from softlube.model.problem import Problem

Array = NDArray[np.floating]

STEPS = 60
"""Steps of Newton's method at most for the gradient far away; a few are usual."""


class Driven(NamedTuple):
    """β times what the pressure drives, β u³ φ p′ at constant viscosity, and its derivatives."""

    flux: Array
    by_gradient: Array
    by_film: Array
    by_pressure: Array


def slip(problem: Problem) -> float:
    """What the walls' speeds differ by, S/2 of their sum, over β: the shear stress times the film at constant viscosity."""
    return problem.slide_to_roll / 2 / problem.parameter


def section_of(problem: Problem, film: Array, gradient: Array, pressure: Array) -> Section:
    """The flow across the film of a liquid that thins with shear."""
    fluidity, _ = problem.liquid.fluidity(pressure)
    difference = np.stack([6 * film * gradient, np.zeros(film.size)])
    return film_section(problem.liquid, difference, slip(problem) / (film * fluidity), EXACT)


def driven(problem: Problem, film: Array, gradient: Array, pressure: Array) -> Driven:
    """What the pressure drives at some places.

    A liquid that thins with shear has φu²m/6 in place of φu³p′, m(6up′, ΔU/u) the law of its flux.

    Parameters
    ----------
    problem : Problem
        With β, the liquid and the slide-to-roll ratio.
    film, gradient, pressure : ndarray, shape (n,)
        u, p′ and p.
    """
    beta, liquid = problem.parameter, problem.liquid
    fluidity, slope = liquid.fluidity(pressure)
    if not liquid.thins:
        mobility = beta * film**3 * fluidity
        return Driven(mobility * gradient, mobility, 3 * mobility / film * gradient, beta * film**3 * slope * gradient)
    section = section_of(problem, film, gradient, pressure)
    moment, by_difference = section.moment[0], section.by_difference[0, 0]
    by_drag = section.by_drag[0] * slip(problem) / (film * fluidity)  # times the drag
    return Driven(
        flux=beta * film**2 * fluidity * moment / 6,
        by_gradient=beta * film**3 * fluidity * by_difference,
        by_film=beta * film * fluidity / 6 * (2 * moment + by_difference * 6 * film * gradient - by_drag),
        by_pressure=beta * film**2 * slope / 6 * (moment - by_drag),
    )


def mean_stress(problem: Problem, film: Array, gradient: Array, pressure: Array) -> Array:
    """Mean shear stress across the film, (η/η₀)S/(2βu) at constant viscosity; the shear stress on a wall is this ± 3up′."""
    liquid = problem.liquid
    if liquid.thins:
        stress = section_of(problem, film, gradient, pressure).mean[0]
    else:
        stress = liquid.viscosity(pressure) * slip(problem) / film
    return liquid.limited(stress, pressure)


def largest_shear_rate(problem: Problem, film: Array, gradient: Array, pressure: Array) -> Array:
    """Larger of the shear rates on the two walls, over v over the unit of height."""
    fluidity, _ = problem.liquid.fluidity(pressure)
    half = 3 * film * np.abs(gradient)
    if not problem.liquid.thins:
        return abs(problem.slide_to_roll) / 2 / film + problem.parameter * fluidity * half
    stress = np.abs(section_of(problem, film, gradient, pressure).mean[0]) + half
    return problem.parameter * fluidity * stress * np.exp(problem.liquid.fluidity_at(np.maximum(stress, 1e-150))[0])


class Beyond(NamedTuple):
    """What lies beyond an end of the mesh, where u = x²/2.

    Attributes
    ----------
    pressure : float
        At the end: 4/(3βx³) at constant viscosity.
    load : float
        ∫ p dx, 2/(3βx²).
    couette, poiseuille : float
        ∫ of the mean shear stress, 2/(βx), and of 3up′, −6/(βx); infinite for power laws with an index up to 1/2.
    """

    pressure: float
    load: float
    couette: float
    poiseuille: float


NOTHING = Beyond(0.0, 0.0, 0.0, 0.0)
"""Beyond a free boundary."""


def beyond(problem: Problem, x: float) -> Beyond:
    """What lies beyond a place x far from the contact, upstream (x > 0) or downstream.

    There the pressure drives the flux −u, and a liquid is one of a power law with some index n, of shear rates that fall with
    x⁻²: so p′ goes with x^(−2n−2).
    """
    film = x**2 / 2
    liquid, rate = problem.liquid, 1 / (problem.parameter * film)
    index = 1.0
    gradient = -1 / (problem.parameter * film**2)
    if liquid.thins:
        near = rate * np.array([0.99, 1.01])
        index = float(np.diff(np.log(liquid.flow_curve(near)))[0] / np.diff(np.log(near))[0])
        gradient = _far_gradient(problem, film, gradient, liquid)
    zero = np.zeros(1)
    stress = float(mean_stress(problem, np.array([film]), np.array([gradient]), zero)[0])
    pressure, shears = -gradient * x / (2 * index + 1), 2 * index - 1
    length = abs(x) / shears if shears > 1e-6 else math.inf
    couette = stress * length if stress else 0.0
    return Beyond(pressure, pressure * abs(x) / (2 * index), couette, 3 * film * gradient * length)


def _far_gradient(problem: Problem, film: float, gradient: float, liquid: Liquid) -> float:
    """P′ where the pressure drives the flux −u, by Newton's method in its logarithm."""
    one, zero = np.array([film]), np.zeros(1)
    gradient *= float(np.exp(-liquid.fluidity_at(np.array([6 * film * abs(gradient)]))[0][0]))
    for _ in range(STEPS):
        found = driven(problem, one, np.array([gradient]), zero)
        left = math.log(-float(found.flux[0]) / film)
        step = left * float(found.flux[0]) / (gradient * float(found.by_gradient[0]))
        gradient *= math.exp(-min(max(step, -3.0), 3.0))
        if abs(step) < 1e-12:
            break
    return gradient
