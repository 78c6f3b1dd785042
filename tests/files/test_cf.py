"""The CF conventions: units, axes and errors as other packages read them."""

import cf_xarray
import cf_xarray.units
import numpy as np
import pandas as pd
import pint_xarray  # noqa: F401  registers .pint
import pytest
import xarray as xr

import softlube
from softlube.files.cf import CONVENTIONS, SCHEMA, plane, schema_of, table_dataset
from softlube.files.reading import Damaged
from softlube.files.transient import to_dataset


@pytest.fixture(scope="module", params=["solution", "physical", "fall", "slid", "started", "sweep"])
def data(request, physical):
    """A dataset of every kind."""
    if request.param == "sweep":
        cases = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "load": "50 mN", "speed": [1e-3, 3e-3]}
        return softlube.sweep(cases, accuracy=0.05, workers=1).dataset
    return request.getfixturevalue(request.param).dataset


def test_every_number_has_a_unit_and_words(data):
    assert data.attrs["Conventions"] == CONVENTIONS
    assert data.attrs["softlube_schema"] == SCHEMA
    for name, each in data.variables.items():
        assert each.attrs["long_name"], name
        assert each.dtype == object or each.attrs["units"], name


def test_errors_stand_beside_their_quantities(data):
    errors = [name for name in data.data_vars if "_error" in name]
    assert errors
    for name in errors:
        quantity = data[name.replace("_error", "")]
        assert quantity.attrs["ancillary_variables"] == name
        assert data[name].attrs["units"] == quantity.attrs["units"]
        assert data[name].dims == quantity.dims


def test_pint_xarray_takes_the_units_and_gives_them_back(data):
    units = cf_xarray.units.units
    quantified = data.pint.quantify(unit_registry=units)
    for name in data.variables:
        unit = data[name].attrs.get("units")
        if unit is not None and name not in data.indexes:
            assert quantified[name].pint.units == units.Unit("" if unit == "1" else unit), name
    back = quantified.pint.dequantify(format="~C")
    for name, each in data.variables.items():
        if "units" in each.attrs:
            given, found = (
                units.Unit("" if text == "1" else text) for text in (each.attrs["units"], back[name].attrs["units"])
            )
            assert given == found, name
        assert np.array_equal(back[name].values, each.values, equal_nan=each.dtype != object)
        assert back[name].attrs["long_name"] == each.attrs["long_name"]


def test_cf_xarray_finds_axes_and_errors(physical, slid, tmp_path):
    physical.save(tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc") as data:
        assert data.cf.axes == {"X": ["x"], "Y": ["y"]}
        assert "film_min_error" in data.cf["film_min"].coords
        assert np.array_equal(data.cf["film"].cf["X"], data.r * np.cos(data.theta))
        again = data.load()
    assert again.identical(physical.dataset)
    assert slid.dataset.cf.axes == {"T": ["time"], "X": ["x"], "Y": ["y"]}


def test_angles_are_in_degrees_and_values_convert(physical):
    quantified = physical.dataset.pint.quantify()
    angle = quantified.film_min_angle_deg.pint.to("rad")
    assert float(angle.pint.magnitude) == pytest.approx(np.radians(float(physical.film_min_angle_deg)))
    assert float(quantified.film_min_SI.pint.to("nm").pint.magnitude) == pytest.approx(78.717, rel=1e-4)


def test_errors_survive_concat(physical, contact):
    rougher = contact.solve(accuracy=0.02)
    scalars = [each.dataset.drop_dims(["r", "theta"]) for each in (physical, rougher)]
    both = xr.concat(scalars, "case", data_vars="all", combine_attrs="drop_conflicts")
    assert both.film_min_error_SI.values.tolist() == [each.dimensional["film_min"].error for each in (physical, rougher)]
    assert both.film_min_error_SI.attrs["units"] == "m"


def test_a_plane_of_nodes():
    found = plane(np.array([1.0, 2.0]), np.array([0.0, np.pi / 2, np.pi]))
    assert found["x"] == pytest.approx(np.array([[1, 0, -1], [2, 0, -2]]), abs=1e-15)
    assert found["y"] == pytest.approx(np.array([[0, 1, 0], [0, 2, 0]]), abs=1e-15)


def test_nodes_of_a_start_of_sliding_are_in_si(started, fall):
    data = to_dataset(started)
    assert data.x.attrs["units"] == "m"
    assert data.x.values == pytest.approx((data.r * np.cos(data.theta)).values)
    assert "x" not in to_dataset(fall).coords


def test_versions_of_the_schema():
    assert schema_of({}) == 1
    assert schema_of({"softlube_schema": 2}) == 2
    with pytest.raises(Damaged, match="schema 9 of a later version"):
        schema_of({"softlube_schema": 9})


def test_a_table_as_a_dataset():
    films = {"film_min [m]": [1e-7, np.nan], "film_min_error [m]": [1e-9, np.nan]}
    table = pd.DataFrame({"case": [1, 2], "load [N]": [0.1, 0.2], "status": ["done", "failed"], "reason": ["", "no"]} | films)
    data = table_dataset(table, ["load"])
    assert set(data.coords) == {"case", "load"}
    assert data["load"].attrs == {"long_name": "normal load, whole plane", "units": "N"}
    assert data.film_min.attrs == {"long_name": "minimum film", "units": "m", "ancillary_variables": "film_min_error"}
    assert data.reason.values.tolist() == ["", "no"]
