"""Files: a solution as NetCDF, written whole or not at all."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import asdict
from functools import partial
from importlib.metadata import version
from typing import Any

import xarray as xr

from softlube.discretization.fields import Chart, Fields
from softlube.discretization.grid import PolarGrid
from softlube.errors import InputError
from softlube.files.writing import check_destination, netcdf, write_whole
from softlube.model.problem import Problem
from softlube.model.quantities import FIELDS, QUANTITIES, Quantity
from softlube.physical.contact import Contact
from softlube.solvers.newton import Iteration
from softlube.steady.level import Level, Record, SavedRecord
from softlube.steady.solution import Solution

SI_SUFFIX = "_SI"
OTHER_SUFFIX = "_other"
POLAR = "plain polar coordinates"
RENAMED = {"layer": "edge_width", "side_layer": "side_width", "crowding": "side_clustering", "crest_layer": "crest_width"}
"""Fields of `PolarGrid` as development versions of 0.2.0 called them, and their present names."""


def _plain(level: Level) -> dict[str, Any]:
    """A level without its fields, in plain values."""
    kept = {name: value for name, value in vars(level).items() if name != "fields"}
    return kept | {"values": dict(level.values), "history": [record.summary() for record in level.history]}


def _records(summaries: list[dict[str, Any]], method: str) -> tuple[Record, ...]:
    """Records of the iteration, from their summaries in a file."""
    return tuple(Iteration(**summary) if method == "newton" else SavedRecord(summary) for summary in summaries)


def _chart(stored: str) -> Chart:
    """The coordinates of the fields, from the attribute "grid"."""
    if stored == POLAR:
        from softlube.discretization.chart import PolarChart

        return PolarChart()
    return PolarGrid(**{RENAMED.get(name, name): value for name, value in json.loads(stored).items()})


def to_dataset(solution: Solution) -> xr.Dataset:
    """Fields, quantities, inputs and version as one Dataset.

    Fields are on (r, theta), 0 ≤ θ ≤ π from the inlet, normalised like the solution's quantities, which are there with their
    error among the attributes.  The same names ending in ``_other`` are normalised the other way (see `Solution.normalised`),
    those ending in ``_SI`` are in SI units if the input was physical.
    """
    fields = solution.fields
    displacement = (fields.height + fields.r[:, None] ** 2 / 2) - fields.film
    values = {"pressure": fields.pressure, "film": fields.film, "displacement": displacement}
    data: dict[str, xr.DataArray] = {
        name: xr.DataArray(values[name], dims=("r", "theta"), attrs={"long_name": FIELDS[name].words, "units": "1"})
        for name in values
    }
    own, other = ("load", "indentation") if solution.problem.load_controlled else ("indentation", "load")
    families = ((solution.quantities, ""), (solution.other_quantities, OTHER_SUFFIX), (solution.dimensional, SI_SUFFIX))
    for quantities, suffix in families:
        for name, quantity in quantities.items():
            attributes = {"long_name": QUANTITIES[name].words, "units": quantity.unit or "1"}
            data[name + suffix] = xr.DataArray(float(quantity), attrs=attributes | {"error": quantity.error})
    coordinates = {
        "r": ("r", fields.r, {"long_name": "distance from the axis over the unit of length", "units": "1"}),
        "theta": ("theta", fields.theta, {"long_name": "angle from the inlet", "units": "rad"}),
    }
    chart = fields.chart
    attributes = {
        "title": f"Lubricated sliding of a rigid sphere on {solution.problem.substrate.words}",
        "softlube_version": version("softlube"),
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
        for name in values:
            scale, unit = scales[FIELDS[name].dimension]
            attrs = {"long_name": FIELDS[name].words, "units": unit}
            data[name + SI_SUFFIX] = xr.DataArray(values[name] * scale, dims=("r", "theta"), attrs=attrs)
        length, unit = scales[FIELDS["r"].dimension]
        coordinates["r" + SI_SUFFIX] = ("r", fields.r * length, {"long_name": FIELDS["r"].words, "units": unit})
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


def load(path: str | os.PathLike[str]) -> Solution:
    """Read a solution written by `save` or ``softlube solve --output``.

    Raises
    ------
    InputError
        If the file is missing or was not written by softlube.
    """
    try:
        with xr.open_dataset(path, engine="h5netcdf") as opened:
            data = opened.load()
    except FileNotFoundError:
        raise InputError(f"path: {str(path)!r} does not exist") from None
    except OSError as error:
        raise InputError(f"path: {str(path)!r} is not a NetCDF file ({error})") from None
    if "softlube_version" not in data.attrs or not data.attrs.get("grid"):
        raise InputError(f"path: {str(path)!r} does not hold a solution that softlube can take up again")

    def read(suffix: str) -> dict[str, Quantity]:
        return {
            str(name).removesuffix(suffix): Quantity(
                float(item), item.attrs["error"], "" if item.attrs["units"] == "1" else item.attrs["units"]
            )
            for name, item in data.data_vars.items()
            if item.ndim == 0 and next((s for s in (SI_SUFFIX, OTHER_SUFFIX) if str(name).endswith(s)), "") == suffix
        }

    attrs: Mapping = data.attrs
    if "height" not in attrs:
        raise InputError(f"path: {str(path)!r} was written by an earlier version of softlube; solve and save it again")
    problem, contact = _inputs(attrs, path)
    quantities = read("")
    levels = json.loads(attrs["levels"])
    return Solution(
        problem=problem,
        fields=Fields(
            chart=_chart(attrs["grid"]),
            r=data.r.to_numpy(),
            theta=data.theta.to_numpy(),
            pressure=data.pressure.to_numpy(),
            film=data.film.to_numpy(),
            beta=problem.parameter,
            cavitation=problem.cavitation,
            load=float(quantities["load"]),
            height=float(attrs["height"]),
            liquid=problem.liquid,
        ),
        quantities=quantities,
        beta=float(attrs["beta"]),
        beta_load=float(attrs["beta_load"]),
        accuracy=float(attrs["accuracy"]),
        levels=tuple(Level(**(level | {"history": _records(level["history"], attrs["method"])})) for level in levels),
        method=str(attrs["method"]),
        contact=contact,
        dimensional=read(SI_SUFFIX),
        renormalise=partial(dict, read(OTHER_SUFFIX)),
        warnings=tuple(json.loads(attrs["warnings"])),
    )


def _inputs(attributes: Mapping[str, Any], path: str | os.PathLike[str]) -> tuple[Problem, Contact | None]:
    """The problem of a file and its physical input, if it had one.

    Raises
    ------
    InputError
        If they are of a part that is not known here, or of another version of softlube.
    """
    # Development versions of 0.2.0 said "fluid" for "liquid".
    plain = json.loads(attributes["problem"].replace('"fluid"', '"liquid"'))
    try:
        physical = json.loads(attributes["inputs_SI"]) if "inputs_SI" in attributes else None
        return Problem.from_plain(plain), None if physical is None else Contact.from_inputs(physical)
    except (InputError, TypeError, KeyError) as error:
        raise InputError(f"path: {str(path)!r} holds what this version of softlube does not know ({error})") from None
