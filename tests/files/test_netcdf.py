"""Files: everything is written, everything comes back, nothing is left behind by a failure."""

import json
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

import softlube
from softlube.files.netcdf import RENAMED


def test_round_trip(physical, tmp_path):
    path = tmp_path / "contact.nc"
    physical.save(path)
    again = softlube.load(path)
    for field in (
        "problem",
        "quantities",
        "other_quantities",
        "dimensional",
        "beta",
        "beta_load",
        "accuracy",
        "contact",
        "warnings",
    ):
        assert getattr(again, field) == getattr(physical, field), field
    assert again.levels == tuple(replace(level, fields=None) for level in physical.levels)
    for by in ("load", "indentation"):
        assert [q.error for q in again.normalised(by).values()] == [q.error for q in physical.normalised(by).values()]
    assert [q.unit for q in again.dimensional.values()] == [q.unit for q in physical.dimensional.values()]
    assert np.array_equal(again.fields.film, physical.fields.film)
    assert again.friction_within(1.5) == physical.friction_within(1.5)
    assert (again.fields.height, again.fields.load) == (physical.height, physical.load)
    assert again.fields.beta == pytest.approx(physical.beta_load, rel=1e-14)


@pytest.mark.parametrize("indentation", ["-1 um", "0 um"])
def test_round_trip_of_a_gap(tmp_path, indentation):
    contact = softlube.Contact(radius=2e-3, young_modulus=3e6, viscosity=2.0, speed=1e-4, indentation=indentation)
    solution = contact.solve(accuracy=0.01)
    solution.save(tmp_path / "a.nc")
    again = softlube.load(tmp_path / "a.nc")
    assert again.problem == solution.problem
    assert again.contact == contact
    assert again.dimensional == solution.dimensional
    assert again.other_quantities == {}
    assert again.fields.height == solution.height
    assert np.array_equal(again.fields.pressure, solution.fields.pressure)
    assert again.fields.film_at(0.7, 0.3) == pytest.approx(solution.fields.film_at(0.7, 0.3), rel=1e-14)


def test_both_normalisations_are_in_the_file(physical, solution):
    for one, own, other in ((physical, "load", "indentation"), (solution, "indentation", "load")):
        data = one.dataset
        assert (data.attrs["normalisation"], data.attrs["other_normalisation"]) == (own, other)
        for name, quantity in one.normalised(other).items():
            assert float(data[name + "_other"]) == quantity
            assert np.array_equal(data[name + "_error_other"], quantity.error, equal_nan=True)
            assert data[name + "_other"].attrs["units"] == ("degree" if name == "film_min_angle_deg" else "1")
        for name, quantity in one.normalised(own).items():
            assert float(data[name]) == quantity


def test_a_file_of_an_earlier_version_is_refused(solution, tmp_path):
    data = solution.dataset
    del data.attrs["height"]
    data.to_netcdf(tmp_path / "old.nc", engine="h5netcdf")
    with pytest.raises(softlube.InputError, match=r"earlier version of softlube; solve and save it again"):
        softlube.load(tmp_path / "old.nc")


def test_a_file_with_the_words_of_development_versions_loads(tmp_path):
    oil = softlube.Contact(
        radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", pressure_viscosity="1 MPa^-1", speed="0.1 mm/s", load="50 mN"
    ).solve(accuracy=0.05)
    data = oil.dataset
    assert '"liquid"' in data.attrs["problem"]
    data.attrs["problem"] = data.attrs["problem"].replace('"liquid"', '"fluid"')
    for old, new in RENAMED.items():
        assert f'"{new}"' in data.attrs["grid"]
        data.attrs["grid"] = data.attrs["grid"].replace(f'"{new}"', f'"{old}"')
    data.to_netcdf(tmp_path / "old.nc", engine="h5netcdf")
    again = softlube.load(tmp_path / "old.nc")
    assert again.fields.chart == oil.fields.chart
    assert again.problem == oil.problem
    assert again.problem.liquid.kind == "barus"


