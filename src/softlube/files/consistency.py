"""Whether what a file says of a solution fits together: fields, grid, quantities, levels, inputs.

A solution says nearly everything twice.  What is measured on the fields again must be what the file says, to round-off on the
finest grid and within its error as the result; the film must be the gap that the displacement leaves.  So a number that was
changed is found, wherever it stands.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields as declared
from typing import Any

import numpy as np
from numpy.typing import NDArray

from softlube.discretization.fields import Fields
from softlube.discretization.grid import PolarGrid
from softlube.discretization.measure import measure
from softlube.errors import SoftlubeError
from softlube.files.reading import Damaged
from softlube.model.exact import HERTZ_LOAD
from softlube.model.problem import Problem
from softlube.model.quantities import QUANTITIES, Quantity
from softlube.steady.regime import Regime
from softlube.steady.solution import Solution

Array = NDArray[np.floating]

ROUND_OFF = 1e-6
"""Relative difference of two ways to the same number: round-off, and the tasks of sweeps, which are rounded."""
MOST_NODES = 1_000_000
"""Nodes of a grid that is looked at; the finest have some twenty thousand."""


def check_grid(grid: PolarGrid, shape: tuple[int, ...]) -> None:
    """Refuse a grid that is not one of fields of some shape.

    Raises
    ------
    Damaged
        If its number of nodes is another, or a parameter is no number.
    """
    for each in declared(grid):
        value = getattr(grid, each.name)
        if not isinstance(value, (int, float)) or isinstance(value, bool) or not abs(value) < np.inf:
            raise Damaged(f"grid: {each.name}: expected a finite number, got {value!r}")
    if grid.shape != shape or shape[0] * shape[1] > MOST_NODES:
        raise Damaged(f"grid: it has {grid.shape[0]} × {grid.shape[1]} nodes, and the fields {shape[0]} × {shape[1]}")


def check_consistency(solution: Solution, displacement: Array) -> None:
    """Refuse a solution whose parts contradict each other.

    Parameters
    ----------
    solution : Solution
        As a file says; numbers of its fields are finite, its film is positive.
    displacement : ndarray, shape of the fields
        Normalised surface displacement.

    Raises
    ------
    Damaged
        The message names the variable.
    """
    fields = solution.fields
    if solution.method not in ("newton", "relaxation", "cartesian"):
        raise Damaged(f"method: {solution.method!r} is none of softlube's")
    if fields.theta.size < 7 or fields.r.size < 10:
        raise Damaged(f"film: no grid of softlube is as coarse as {fields.r.size} × {fields.theta.size}")
    with np.errstate(all="ignore"):  # whatever comes of changed numbers is no reason to trust them
        for name, expected in (("theta", (0.0, np.pi)), ("beta", _betas(fields)[0]), ("beta_load", _betas(fields)[1])):
            found = (fields.theta[0], fields.theta[-1]) if name == "theta" else getattr(solution, name)
            if not np.allclose(found, expected, rtol=ROUND_OFF, atol=1e-9):
                raise Damaged(f"{name}: expected {np.round(expected, 9)}, as the fields say, got {np.round(found, 9)}")
        if isinstance(fields.chart, PolarGrid):
            for name, nodes in (("r", fields.chart.r), ("theta", fields.chart.theta)):
                _agree(name, getattr(fields, name), nodes, "the grid's node", 1e-9 + ROUND_OFF * nodes)
        gap = fields.height + solution.problem.indenter.height(fields.r[:, None]) - displacement  # Eqs. (6b) and (6c)
        _agree("film", fields.film, gap, "the gap over the displaced surface", 1e-12 * (1 + fields.r[:, None] ** 2))
        if fields.cavitation == "reynolds" and np.any(fields.pressure < 0):
            raise Damaged(f"pressure: expected none below zero, got {fields.pressure.min():g}")
        _check_quantities(solution)
        _check_physical(solution)


def _betas(fields: Fields) -> tuple[float, float]:
    """β of Eq. (6d) and by the load, Eq. (30)."""
    return fields.beta * fields.height**2, fields.beta * max(fields.load / HERTZ_LOAD, 0.0) ** (4 / 3)


def _agree(name: str, found: Array, expected: Array, what: str, tolerance: Array) -> None:
    apart = ~(np.abs(found - expected) <= tolerance)
    if apart.any():
        place = ", ".join(map(str, np.argwhere(apart)[0]))
        raise Damaged(f"{name}: at [{place}] {found[apart][0]:g} is not {what}, {expected[apart][0]:g}")


def _check_quantities(solution: Solution) -> None:
    """What is measured on the fields: on the finest level, as the result, and as the result in the other normalisation."""
    fields, problem = solution.fields, solution.problem
    if not solution.levels:
        raise Damaged("levels: expected one at least")
    on_grid, unit = solution.levels[-1].values, _other_unit(solution)
    measured = _measured(fields, problem)
    for name, value in measured.items():
        if name not in on_grid:
            raise Damaged(f"levels: expected {name} among the values of the finest")
        if not abs(on_grid[name] - value) <= ROUND_OFF * QUANTITIES[name].size(measured):
            raise Damaged(
                f"{name}: the fields say {value:.6g}, the finest level {on_grid[name]:.6g}: that or the pressure was changed"
            )
    _check_result(solution.quantities, measured, "")
    other = solution.other_quantities
    if bool(other) != (unit > 0 and solution.method == "newton"):
        raise Damaged(f"load_other: expected {'quantities in the other normalisation' if not other else 'none'}")
    if other:
        by_load = problem.load_controlled
        models: dict[str, Any] = {"substrate": problem.substrate.in_units(unit), "indenter": problem.indenter.in_units(unit)}
        there = Problem(beta=1.0 if by_load else None, beta_load=None if by_load else 1.0, **models)
        _check_result(other, _measured(fields.in_units(unit), there), "_other")


def _other_unit(solution: Solution) -> float:
    """The unit of height of the other normalisation over the solution's own; 0 where there is none."""
    height, load = solution.fields.height, solution.fields.load
    if height >= 0:
        return 0.0
    return -height if solution.problem.load_controlled else max(load / HERTZ_LOAD, 0.0) ** (2 / 3)


