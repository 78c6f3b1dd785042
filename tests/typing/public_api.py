"""A script of a user who checks types: mypy and pyright find no error in it, and no Any (see test_public_api.py)."""

from pathlib import Path
from typing import assert_type

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import NDArray

import softlube
from softlube import (
    Barus,
    Contact,
    HalfSpace,
    Layer,
    Measurements,
    Newtonian,
    Quantity,
    Rig,
    Rolling,
    Sliding,
    Solution,
    Sphere,
)


def use() -> None:
    """What a script would do."""
    contact = Contact(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", speed="0.1 mm/s", load="100 mN")
    assert_type(contact, Contact)
    oil = Contact(
        indenter=Sphere("2 mm"),
        substrate=Layer(young_modulus="3 MPa", thickness="2 mm"),
        liquid=Barus("2 Pa s", pressure_viscosity="20 GPa^-1"),
        motion=Sliding("0.1 mm/s"),
        load="100 mN",
    )
    steel = Contact(
        indenter=Sphere("10 mm", young_modulus="210 GPa", poisson_ratio=0.3),
        substrate=HalfSpace("64 GPa", poisson_ratio=0.2),
        liquid=Newtonian("1 Pa s"),
        motion=Rolling("1 mm/s", slide_to_roll=0),
        load="1 N",
    )
    for each in (oil, steel):
        assert_type(each.unit_height, float)
    assert_type(contact.load, float | None)
    assert_type(contact.unit_height, float)
    assert_type(contact.radius, float)
    assert_type(contact.viscosity, float)
    assert_type(contact.problem().beta_load, float | None)

    solution = contact.solve(accuracy=0.01, progress=print)
    assert_type(solution, Solution)
    assert_type(softlube.solve(beta=1000), Solution)
    assert_type(solution.film_min, Quantity)
    assert_type(solution.film_min.error, float)
    assert_type(solution.dimensional["film_min"].unit, str)
    assert_type(solution.beta, float)
    assert_type(solution.warnings, tuple[str, ...])
    assert_type(solution.dataset, xr.Dataset)
    assert_type(solution.to_dataframe(), pd.DataFrame)
    assert_type(solution.plot(), Figure)
    assert_type(solution.summary().title, str)
    assert_type(solution.fields.film, NDArray[np.floating])
    solution.save(Path("contact.nc"))
    assert_type(softlube.load("contact.nc"), Solution)

    value, error = softlube.curve.film_min(beta_load=np.geomspace(1e2, 1e4, 3))
    assert_type(value, NDArray[np.floating])
    assert_type(error, NDArray[np.floating])

    table = softlube.stribeck_curve(
        Rig(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s"), ["50 mN", "100 mN"], points=9
    )
    assert_type(table, softlube.StribeckCurve)
    assert_type(table.to_dataframe(), pd.DataFrame)

    data = softlube.read_measurements("data.csv")
    assert_type(data, Measurements)
    found = softlube.fit(data, radius="2 mm", young_modulus="3 MPa")
    assert_type(found, softlube.Fit)
    assert_type(found.estimates["viscosity"].low, float)
    assert_type(found.verdicts, tuple[str, ...])
    assert_type(found.plot(), Figure)

    fall = softlube.squeeze(
        radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", load="100 mN", initial_height="100 um", duration="10 s"
    )
    assert_type(fall, softlube.Squeeze)
    assert_type(fall.final["film_min"], Quantity)
    assert_type(fall.film, NDArray[np.floating])
    start = softlube.slide(
        radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", load="100 mN", speed="10 mm/s", duration="1 s"
    )
    assert_type(start, softlube.Slide)

    swept = softlube.sweep({"beta": [300, 1000]}, accuracy=0.01, workers=1)
    assert_type(swept, softlube.Sweep)
    assert_type(swept.table, pd.DataFrame)
    assert_type(swept.dataset, xr.Dataset)
    assert_type(swept.n_failed, int)
    try:
        softlube.solve(beta=-1)
    except softlube.InputError as wrong:
        assert_type(wrong, softlube.InputError)
