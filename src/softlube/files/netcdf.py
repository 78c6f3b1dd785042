"""Files: a solution as NetCDF, written whole or not at all."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from dataclasses import asdict
from functools import partial
from typing import Any, TypeVar

import numpy as np
import xarray as xr

from softlube.discretization.fields import Chart, Fields
from softlube.discretization.grid import PolarGrid
from softlube.errors import InputError
from softlube.files.cf import ANGLE, AXES, ERROR, about, head, plane, schema_of, with_error
from softlube.files.consistency import ROUND_OFF, check_consistency, check_grid
from softlube.files.hdf5 import GREATEST, Content, Rule, Variable, check, read
from softlube.files.reading import Damaged
from softlube.files.writing import check_destination, netcdf, write_whole
from softlube.model.problem import Problem
from softlube.model.quantities import FIELDS, QUANTITIES, STEADY, Quantity
from softlube.physical.contact import Contact
from softlube.solvers.newton import Iteration
from softlube.steady.level import Level, Record, SavedRecord
from softlube.steady.solution import Solution

Made = TypeVar("Made")

SI_SUFFIX = "_SI"
OTHER_SUFFIX = "_other"
POLAR = "plain polar coordinates"
RENAMED = {"layer": "edge_width", "side_layer": "side_width", "crowding": "side_clustering", "crest_layer": "crest_width"}
"""Fields of `PolarGrid` as development versions of 0.2.0 called them, and their present names."""
PLANE = ("r", "theta")
SCHEMA = {
    "r": Rule(("r",), "not negative"),
    "theta": Rule(("theta",)),
    "pressure": Rule(PLANE),
    "film": Rule(PLANE, "positive"),
    "displacement": Rule(PLANE),
} | dict.fromkeys(STEADY, Rule((), gaps=True))
"""Arrays of a solution's file, normalised; a quantity that is not given is nan."""
UNKNOWN = (InputError, TypeError, KeyError, ValueError, AttributeError, IndexError, OverflowError, RecursionError)
"""What is raised where plain values of a file make no problem, contact, grid or level."""


def _plain(level: Level) -> dict[str, Any]:
    """A level without its fields, in plain values."""
    kept = {name: value for name, value in vars(level).items() if name != "fields"}
    return kept | {"values": dict(level.values), "history": [record.summary() for record in level.history]}


def to_dataset(solution: Solution) -> xr.Dataset:
    """Fields, quantities, inputs and version as one Dataset.

    Fields are on (r, theta), 0 ≤ θ ≤ π from the inlet, with x = r cos θ and y = r sin θ, normalised like the solution's
    quantities, each of which has its error beside it: ``film_min`` and ``film_min_error``.  Names ending in ``_other`` are
    normalised the other way (see `Solution.normalised`), those ending in ``_SI`` are in SI units if the input was physical.
    """
    fields = solution.fields
    displacement = (fields.height + solution.problem.indenter.height(fields.r[:, None])) - fields.film
    values = {"pressure": fields.pressure, "film": fields.film, "displacement": displacement}
    planes = values if fields.recovery is None else values | {"recovery": fields.recovery}
    data: dict[str, xr.DataArray] = {name: xr.DataArray(each, dims=PLANE, attrs=about(name)) for name, each in planes.items()}
    own, other = ("load", "indentation") if solution.problem.load_controlled else ("indentation", "load")
    families = ((solution.quantities, ""), (solution.other_quantities, OTHER_SUFFIX), (solution.dimensional, SI_SUFFIX))
    for quantities, suffix in families:
        for name, quantity in quantities.items():
            data |= with_error(name, quantity, suffix)
    coordinates: dict[str, xr.DataArray] = {
        "r": xr.DataArray(fields.r, dims="r", attrs=about("r")),
        "theta": xr.DataArray(fields.theta, dims="theta", attrs=AXES["theta"]),
    }
    coordinates |= {
        name: xr.DataArray(each, dims=PLANE, attrs=about(name) | AXES[name])
        for name, each in plane(fields.r, fields.theta).items()
    }
    chart = fields.chart
    attributes = head(f"Lubricated sliding of {solution.problem.indenter.words} on {solution.problem.substrate.words}") | {
        "method": solution.method,
        "beta": solution.beta,
        "beta_load": solution.beta_load,
        "height": fields.height,
        "normalisation": own,
        "other_normalisation": other,
        "cavitation": solution.problem.cavitation,
        "accuracy": solution.accuracy,
        "problem": json.dumps(solution.problem.to_plain()),
        "grid": json.dumps(asdict(chart)) if isinstance(chart, PolarGrid) else POLAR,
        "levels": json.dumps([_plain(level) for level in solution.levels], default=float),
        "warnings": json.dumps(list(solution.warnings)),
    }
    if solution.contact is not None:
        contact = solution.contact
        attributes["inputs_SI"] = json.dumps(contact.inputs())
        scales = contact.scales(contact.unit_height)
        for family, names in ((data, values), (coordinates, ("r", "x", "y"))):
            for name in names:
                scale, unit = scales[FIELDS[name].dimension]
                own_unit = family[name]
                attrs = about(name, unit)
                family[name + SI_SUFFIX] = xr.DataArray(own_unit.values * scale, dims=own_unit.dims, attrs=attrs)
    return xr.Dataset(data, coords=coordinates, attrs=attributes)