def first_schema(data):
    """A dataset as softlube 0.2 wrote it: errors are attributes, and there is no x and y."""
    errors = [name for name in data.data_vars if "_error" in name]
    old = data.drop_vars([*errors, *(name for name in data.coords if name[0] in "xy")])
    for name in errors:
        old[name.replace("_error", "")].attrs |= {"error": float(data[name])}
        del old[name.replace("_error", "")].attrs["ancillary_variables"]
    del old.attrs["Conventions"], old.attrs["softlube_schema"]
    return old


def test_a_file_of_the_first_schema_loads(physical, tmp_path):
    old = first_schema(physical.dataset)
    assert old.film_min.attrs["error"] == physical.film_min.error
    assert set(old.variables) == {name for name in physical.dataset.variables if "_error" not in name and name[0] not in "xy"}
    old.to_netcdf(tmp_path / "old.nc", engine="h5netcdf")
    again = softlube.load(tmp_path / "old.nc")
    assert again.dataset.identical(physical.dataset.assign_attrs(levels=again.dataset.levels))
    assert [q.error for q in again.dimensional.values()] == [q.error for q in physical.dimensional.values()]


@pytest.mark.parametrize(("schema", "message"), [(3, "schema 3 of a later version"), ("new", "expected a whole number")])
def test_a_file_of_a_later_schema_is_refused(solution, tmp_path, schema, message):
    solution.dataset.assign_attrs(softlube_schema=schema).to_netcdf(tmp_path / "a.nc", engine="h5netcdf")
    with pytest.raises(softlube.InputError, match=message):
        softlube.load(tmp_path / "a.nc")


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
        assert float(data.film_min_error) == physical.film_min.error
        assert float(data.film_min_error_SI) == physical.dimensional["film_min"].error
        assert data.film_min_SI.attrs["units"] == "m"
        at_nodes = float(data.film_SI.min())
        assert physical.dimensional["film_min"] <= at_nodes == pytest.approx(physical.dimensional["film_min"], rel=0.05)
        assert float(data.r_SI[5] / data.r[5]) == pytest.approx(float(physical.dimensional["contact_radius"]))
        assert data.attrs["softlube_version"] == softlube.__version__
        assert json.loads(data.attrs["inputs_SI"])["radius"] == 0.002
        # u = h − w with h = h₀ + r²/2, Eq. (6c)
        assert -1 < data.attrs["height"] < -0.9
        assert float(abs(data.film + data.displacement - data.attrs["height"] - data.r**2 / 2).max()) < 1e-11
        # … and w is Hertz's at the centre but for the film
        assert float(data.displacement[0].mean()) == pytest.approx(-1, abs=0.01)


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


@pytest.mark.parametrize("law", [{"relaxation_time": "10 ms", "index": 0.5}, {"limiting_stress": "1 kPa"}])
def test_a_liquid_that_depends_on_the_sliding_comes_back(tmp_path, law):
    contact = softlube.Contact(
        radius="2 mm",
        young_modulus="3 MPa",
        entrainment_speed="0.1 mm/s",
        slide_to_roll=0.5,
        load="100 mN",
        viscosity=2.0,
        **law,
    )
    solution = contact.solve(accuracy=0.02)
    solution.save(tmp_path / "a.nc")
    again = softlube.load(tmp_path / "a.nc")
    assert (again.contact, again.problem) == (contact, solution.problem)
    assert again.problem.slide_to_roll == 0.5
    assert again.quantities == solution.quantities
    assert again.dimensional == solution.dimensional
    assert ("shear_rate_mean" in again.dimensional) == ("index" in law)


def test_a_substrate_that_remembers_comes_back(tmp_path):
    rubber = softlube.Viscoelastic("3 MPa", prony=[("9 MPa", "1 ms")])
    ball = {"radius": "2 mm", "viscosity": "1 Pa s", "speed": "10 mm/s", "load": "100 mN"}
    solution = softlube.Contact(substrate=rubber, **ball).solve(accuracy=0.03)
    solution.save(tmp_path / "a.nc")
    again = softlube.load(tmp_path / "a.nc")
    assert (again.quantities, again.other_quantities) == (solution.quantities, solution.other_quantities)
    assert np.array_equal(again.fields.recovery, solution.fields.recovery)
    assert softlube.friction.total_within(again, 1.5) == pytest.approx(softlube.friction.total_within(solution, 1.5), rel=1e-13)
