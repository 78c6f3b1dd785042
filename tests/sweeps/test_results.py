"""Results as tables and files."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import softlube
from softlube.sweeps.results import check_folder, check_table

BALL = {
    "radius": "2 mm",
    "young_modulus": "3 MPa",
    "viscosity": "2 Pa s",
    "load": ["50 mN", "100 mN"],
    "speed": ["1 mm/s", "3 mm/s"],
}


ROUGH = 0.02
SHOWN = ["film_center [m]", "film_min [m]", "friction_coefficient"]


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """Four physical cases with their fields, and the store."""
    store = tmp_path_factory.mktemp("sweep") / "store"
    return softlube.sweep(BALL, accuracy=ROUGH, store=store, fields=True, workers=2), store


def test_fields_are_saved_in_si(swept, tmp_path):
    result, _ = swept
    paths = result.save_fields(tmp_path / "fields")
    assert [path.name for path in paths] == [f"case-{n:05d}.nc" for n in (1, 2, 3, 4)]
    solution = softlube.load(paths[2])
    assert solution.contact == result.plan.cases[2].contact
    assert solution.dimensional["film_min"] == result.table["film_min [m]"][2]


def test_fields_that_were_not_kept_are_missed(tmp_path):
    result = softlube.sweep({"beta": 100}, accuracy=ROUGH, workers=1)
    with pytest.raises(softlube.InputError, match="fields: were not kept"):
        result.save_fields(tmp_path / "fields")


def test_csv_and_parquet_hold_the_table(swept, tmp_path):
    result, _ = swept
    result.save(tmp_path / "a.csv")
    result.save(tmp_path / "a.parquet")
    from_csv = pd.read_csv(tmp_path / "a.csv", keep_default_na=False)
    pd.testing.assert_frame_equal(from_csv, result.table, rtol=1e-15)
    pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / "a.parquet"), result.table, check_exact=True)
    result.save(tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc") as data:
        assert data.load().identical(result.dataset)
        assert data.film_min.values.tolist() == result.table["film_min [m]"].tolist()
        assert data.film_min_error.attrs["units"] == "m"
        assert set(data.coords) == {"case", *BALL}
    with pytest.raises(softlube.InputError, match=r"expected a file ending in \.csv, \.parquet or \.nc"):
        result.save(tmp_path / "a.xlsx")


def test_a_table_of_results_is_a_table_of_cases(swept, tmp_path):
    result, store = swept
    result.save(tmp_path / "cases.csv")
    columns = {name: {"csv": str(tmp_path / "cases.csv")} for name in ("radius", "young_modulus", "viscosity", "load", "speed")}
    again = softlube.sweep(columns, accuracy=ROUGH, store=store)
    pd.testing.assert_frame_equal(again.table, result.table, check_exact=True)


def test_headers_have_units_and_inputs_come_first(swept):
    result, _ = swept
    columns = list(result.table.columns)
    inputs = ["case", "radius [m]", "young_modulus [Pa]", "viscosity [Pa s]", "load [N]", "speed [m/s]"]
    assert columns[:6] == inputs
    assert columns[6:9] == ["status", "reason", "warnings"]
    assert "film_min_error [m]" in columns


def test_where_a_table_may_go(tmp_path, monkeypatch):
    assert check_table("output", tmp_path / "A.CSV") == tmp_path / "A.CSV"
    with pytest.raises(softlube.InputError, match=r"output: expected a file ending in \.csv, \.parquet or \.nc"):
        check_table("output", tmp_path / "a.txt")
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(softlube.InputError, match="output: Parquet needs the extra parquet"):
        check_table("output", tmp_path / "a.parquet")


def test_failed_cases_have_no_file(tmp_path):
    result = softlube.sweep({"beta": [1e12, 100.0]}, accuracy=ROUGH, fields=True, workers=1)
    assert [path.name for path in result.save_fields(tmp_path / "fields")] == ["case-00002.nc"]


def test_a_folder_for_fields(tmp_path):
    (tmp_path / "file").write_text("")
    assert check_folder("fields", tmp_path) == tmp_path
    assert not check_folder("fields", tmp_path / "new").exists()
    with pytest.raises(softlube.InputError, match=r"^fields: '.*file' is a file; expected the name of a folder"):
        check_folder("fields", tmp_path / "file")
    with pytest.raises(softlube.InputError, match=r"^fields: the folder '.*none' does not exist"):
        check_folder("fields", tmp_path / "none" / "new")


def test_a_sweep_shows_itself_and_says_once_how_many_cases_have_doubts(swept):
    result, store = swept
    assert repr(result) == "<Sweep: 4 cases, 0 failed>"
    assert list(result.summary().header) == ["case", "load [N]", "speed [m/s]", "status", *SHOWN]
    assert len(result._repr_html_().encode()) < 4000
    assert result.n_warned == 0
    changed = result.table
    changed.loc[0, "status"] = "changed"
    assert result.to_dataframe()["status"][0] == "done"
    height = float(np.median(result.table["film_min [m]"])) / 3
    with pytest.warns(softlube.ValidityWarning, match="^2 of 4 cases have warnings: see the column warnings") as heard:
        rough = softlube.sweep(BALL | {"roughness": height}, accuracy=ROUGH, store=store)
    assert len(heard) == 1
    assert [bool(text) for text in rough.table["warnings"]].count(True) == 2
    many = softlube.sweep({"beta": [10.0**k for k in range(1, 5)] * 10}, accuracy=0.1, workers=1)
    assert len(many.summary().rows) == 13
    assert many.summary().notes == ("13 of 40 cases",)
