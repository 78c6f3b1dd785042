"""Squeeze films and starts of sliding in files: all that they know, normalised and in SI."""

import json
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

import softlube
from softlube import substrates
from softlube.files.transient import in_units, load, save, to_dataset
from softlube.model import liquids as liquids
from softlube.transient.sliding.result import HISTORIES as COURSES
from softlube.transient.squeeze.integrate import HISTORIES


def test_a_normalised_squeeze_film(squeezed, tmp_path):
    squeezed.save(tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as data:
        assert data.film.dims == ("time", "r")
        assert np.all(np.diff(data.time) > 0)
        assert set(HISTORIES) <= set(data.data_vars)
        assert data.film_min.values == pytest.approx(squeezed.histories["film_min"])
        assert data.film_min_error.values == pytest.approx(squeezed.errors["film_min"])
        assert data.film.min("r").values == pytest.approx(squeezed.histories["film_min"], rel=2e-2)
        assert {data[name].attrs["units"] for name in ("time", "r", "film", "load", "volume")} == {"1"}
        assert data.attrs["ended_by"] == "duration"
        assert json.loads(data.attrs["rings"]) == list(squeezed.rings)
        assert "inputs_SI" not in data.attrs
        balance = data.volume - data.volume[0] - data.inflow
        assert float(np.abs(balance).max()) < 1e-6 * float(np.abs(data.inflow).max())


def test_a_normalised_start_of_sliding(slid):
    data = to_dataset(slid)
    assert data.pressure.dims == ("time", "r", "theta")
    assert data.theta.attrs["units"] == "rad"
    assert data.film[:, 0, 0].to_numpy() == pytest.approx(slid.histories["film_center"], rel=2e-2)
    assert data.attrs["angles"] == json.dumps(list(slid.angles))
    assert "volume" not in data


def test_a_start_of_sliding_in_si(started, tmp_path):
    save(started, tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as data:
        assert data.film.dims == ("time", "r", "theta")
        assert set(COURSES) <= set(data.data_vars)
        assert float(data.film[-1].min()) == pytest.approx(float(started.final["film_min"]), rel=2e-2)
        units = {name: data[name].attrs["units"] for name in ("time", "r", "film", "pressure", "load", "load_error")}
        assert units == {"time": "s", "r": "m", "film": "m", "pressure": "Pa", "load": "N", "load_error": "N"}
        inputs = json.loads(data.attrs["inputs_SI"])
    assert (inputs["speed"], inputs["pressed"], inputs["cavitation"], inputs["radius"]) == (0.02, 0.0, "reynolds", 2e-3)


def test_a_normalised_file_becomes_the_one_in_si(fall):
    normalised = to_dataset(replace(fall, setup=None))
    assert normalised.film.attrs["units"] == "1"
    xr.testing.assert_identical(in_units(normalised, fall.setup, {}), fall.dataset)


def test_a_substrate_that_remembers_comes_back(tmp_path):
    ball = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "prony": "6 MPa @ 1 ms; 1 MPa @ 1 s"}
    press = softlube.squeeze(**ball, load="100 mN", initial_height="100 um", duration="1 ms", accuracy=0.01)
    press.save(tmp_path / "a.nc")
    data = load(tmp_path / "a.nc")
    assert substrates.from_plain(json.loads(data.attrs["substrate"])) == press.motion.substrate
    assert json.loads(data.attrs["inputs_SI"])["prony"] == press.setup.prony
    xr.testing.assert_equal(data, press.dataset)


def test_the_file_records_substrate_and_liquid(tmp_path):
    model = {"thickness": "1 mm", "poisson_ratio": 0.4, "base": "frictionless", "pressure_viscosity": "1 MPa^-1"}
    ball = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s"}
    press = softlube.squeeze(**ball, **model, load="100 mN", initial_height="100 um", duration="1 ms", accuracy=0.01)
    press.save(tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as data:
        inputs = json.loads(data.attrs["inputs_SI"])
        assert (inputs["thickness"], inputs["poisson_ratio"], inputs["base"]) == (1e-3, 0.4, "frictionless")
        assert inputs["pressure_viscosity"] == pytest.approx(1e-6)
        assert substrates.from_plain(json.loads(data.attrs["substrate"])) == press.run.motion.substrate
        assert liquids.from_plain(json.loads(data.attrs["liquid"])) == press.run.motion.liquid
        assert data.film.attrs["units"] == "m"
