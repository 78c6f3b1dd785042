"""What every dataset and NetCDF file of softlube says by the CF conventions: units, words, axes, errors, and its schema.

docs/reference/files.md describes the schema.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from softlube.files.reading import Damaged
from softlube.model.quantities import QUANTITIES, Quantity
from softlube.physical.inputs import declared

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.floating]

CONVENTIONS = "CF-1.11"
SCHEMA = 2
"""Version of the schema of files.  Files of schema 1, which do not say so, have errors as attributes, and no x and y."""
VERSION = "softlube_schema"
AXES = {
    "time": {"axis": "T"},
    "r": {},
    "theta": {"long_name": "angle from the inlet", "units": "rad"},
    "x": {"axis": "X"},
    "y": {"axis": "Y"},
}
"""Attributes that coordinates have besides those of their quantity."""
ERROR = "_error"
"""Ending of the variable with the errors of another."""
ANGLE = "degree"
"""Unit of angles that are quantities; coordinates are in rad."""
SPECIAL = {
    "case": "number of the case",
    "status": "whether the case was solved",
    "beta": "β of Eq. (6d)",
    "beta_load": "β of Eq. (30)",
}
"""Words of columns of tables that are no quantities."""


def head(title: str) -> dict[str, Any]:
    """Attributes of a dataset as a whole."""
    return {"Conventions": CONVENTIONS, "title": title, VERSION: SCHEMA, "softlube_version": version("softlube")}


def schema_of(attributes: Mapping[str, Any]) -> int:
    """Version of the schema of a file.

    Raises
    ------
    Damaged
        If it is a later version's, or no number.
    """
    try:
        found = int(attributes.get(VERSION, 1))
    except (TypeError, ValueError, OverflowError):
        raise Damaged(f"{VERSION}: expected a whole number") from None
    if found > SCHEMA:
        raise Damaged(f"has the schema {found} of a later version of softlube; this one reads {SCHEMA} and earlier ones")
    return found


def about(name: str, unit: str = "") -> dict[str, str]:
    """Words and unit of a quantity or a field; no unit stands for a normalised one."""
    row = QUANTITIES[name]
    return {"long_name": row.words, "units": ANGLE if row.dimension == "angle" else unit or "1"}


def about_error(name: str, unit: str = "") -> dict[str, str]:
    """Words and unit of the error of a quantity."""
    described = about(name, unit)
    return described | {"long_name": f"error of the {described['long_name']}"}


def with_error(name: str, quantity: Quantity, suffix: str = "") -> dict[str, xr.DataArray]:
    """A quantity and its error as two variables.

    Parameters
    ----------
    name : str
        A key of `softlube.model.quantities.QUANTITIES`.
    quantity : Quantity
        Value, error and unit.
    suffix : str
        What both names end in.
    """
    error = name + ERROR + suffix
    attributes = about(name, quantity.unit) | {"ancillary_variables": error}
    return {
        name + suffix: xr.DataArray(float(quantity), attrs=attributes),
        error: xr.DataArray(quantity.error, attrs=about_error(name, quantity.unit)),
    }


def plane(r: Array, theta: Array) -> dict[str, Array]:
    """Cartesian coordinates of nodes, x = r cos θ towards the inlet and y = r sin θ across, shape (r, theta)."""
    return {"x": r[:, None] * np.cos(theta), "y": r[:, None] * np.sin(theta)}


def table_dataset(table: pandas.DataFrame, inputs: Iterable[str]) -> xr.Dataset:
    """A table with a row for each case as a dataset over the dimension "case".

    Parameters
    ----------
    table : DataFrame
        Units in the headers, as in "film_min [m]"; a column "film_min_error [m]" is the error of "film_min [m]".
    inputs : iterable of str
        Names of columns, without their unit, that become coordinates.
    """
    columns = {str(header).partition(" [")[0]: str(header) for header in table.columns}
    data: dict[str, tuple[str, Any, dict[str, str]]] = {}
    for name, header in columns.items():
        values = table[header]
        attributes = {"long_name": _words(name)}
        if values.dtype == object or values.dtype.kind not in "iufb":
            data[name] = ("case", values.fillna("").astype(str).to_numpy(dtype=object), attributes)
            continue
        quantity = name.removesuffix(ERROR)
        angle = quantity in QUANTITIES and QUANTITIES[quantity].dimension == "angle"
        attributes["units"] = ANGLE if angle else header.partition(" [")[2].removesuffix("]") or "1"
        if name + ERROR in columns:
            attributes["ancillary_variables"] = name + ERROR
        data[name] = ("case", values.to_numpy(), attributes)
    number = data.pop("case", ("case", np.arange(1, len(table) + 1), {"long_name": SPECIAL["case"], "units": "1"}))
    coordinates = {"case": number} | {name: data.pop(name) for name in inputs if name in data}
    return xr.Dataset(data, coords=coordinates, attrs=head("Results of many cases"))


def _words(name: str) -> str:
    """What a column of a table is, in words."""
    quantity = name.removesuffix(ERROR)
    if quantity in QUANTITIES:
        return f"{'error of the ' if quantity != name else ''}{QUANTITIES[quantity].words}"
    known = declared().get(name)
    return SPECIAL.get(name, name.replace("_", " ")) if known is None else known.title