def contents(solution: Solution) -> bytes:
    """What `save` writes."""
    return netcdf(to_dataset(solution))


def save(solution: Solution, path: str | os.PathLike[str]) -> None:
    """Write a solution as NetCDF 4.

    Raises
    ------
    InputError, OSError
        See `softlube.files.writing`.
    """
    write_whole({check_destination("output", path): contents(solution)})


def load(path: str | os.PathLike[str] | bytes) -> Solution:
    """Read a solution written by `save` or ``softlube solve --output``.

    All is checked before it is used: that each variable is there and has its shape, that axes increase, films are positive and
    numbers finite, and that fields, quantities and inputs fit together (`softlube.files.consistency`).

    Parameters
    ----------
    path : path or bytes
        The file, or all of its bytes.

    Raises
    ------
    InputError
        If the file is missing, was not written by softlube, or is damaged or edited; the message names the variable.
    """
    try:
        return _solution(read(path))
    except Damaged as error:
        raise error.about("fields: what the store has" if isinstance(path, bytes) else f"path: {os.fspath(path)!r}") from None


def _solution(content: Content) -> Solution:
    attributes = content.attributes
    if "softlube_version" not in attributes or not attributes.get("grid"):
        raise Damaged("does not hold a solution that softlube can take up again")
    if "height" not in attributes:
        raise Damaged("was written by an earlier version of softlube; solve and save it again")
    schema = schema_of(attributes)
    # Development versions of 0.2.0 said "fluid" for "liquid".
    problem = _read("problem", lambda: Problem.from_plain(json.loads(attributes["problem"].replace('"fluid"', '"liquid"'))))
    arrays = SCHEMA if problem.substrate.memory is None else SCHEMA | {"recovery": Rule(PLANE)}
    check(content, arrays)
    fields = {name: content.variables[name].values for name, rule in arrays.items() if rule.axes}
    families: dict[str, dict[str, Quantity]] = {"": {}, OTHER_SUFFIX: {}, SI_SUFFIX: {}}
    for name, found in content.variables.items():
        suffix = next((each for each in (SI_SUFFIX, OTHER_SUFFIX) if name.endswith(each)), "")
        if not found.values.ndim and name.removesuffix(suffix) in QUANTITIES:
            base = name.removesuffix(suffix)
            error = content.variables.get(base + ERROR + suffix)
            if error is None and schema > 1:
                raise Damaged(f"{base}{ERROR}{suffix}: missing")
            families[suffix][base] = _read(name, lambda found=found, error=error: _quantity(found, error))
    grid, method = str(attributes["grid"]), str(attributes.get("method"))
    solution = Solution(
        problem=problem,
        fields=Fields(
            chart=_read("grid", lambda: _chart(grid, fields["film"].shape)),
            r=fields["r"],
            theta=fields["theta"],
            pressure=fields["pressure"],
            film=fields["film"],
            beta=problem.parameter,
            cavitation=problem.cavitation,
            load=float(families[""]["load"]),
            height=_number(attributes, "height"),
            liquid=problem.liquid,
            indenter=problem.indenter,
            slide_to_roll=problem.slide_to_roll,
            recovery=fields.get("recovery"),
        ),
        quantities=families[""],
        beta=_number(attributes, "beta"),
        beta_load=_number(attributes, "beta_load"),
        accuracy=_number(attributes, "accuracy"),
        levels=_read("levels", lambda: _levels(json.loads(attributes["levels"]), method)),
        method=method,
        contact=_read("inputs_SI", lambda: Contact.from_inputs(json.loads(attributes["inputs_SI"])))
        if "inputs_SI" in attributes
        else None,
        dimensional=families[SI_SUFFIX],
        renormalise=partial(dict, families[OTHER_SUFFIX]),
        warnings=_read("warnings", lambda: tuple(map(str, json.loads(attributes["warnings"])))),
    )
    check_consistency(solution, fields["displacement"])
    _check_copies(content, solution, schema)
    return solution


