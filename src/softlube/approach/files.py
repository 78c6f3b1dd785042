"""A squeeze film as an xarray Dataset."""

from __future__ import annotations

import json
from dataclasses import asdict
from importlib.metadata import version
from typing import Any

import xarray as xr

from softlube import fluids, substrates
from softlube.approach.result import DESCRIPTION, DIMENSION, Squeeze


def to_dataset(result: Squeeze) -> xr.Dataset:
    """Film and pressure on (time, r), the histories with their errors on time; in SI units if the input was physical."""

    def unit(kind: str) -> str:
        return result.scale(kind)[1] or "1"

    coordinates = {
        "time": ("time", result.time, {"long_name": "time since the start", "units": unit("time")}),
        "r": ("r", result.r, {"long_name": "distance from the axis", "units": unit("length")}),
    }
    data: dict[str, tuple[Any, ...]] = {
        "film": (("time", "r"), result.film, {"long_name": "film thickness", "units": unit("height")}),
        "pressure": (("time", "r"), result.pressure, {"long_name": "pressure", "units": unit("pressure")}),
    }
    for name, text in DESCRIPTION.items():
        units = unit(DIMENSION[name])
        data[name] = ("time", result.history(name), {"long_name": text, "units": units})
        data[name + "_error"] = ("time", result.error(name), {"long_name": f"error of the {text}", "units": units})
    volume = result.scale("volume")[0]
    for name, values, text in (
        ("volume", result.run.volume, "liquid within twice the contact radius of the grid"),
        ("inflow", result.run.inflow, "liquid that has flowed in there since the start"),
    ):
        data[name] = ("time", values * volume, {"long_name": text, "units": unit("volume")})
    summary = result.to_dict()
    attributes = {
        "title": "Normal approach of a rigid sphere to an elastic substrate through a film",
        "softlube_version": version("softlube"),
        "ended_by": summary["ended_by"],
        "accuracy": result.accuracy,
        "volume_error": summary["volume_error"],
        "rings": json.dumps(summary["rings"]),
        "warnings": json.dumps(summary["warnings"]),
        "substrate": json.dumps(substrates.to_plain(result.run.motion.substrate)),
        "fluid": json.dumps(fluids.to_plain(result.run.motion.fluid)),
    }
    if result.setup is not None:
        attributes["inputs_SI"] = json.dumps(asdict(result.setup))
    return xr.Dataset(data, coords=coordinates, attrs=attributes)
