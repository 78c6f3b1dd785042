"""Squeeze films and starts of sliding as xarray Datasets and NetCDF files, normalised or in SI."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from softlube.files.cf import AXES, ERROR, about_error, head, plane, schema_of
from softlube.files.hdf5 import Rule, check, read
from softlube.files.reading import Damaged
from softlube.files.writing import check_destination, netcdf, write_whole
from softlube.model import indenters, substrates
from softlube.model import liquids as liquids
from softlube.model.dry import PARABOLOID
from softlube.model.quantities import QUANTITIES
from softlube.transient.extremes import Extremes

if TYPE_CHECKING:
    from softlube.transient.history import PhysicalInput, Transient

PLANE = ("r", "theta")
"""Axes of film and pressure with sliding."""
ROUND_OFF = 1e-6
"""Relative difference of a coordinate from what r and theta say."""
EXTREMES = {"film_min": ("film", np.min), "pressure_max": ("pressure", np.max)}
"""Histories that are extremes of a field: the field, and which extreme."""
BETWEEN_NODES = 0.3
"""Relative difference at most between an extreme and that of the nodes, on the coarsest grids."""


def to_dataset(result: Transient) -> xr.Dataset:
    """A film in time as an xarray Dataset, in SI if the input was physical.

    Parameters
    ----------
    result : Transient
        A squeeze film or a start of sliding.

    Returns
    -------
    Dataset
        Film and pressure on (time, r), with sliding on (time, r, theta); on (time,) the histories with their errors, and the
        terms of the balance of volume.
    """
    run = result.run
    coordinates: dict[str, Any] = {"time": ("time", run.time, {"long_name": f"time since the {result.start}"} | AXES["time"])}
    coordinates |= {name: (name, getattr(run, name), _axis(name)) for name in result.axes}
    if result.axes == PLANE:
        coordinates |= {name: (PLANE, each, _axis(name)) for name, each in plane(run.r, coordinates["theta"][1]).items()}
    data: dict[str, tuple[Any, ...]] = {
        name: (("time", *result.axes), values, {"long_name": QUANTITIES[name].words})
        for name, values in (("film", run.films), ("pressure", run.pressures))
    }
    for name, values in result.values.items():
        data[name] = ("time", values, {"long_name": QUANTITIES[name].words, "ancillary_variables": name + ERROR})
        data[name + ERROR] = ("time", result.value_errors[name], {"long_name": about_error(name)["long_name"]})
    for name in result.balance:
        data[name] = ("time", getattr(run, name), {"long_name": QUANTITIES[name].words})
    attributes = head(result.title) | {
        "ended_by": run.ended_by,
        "accuracy": result.accuracy,
        **{name: json.dumps(value) if isinstance(value, list) else value for name, value in result.numerics.items()},
        "warnings": json.dumps([]),
        "substrate": json.dumps(substrates.to_plain(result.motion.substrate)),
        "liquid": json.dumps(liquids.to_plain(result.motion.liquid)),
    }
    if result.motion.indenter != PARABOLOID:
        attributes["indenter"] = json.dumps(indenters.to_plain(result.motion.indenter))
    return in_units(xr.Dataset(data, coords=coordinates, attrs=attributes), result.setup, result.sliding)


def _axis(name: str) -> dict[str, str]:
    """Words and attributes of a coordinate, before it has a unit."""
    return ({"long_name": QUANTITIES[name].words} if name in QUANTITIES else {}) | AXES[name]


def in_units(data: xr.Dataset, setup: PhysicalInput | None, sliding: Mapping[str, Any]) -> xr.Dataset:
    """A normalised dataset in SI, with its physical input and the warnings about its physics.

    Parameters
    ----------
    data : Dataset
        Normalised with the setup's unit of height.
    setup : PhysicalInput or None
        The physical input; without one the dataset keeps its numbers and has units of "1".
    sliding : mapping of str to object
        Inputs of the sliding, empty without sliding.
    """
    scaled = {}
    for name, values in data.variables.items():
        row = QUANTITIES.get(str(name).removesuffix(ERROR))
        if row is not None:
            factor, unit = setup.units[row.dimension] if setup is not None else (1.0, "1")
            scaled[name] = (values.dims, values.to_numpy() * factor, values.attrs | {"units": unit})
    data = data.assign_coords({name: scaled.pop(name) for name in list(data.coords) if name in scaled}).assign(scaled)
    if setup is None:
        return data
    histories = {str(name): values.to_numpy() for name, values in data.data_vars.items() if values.dims == ("time",)}
    doubts = setup.doubts(Extremes.of(data.time.to_numpy(), histories, data.pressure.to_numpy()))
    return data.assign_attrs(warnings=json.dumps(doubts), inputs_SI=json.dumps(setup.inputs() | dict(sliding)))


def contents(result: Transient) -> bytes:
    """What `save` writes."""
    return netcdf(to_dataset(result))


def save(result: Transient, path: str | os.PathLike[str]) -> None:
    """Write a film in time as NetCDF 4.

    Raises
    ------
    InputError, OSError
        See `softlube.files.writing`.
    """
    write_whole({check_destination("output", path): contents(result)})


def load(source: str | os.PathLike[str] | bytes) -> xr.Dataset:
    """Read a film in time that `save` has written.

    Parameters
    ----------
    source : path or bytes
        The file, or all of its bytes.

    Raises
    ------
    InputError
        If an array is missing or has another shape, a number is not finite, a film not positive, an axis does not increase, or
        the extremes of film and pressure are not those of the fields; the message names the variable.
    """
    try:
        return _dataset(source)
    except Damaged as error:
        raise error.about(
            "fields: what the store has" if isinstance(source, bytes) else f"path: {os.fspath(source)!r}"
        ) from None


def _dataset(source: str | os.PathLike[str] | bytes) -> xr.Dataset:
    content = read(source)
    if "film" not in content.variables or "softlube_version" not in content.attributes:
        raise Damaged("does not hold a film in time")
    variables = content.variables
    axes = tuple(name for name in PLANE if name in variables)
    schema = {"time": Rule(("time",)), **{name: Rule((name,)) for name in axes}}
    schema |= {name: Rule(PLANE) for name in ("x", "y") if axes == PLANE and schema_of(content.attributes) > 1}
    schema |= {"film": Rule(("time", *axes), "positive"), "pressure": Rule(("time", *axes))}
    schema |= {name: Rule(("time",), gaps=True) for name in variables if name not in schema}
    check(content, schema)
    for name, (field, extreme) in EXTREMES.items():
        nodal = extreme(variables[field].values.reshape(variables["time"].values.size, -1), axis=1)
        if name not in variables or np.any(np.abs(variables[name].values - nodal) > BETWEEN_NODES * np.abs(nodal)):
            raise Damaged(f"{name}: is not that of the {field}")
    nodes = plane(*(variables[name].values for name in PLANE)) if axes == PLANE else {}
    for name, expected in nodes.items():
        if name in schema and not np.allclose(variables[name].values, expected, rtol=ROUND_OFF, atol=1e-9 * expected.max()):
            raise Damaged(f"{name}: is not that of r and theta")
    arrays = {name: (schema[name].axes, found.values, found.attributes) for name, found in variables.items()}
    return xr.Dataset(arrays, attrs=content.attributes).set_coords(["time", *axes, *(name for name in nodes if name in schema)])