def _check_copies(content: Content, solution: Solution, schema: int) -> None:
    """Refuse a file whose arrays that follow from others, such as coordinates and fields in SI, do not."""
    for name, expected in to_dataset(solution).variables.items():
        found = content.variables.get(str(name))
        if found is None and (schema == 1 or name in SCHEMA):
            continue  # earlier versions did not write it, or it is none of this method's
        if found is None:
            raise Damaged(f"{name}: missing")
        if found.values.shape != expected.shape or not np.allclose(
            found.values, expected.to_numpy(), rtol=ROUND_OFF, atol=1e-300, equal_nan=True
        ):
            raise Damaged(f"{name}: does not follow from the other numbers of the file")


def _read(name: str, make: Callable[[], Made]) -> Made:
    """What a variable or an attribute says, refused by its name if that makes no sense here."""
    try:
        return make()
    except Damaged:
        raise
    except UNKNOWN as error:
        raise Damaged(f"{name}: holds what this version of softlube does not know ({error})") from None


def _number(attributes: Mapping[str, Any], name: str) -> float:
    number = _read(name, lambda: float(attributes[name]))
    if abs(number) > GREATEST:
        raise Damaged(f"{name}: expected a finite number, got {number:g}")
    return number


def _quantity(found: Variable, error: Variable | None) -> Quantity:
    """A value with its error, which stands among the attributes in files of the first schema."""
    unit = str(found.attributes["units"])
    doubt = found.attributes["error"] if error is None else error.values
    return Quantity(float(found.values), float(doubt), "" if unit in ("1", ANGLE) else unit)


def _chart(stored: str, shape: tuple[int, ...]) -> Chart:
    """The coordinates of the fields, from the attribute "grid"."""
    if stored == POLAR:
        from softlube.discretization.chart import PolarChart

        return PolarChart()
    grid = PolarGrid(**{RENAMED.get(name, name): value for name, value in json.loads(stored).items()})
    check_grid(grid, shape)
    return grid


def _levels(stored: list[dict[str, Any]], method: str) -> tuple[Level, ...]:
    """Grids on the way, with summaries of what the method did."""

    def record(summary: dict[str, Any]) -> Record:
        return Iteration(**summary) if method == "newton" else SavedRecord(summary)

    return tuple(Level(**(level | {"history": tuple(map(record, level["history"]))})) for level in stored)
