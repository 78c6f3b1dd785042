"""Squeeze films as xarray Datasets, normalised or in SI."""

from __future__ import annotations

import json
from collections.abc import Mapping
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import xarray as xr

from softlube.model import liquids as liquids
from softlube.model import substrates
from softlube.model.quantities import QUANTITIES
from softlube.transient.extremes import Extremes
from softlube.transient.squeeze.integrate import HISTORIES

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from softlube.physical.squeeze import Setup
    from softlube.transient.squeeze.result import Squeeze


def to_dataset(result: Squeeze) -> xr.Dataset:
    """Film and pressure on (time, r), the histories with their errors on time; in SI units if the input was physical."""
    run, summary = result.run, result.to_dict()
    coordinates = {
        "time": ("time", run.time, {"long_name": "time since the start"}),
        "r": ("r", run.film.grid.r, {"long_name": QUANTITIES["r"].words}),
    }
    data: dict[str, tuple[Any, ...]] = {
        "film": (("time", "r"), run.films, {"long_name": QUANTITIES["film"].words}),
        "pressure": (("time", "r"), run.pressures, {"long_name": QUANTITIES["pressure"].words}),
    }
    for name in HISTORIES:
        text = QUANTITIES[name].words
        data[name] = ("time", result.histories[name], {"long_name": text})
        data[name + "_error"] = ("time", result.errors[name], {"long_name": f"error of the {text}"})
    for name, values, text in (
        ("volume", run.volume, QUANTITIES["volume"].words),
        ("inflow", run.inflow, QUANTITIES["inflow"].words),
    ):
        data[name] = ("time", values, {"long_name": text})
    attributes = {
        "title": "Normal approach of a rigid sphere to an elastic substrate through a film",
        "softlube_version": version("softlube"),
        "ended_by": summary["ended_by"],
        "accuracy": result.accuracy,
        "volume_error": summary["volume_error"],
        "rings": json.dumps(summary["rings"]),
        "warnings": json.dumps(summary["warnings"]),
        "substrate": json.dumps(substrates.to_plain(run.motion.substrate)),
        "liquid": json.dumps(liquids.to_plain(run.motion.liquid)),
    }
    return in_units(xr.Dataset(data, coords=coordinates, attrs=attributes), result.setup)


def in_units(data: xr.Dataset, setup: Setup | None, more: Mapping[str, Any] | None = None) -> xr.Dataset:
    """A normalised dataset in SI, with its physical input and the doubts about it; without a setup with units "1".

    Parameters
    ----------
    data : Dataset
        Normalised with the setup's unit of height.
    setup : Setup or None
        The physical input.
    more : mapping of str to object, optional
        Inputs besides the setup's.
    """
    scaled = {}
    for name, values in data.variables.items():
        row = QUANTITIES.get(str(name).removesuffix("_error"))
        if row is not None:
            factor, unit = setup.units[row.dimension] if setup is not None else (1.0, "1")
            scaled[name] = (values.dims, values.to_numpy() * factor, values.attrs | {"units": unit})
    data = data.assign_coords({name: scaled.pop(name) for name in list(data.coords) if name in scaled}).assign(scaled)
    if setup is None:
        return data

    def history(name: str) -> NDArray[Any]:
        return (data[name] if name in data else data.pressure.min(("r", "theta"))).to_numpy()

    doubts = setup.doubts(Extremes.of(data.time.to_numpy(), history))
    return data.assign_attrs(warnings=json.dumps(doubts), inputs_SI=json.dumps(setup.inputs() | dict(more or {})))
