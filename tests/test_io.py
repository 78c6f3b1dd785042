"""Files: everything is written, everything comes back, nothing is left behind by a failure."""

import json

import numpy as np
import pytest
import xarray as xr

import softlube
from softlube.files import whole_file


def test_round_trip(physical, tmp_path):
    path = tmp_path / "contact.nc"
    physical.save(path)
    again = softlube.load(path)
    for field in ("problem", "quantities", "dimensional", "beta", "beta_load", "accuracy", "levels", "contact", "warnings"):
        assert getattr(again, field) == getattr(physical, field), field
    assert [q.error for q in again.quantities.values()] == [q.error for q in physical.quantities.values()]
    assert [q.unit for q in again.dimensional.values()] == [q.unit for q in physical.dimensional.values()]
    assert np.array_equal(again.fields.film, physical.fields.film)
    assert again.friction_within(1.5) == physical.friction_within(1.5)


def test_dimensionless_round_trip(solution, tmp_path):
    solution.save(tmp_path / "a.nc")
    again = softlube.load(tmp_path / "a.nc")
    assert again.contact is None
    assert again.dimensional == {}
    assert again.quantities == solution.quantities


def test_round_trip_of_the_paper_s_method(tmp_path):
    solution = softlube.solve(beta=10, method="relaxation")
    solution.save(tmp_path / "a.nc")
    again = softlube.load(tmp_path / "a.nc")
    assert again.method == "relaxation"
    assert again.quantities == solution.quantities
    assert again.fields.film_at(1.3, 0.7) == solution.fields.film_at(1.3, 0.7)
    assert [r.summary() for r in again.levels[0].history] == [r.summary() for r in solution.levels[0].history]
    assert again.levels[0].history[0].count == solution.levels[0].history[0].count > 100


def test_xarray_opens_the_file(physical, tmp_path):
    path = tmp_path / "contact.nc"
    physical.save(path)
    with xr.open_dataset(path) as data:
        assert data.film.dims == ("r", "theta")
        assert float(data.film_min) == physical.film_min
        assert data.film_min.attrs["error"] == physical.film_min.error
        assert data.film_min_SI.attrs["units"] == "m"
        at_nodes = float(data.film_SI.min())
        assert physical.dimensional["film_min"] <= at_nodes == pytest.approx(physical.dimensional["film_min"], rel=0.05)
        assert float(data.r_SI[5] / data.r[5]) == pytest.approx(float(physical.dimensional["contact_radius"]))
        assert data.attrs["softlube_version"] == softlube.__version__
        assert json.loads(data.attrs["inputs_SI"])["radius"] == 0.002
        # u = h − w with h = −1 + r²/2, Eq. (6c)
        assert float(abs(data.film + data.displacement + 1 - data.r**2 / 2).max()) < 1e-11


def test_a_failed_write_leaves_the_old_file(tmp_path):
    path = tmp_path / "a.nc"
    path.write_text("old")

    def fail_midway():
        with whole_file(path) as temporary:
            temporary.write_text("half")
            raise RuntimeError("midway")

    with pytest.raises(RuntimeError, match="midway"):
        fail_midway()
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_missing_folder_and_folder_as_file(solution, tmp_path):
    with pytest.raises(softlube.InputError, match=r"folder .* does not exist"):
        solution.save(tmp_path / "none" / "a.nc")
    with pytest.raises(softlube.InputError, match="is a folder"):
        solution.save(tmp_path)


def test_loading_what_is_not_a_solution(tmp_path):
    with pytest.raises(softlube.InputError, match="does not exist"):
        softlube.load(tmp_path / "none.nc")
    (tmp_path / "text.nc").write_text("hello")
    with pytest.raises(softlube.InputError, match="not a NetCDF file"):
        softlube.load(tmp_path / "text.nc")
    xr.Dataset({"a": 1}).to_netcdf(tmp_path / "other.nc", engine="h5netcdf")
    with pytest.raises(softlube.InputError, match="does not hold a solution"):
        softlube.load(tmp_path / "other.nc")