def _measured(fields: Fields, problem: Problem) -> dict[str, float]:
    try:
        return measure(fields, Regime.of(problem).edge_radius)
    except (SoftlubeError, ValueError, ArithmeticError, IndexError) as error:
        raise Damaged(f"pressure: nothing can be measured on the fields ({error})") from None


def _check_result(quantities: Mapping[str, Quantity], measured: Mapping[str, float], suffix: str) -> None:
    """Refuse a result that is farther than its error from what is measured; a spike's meshes know better than the grid."""
    for name, quantity in quantities.items():
        if quantity.error < 0 or np.isinf(quantity.error):
            raise Damaged(f"{name}{suffix}: expected an error of 0 or more, got {quantity.error:g}")
        if name not in measured or np.isnan(quantity) or "spike_radius" in quantities:
            continue
        value, error = measured[name], np.nan_to_num(quantity.error)
        if not abs(quantity - value) <= error + ROUND_OFF * QUANTITIES[name].size(measured):
            raise Damaged(f"{name}{suffix}: the fields say {value:.6g}, and the file {quantity}")


def _check_physical(solution: Solution) -> None:
    """What the physical input says, of the problem and of quantities in SI."""
    contact, problem = solution.contact, solution.problem
    if contact is None:
        if solution.dimensional:
            raise Damaged("inputs_SI: missing, and there are quantities in SI")
        return
    try:
        said, dimensional = contact.problem(), contact.dimensional(solution.quantities)  # type: ignore[attr-defined]
    except (SoftlubeError, ValueError, ArithmeticError) as error:
        raise Damaged(f"inputs_SI: cannot be the input of this solution ({error})") from None
    same = (said.load_controlled, said.cavitation, said.height) == (problem.load_controlled, problem.cavitation, problem.height)
    if not same or not np.isclose(said.parameter, problem.parameter, rtol=ROUND_OFF, atol=0):
        raise Damaged("inputs_SI: is the input of another problem than the one that was solved")
    for name, expected in dimensional.items():
        found = solution.dimensional.get(name)
        if found is None or found.unit != expected.unit:
            raise Damaged(f"{name}_SI: expected a quantity in {expected.unit or 1}")
        if not np.allclose([found, found.error], [expected, expected.error], rtol=ROUND_OFF, atol=0, equal_nan=True):
            raise Damaged(f"{name}_SI: expected {expected}, as the input says, got {found}")
