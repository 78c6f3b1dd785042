"""The numbers of a normalised problem, such as a layer's thickness or a liquid's index, and what a parameter does to them.

A layer twice as thick is, over the contact's radius, what the layer is under an eighth of the load; a relaxation time is, over
the time that the contact has, what it is under another load.  Such parameters act like another load, and curves of several
loads serve for them.  Others change numbers that no load changes, such as an index: these need curves of their own.

A curve is a function of β, which goes with the speed, and the way that a viscoelastic surface moves in its times goes with the
speed, too.  So a problem's numbers are those at the speed at which β is 1, which no speed changes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from softlube.model.problem import Problem

Array = NDArray[np.floating]
Path = tuple[str | int, ...]
"""Where a number stands in the plain values of a problem."""

SAME = 1e-9
"""Relative difference below which two numbers are one."""
WINDOW, LATTICE = 0.4, 0.1
"""How far, in logarithm, nodes reach around a number; and the steps in which their middle moves, so that curves are found
again."""
NODES = 3
"""Nodes of a number: parabolas through them in the logarithm are good to 0.5 % of the friction
(tests/experiments/test_thinning_fit.py)."""
SHARES = ("substrate", "shares")
"""Where the compliances of a viscoelastic substrate stand: neither loads nor nodes change them, as their sum is limited."""
AT_MOST_ONE = ("index", "infinite")
"""Numbers of the laws of liquids that are not above 1."""


def numbers_of(problem: Problem) -> dict[Path, float]:
    """Positive numbers of the normalised substrate, liquid and indenter at β = 1, by where they stand in the plain values."""

    def leaves(value: Any, path: Path) -> dict[Path, float]:
        if isinstance(value, Mapping):
            return {key: leaf for name, each in value.items() for key, leaf in leaves(each, (*path, name)).items()}
        if isinstance(value, list | tuple) and path[0] == "substrate":  # a measured indenter has its profile in sequences
            return {key: leaf for place, each in enumerate(value) for key, leaf in leaves(each, (*path, place)).items()}
        number = isinstance(value, int | float) and not isinstance(value, bool) and value > 0
        return {path: float(value)} if number else {}

    plain = replace(problem, substrate=problem.substrate.hastened(problem.parameter)).to_plain()
    models = ("substrate", "liquid", "indenter")
    return {path: leaf for name in models for path, leaf in leaves(plain.get(name, {}), (name,)).items()}


def with_numbers(problem: Problem, numbers: Mapping[Path, float]) -> Problem:
    """A problem with other values of some of its numbers."""
    if not numbers:
        return problem
    plain = problem.to_plain()
    for path, number in numbers.items():
        inner: Any = plain
        for name in path[:-1]:
            inner = inner[name]
        inner[path[-1]] = number
    return Problem.from_plain(plain)


def nodes_around(path: Path, number: float) -> Array:
    """Chebyshev's points in the logarithm of a number, around a value of it."""
    middle = LATTICE * round(math.log(number) / LATTICE)
    low, high = middle - WINDOW, middle + WINDOW
    limited = path[-1] in AT_MOST_ONE
    if limited:
        high = min(high, 0.0)
    places = np.exp((low + high) / 2 - (high - low) / 2 * np.cos(np.pi * np.arange(NODES) / (NODES - 1)))
    return np.minimum(places, 1.0) if limited else places


def powers(light: Mapping[Path, float], heavy: Mapping[Path, float]) -> dict[Path, float]:
    """D ln(number)/d ln(load), from the numbers under a load and under e times that."""
    return {path: math.log(heavy[path] / number) for path, number in light.items()}


def moved(
    ours: Mapping[Path, float], before: Mapping[Path, float], power: Mapping[Path, float]
) -> tuple[float | None, dict[Path, float]]:
    """What has happened to the numbers.

    Parameters
    ----------
    ours, before : mapping of path to float
        The numbers now, and before.
    power : mapping of path to float
        See `powers`.

    Returns
    -------
    factor : float or None
        Factor of the load that would have done the same to the numbers that a load changes; None if there is none.
    apart : mapping of path to float
        Numbers that have changed and that no load changes.
    """
    loads: list[float] = []
    apart: dict[Path, float] = {}
    for path, number in ours.items():
        change = math.log(number / before[path])
        if abs(power[path]) > SAME:
            loads.append(change / power[path])
        elif abs(change) > SAME:
            apart[path] = number
    if not loads:
        return 1.0, apart
    return (math.exp(loads[0]) if max(loads) - min(loads) < 1e-6 else None), apart
