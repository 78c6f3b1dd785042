"""Sweeps of squeeze films and of starts of sliding: the numbers and files of single ones, each problem once, refusals."""

import json
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import softlube
from softlube.cli.main import main
from softlube.sweeps import Store, read_plan
from softlube.sweeps.plan import make_plan
from softlube.sweeps.work import content_key

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s"}
FALL = BALL | {"load": "100 mN", "initial_height": "100 um", "duration": "20 ms"}
FILMS = FALL | {"film_limit": ["5 um", "30 um"], "viscosity": ["2 Pa s", "1 Pa s"]}
ROUGH = 0.02
SQUEEZE = {"motion": "squeeze", "accuracy": ROUGH, "workers": 1}
UNITS = {"film_center": "m", "film_min": "m", "pressure_max": "Pa", "height": "m"}


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """Four squeeze films with their fields, and the store."""
    store = tmp_path_factory.mktemp("sweep") / "store"
    return softlube.sweep(FILMS, **SQUEEZE, store=store, fields=True), store


def test_numbers_are_those_of_squeeze(swept):
    table = swept[0].table
    cases = [(viscosity, limit) for viscosity in FILMS["viscosity"] for limit in FILMS["film_limit"]]
    assert table["film_limit [m]"].tolist() == pytest.approx([5e-6, 30e-6, 5e-6, 30e-6])
    for row, (viscosity, limit) in zip(table.to_dict("records"), cases, strict=True):
        film = softlube.squeeze(**FALL | {"film_limit": limit, "viscosity": viscosity}, accuracy=ROUGH)
        assert (row["status"], row["ended_by"]) == ("done", film.run.ended_by)
        assert row["end_time [s]"] == pytest.approx(film.time[-1], rel=1e-9)
        assert row["end_time_error [s]"] == pytest.approx(film.time_error, rel=1e-4, abs=1e-9)
        assert row["dimple_time [s]"] == pytest.approx(film.dimple_time, rel=1e-6, nan_ok=True)
        assert row["load [N]"] == 0.1
        for name, unit in UNITS.items():
            assert row[f"{name} [{unit}]"] == pytest.approx(float(film.final[name]), rel=1e-7), name
            assert row[f"{name}_error [{unit}]"] == pytest.approx(film.final[name].error, rel=1e-3), name
    assert table["warnings"].tolist() == [""] * 4
    assert table["ended_by"].tolist() == ["duration", "film_limit", "film_limit", "film_limit"]
    # half as viscous, through the limit in half the time
    assert table["end_time [s]"][1] == pytest.approx(2 * table["end_time [s]"][3], rel=1e-4)


def test_a_second_run_solves_nothing_and_gives_the_same(swept):
    result, store = swept
    states = []
    again = softlube.sweep(FILMS, **SQUEEZE, store=store, progress=states.append)
    assert [(state.total, state.done, again.n_found) for state in states] == [(4, 4, 4)]
    pd.testing.assert_frame_equal(again.table, result.table, check_exact=True)
    with Store(store) as kept:
        assert set(kept.counts().values()) == {1}


def test_files_are_the_squeeze_films_own(swept, tmp_path):
    paths = swept[0].save_fields(tmp_path / "fields")
    assert [path.name for path in paths] == [f"case-{n:05d}.nc" for n in (1, 2, 3, 4)]
    own = softlube.squeeze(**FALL | {"film_limit": "30 um"}, accuracy=ROUGH).dataset
    with xr.open_dataset(paths[1], engine="h5netcdf") as data:
        assert data.film.dims == ("time", "r")
        assert list(data.variables) == list(own.variables)
        for name in ("time", "r", "film", "pressure", "load", "film_min", "volume"):
            assert data[name].attrs == own[name].attrs
            values = own[name].to_numpy()
            assert data[name].to_numpy() == pytest.approx(values, rel=1e-6, abs=1e-6 * values.max()), name
        assert data.attrs["ended_by"] == "film_limit"
        assert data.attrs["warnings"] == own.attrs["warnings"]
        inputs, theirs = (json.loads(each.attrs["inputs_SI"]) for each in (data, own))
    assert {name for name in inputs if inputs[name] != theirs[name]} == {"description"}  # "load 100 mN" and "load"


def test_a_layer_with_an_oil():
    model = {"thickness": "0.5 mm", "poisson_ratio": 0.4, "base": "frictionless", "pressure_viscosity": "1 MPa^-1"}
    row = softlube.sweep(FALL | model, **SQUEEZE).table.iloc[0]
    film = softlube.squeeze(**FALL | model, accuracy=ROUGH)
    assert (row["thickness [m]"], row["base"], row["status"]) == (5e-4, "frictionless", "done")
    for name, unit in UNITS.items():
        assert row[f"{name} [{unit}]"] == pytest.approx(float(film.final[name]), rel=1e-7), name
    assert len(film.warnings) == 1  # the layer's
    assert row["warnings"] == film.warnings[0]


def test_warnings_are_a_column():
    pulled = {"radius": "2 mm", "young_modulus": "30 MPa", "viscosity": [2.0, 0.01], "approach_speed": "-100 mm/s"}
    pulled |= {"initial_height": "5 um", "duration": "0.2 ms"}
    table = softlube.sweep(pulled, **SQUEEZE).table
    for viscosity, text in zip(pulled["viscosity"], table["warnings"], strict=True):
        own = softlube.squeeze(**pulled | {"viscosity": viscosity}, accuracy=ROUGH).warnings
        assert "cavitate" in own[0]
        assert text == "; ".join(own)
    assert "inertia" in table["warnings"][1]


def test_with_a_speed_it_slides(tmp_path):
    start = FALL | {"duration": "2 ms", "pressed": "1 ms", "speed": "10 mm/s"}
    # half as viscous and twice as fast in half the time is the same start
    rows = start | {"viscosity": [2.0, 1.0], "speed": [0.01, 0.02], "duration": [2e-3, 1e-3], "pressed": [1e-3, 5e-4]}
    states = []
    result = softlube.sweep(rows, motion="squeeze", combine="zip", accuracy=0.1, workers=1, fields=True, progress=states.append)
    assert states[-1].total == 1
    own = softlube.slide(**start, accuracy=0.1)
    first, second = result.table.to_dict("records")
    for name, quantity in own.final.items():
        if name != "load":  # as given
            assert first[f"{name} [{quantity.unit}]"] == pytest.approx(float(quantity), rel=1e-7), name
            assert second[f"{name} [{quantity.unit}]"] == pytest.approx(float(quantity), rel=1e-7), name
    assert second["end_time [s]"] == 1e-3
    assert first["warnings"] == "; ".join(own.warnings)
    assert "dimple_time [s]" not in first
    path = result.save_fields(tmp_path / "fields")[1]
    with xr.open_dataset(path, engine="h5netcdf") as data:
        assert data.film.dims == ("time", "r", "theta")
        assert data.time[-1] == pytest.approx(1e-3)
        assert data.film.to_numpy() == pytest.approx(own.dataset.film.to_numpy(), rel=1e-6)
        assert json.loads(data.attrs["inputs_SI"])["speed"] == 0.02


def test_what_a_history_says_decides_not_its_name(tmp_path):
    for name, text in {
        "a.csv": "time [ms],height [um]\n0,20\n10,5\n",
        "b.csv": "# the same\ntime,height\n0,2e-5\n0.01,5e-6\n",
        "c.csv": "time,height\n0,2e-5\n0.01,6e-6\n",
    }.items():
        (tmp_path / name).write_text(text)
    plan = make_plan(BALL | {"history": ["a.csv", "b.csv", "c.csv"]}, motion="squeeze", accuracy=ROUGH, folder=tmp_path)
    one, same, other = (content_key(case.task, ROUGH) for case in plan.cases)
    assert one == same != other
    assert plan.sources == tuple(tmp_path / name for name in ("a.csv", "b.csv", "c.csv"))
    table = softlube.sweep(plan, workers=1).table
    film = softlube.squeeze(**BALL, history=tmp_path / "c.csv", accuracy=ROUGH)
    assert table["history"].tolist() == ["a.csv", "b.csv", "c.csv"]
    assert table["load [N]"][2] == pytest.approx(float(film.final["load"]), rel=1e-7)
    (tmp_path / "a.csv").write_text("time,height\n0,2e-5\n0.01,7e-6\n")
    changed = make_plan(BALL | {"history": "a.csv"}, motion="squeeze", folder=tmp_path)
    assert content_key(changed.cases[0].task, ROUGH) not in (one, other)


def test_all_that_decides_on_the_solution_is_in_the_key():
    def key(change, accuracy=ROUGH):
        (case,) = make_plan(FALL | change, motion="squeeze").cases
        return content_key(case.task, accuracy)

    same = [{}, {"density": 900.0}, {"young_modulus": 3.0e6}, {"viscosity": "1 Pa s", "duration": "10 ms"}]
    assert len({key(change) for change in same}) == 1
    others = [
        {"duration": "21 ms"},
        {"initial_height": "99 um"},
        {"film_limit": "1 um"},
        {"thickness": "1 mm"},
        {"pressure_viscosity": "1 MPa^-1"},
        {"speed": "1 mm/s"},
        {"speed": "2 mm/s"},
        {"speed": "1 mm/s", "cavitation": "none"},
        {"speed": "1 mm/s", "pressed": "1 ms"},
    ]
    assert len({key({}), key({}, 0.03), *map(key, others)}) == 2 + len(others)


def test_a_failed_case_is_a_row_with_its_reason(tmp_path):
    rigid = BALL | {
        "young_modulus": ["3 TPa", "3 MPa"],
        "approach_speed": "1 mm/s",
        "initial_height": "20 um",
        "duration": 0.01,
    }
    store = tmp_path / "store"
    result = softlube.sweep(rigid, **SQUEEZE, store=store)
    assert result.table["status"].tolist() == ["failed", "done"]
    assert "rigid sphere" in result.table["reason"][0]
    assert np.isnan(result.table["film_min [m]"][0])
    softlube.sweep(rigid, **SQUEEZE, store=store, retry_failed=True)
    with Store(store) as kept:
        assert [kept.counts()[key] for key in result.keys] == [2, 1]


def test_columns_may_pull(tmp_path):
    (tmp_path / "v.csv").write_text("approach_speed [um/s],initial_height [um]\n10,20\n-10,5\n")
    columns = {name: {"csv": "v.csv"} for name in ("approach_speed", "initial_height")}
    plan = make_plan(BALL | columns | {"duration": "1 s"}, motion="squeeze", folder=tmp_path)
    assert [case.inputs["approach_speed"] for case in plan.cases] == pytest.approx([1e-5, -1e-5])
    with pytest.raises(softlube.InputError, match="approach_speed: from, to: expected values of one sign"):
        make_plan(FALL | {"approach_speed": {"from": -1e-6, "to": 1e-6, "count": 3}}, motion="squeeze")


def test_accuracy_is_the_motions_own_unless_asked_for():
    assert make_plan(FALL, motion="squeeze").accuracy == 1e-3
    assert make_plan(FALL | {"speed": "1 mm/s"}, motion="squeeze").accuracy == 2e-2
    with pytest.raises(softlube.InputError, match=r"accuracy: expected a number from 1e-05 to 0.1 for a squeeze film"):
        make_plan(FALL, motion="squeeze", accuracy=1e-6)
    with pytest.raises(softlube.InputError, match=r"accuracy: expected a number from 0.001 to 0.1 for a start of sliding"):
        make_plan(FALL | {"speed": "1 mm/s"}, motion="squeeze", accuracy=1e-4)


TOML = """[sweep]
motion = "squeeze"
accuracy = 0.02

[parameters]
radius = "2 mm"
young_modulus = "3 MPa"
viscosity = "2 Pa s"
load = "100 mN"
initial_height = "100 um"
duration = "20 ms"
"""


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('motion = "squeeze"', 'motion = "sqeeze"', "line 2: motion: expected 'steady' or 'squeeze', got 'sqeeze'"),
        ('motion = "squeeze"', "motion = 3", "line 2: motion: expected"),
        (
            'motion = "squeeze"\n',
            "",
            "line 9: initial_height: no parameter of a contact, but one of a squeeze film; set motion",
        ),
        ("accuracy = 0.02", "accuracy = 1e-7", "line 3: accuracy: expected a number from 1e-05"),
        ('load = "100 mN"', 'beta = "3"', "line 9: beta: no parameter of a squeeze film, but one of a contact"),
        ('load = "100 mN"', 'height = "3 um"', "line 9: height: no parameter of a squeeze film; expected one of radius"),
        ('load = "100 mN"', 'load = "-1 N"', "line 9: load: expected a positive"),
        ('load = "100 mN"', 'load = ["1 N", "x"]', "line 9: load: cannot read 'x'"),
        (
            'load = "100 mN"',
            "",
            "load, approach_speed, history: all missing; give exactly one of them",
        ),
        ('load = "100 mN"', 'load = "1 N"\napproach_speed = "1 um/s"', "line 9: load, approach_speed: given together"),
        ('load = "100 mN"', 'approach_speed = "0 m/s"', "line 9: approach_speed: zero"),
        ('load = "100 mN"', 'approach_speed = "1 m"', "line 9: approach_speed: 1 m has the wrong dimension"),
        ('duration = "20 ms"', 'duration = "20 mm"', "line 11: duration: 20 mm has the wrong dimension"),
        ('duration = "20 ms"', "", "duration: missing"),
        ('duration = "20 ms"', 'duration = "1 s"\npressed = "1 s"', "line 12: pressed: only a start of sliding has it"),
        ('duration = "20 ms"', 'duration = "1 s"\nspeed = "1 mm/s"\npressed = "-1 s"', "line 13: pressed: expected a positive"),
        ('load = "100 mN"', 'history = "none.csv"', "line 9: history: .*none.csv: the file does not exist"),
        ('load = "100 mN"', "history = 3", "line 9: history: expected a text"),
        ('load = "100 mN"', 'history = "bad.csv"', "line 9: history: bad.csv, line 3: load: 'x' under 'load' is no number"),
        ('load = "100 mN"', 'history = "late.csv"', "line 9: history: late.csv, line 2: expected times that start at 0"),
        ('load = "100 mN"', 'history = "good.csv"', "line 11: duration: the history has its own"),
        ('load = "100 mN"', 'history = { csv = "good.csv" }', "line 9: history: expected 'history' in the plan"),
        ('duration = "20 ms"', 'duration = { csv = "d.csv" }', "d.csv, line 3: duration: expected a positive"),
    ],
)
def test_malformed_plans_are_refused_with_the_line_before_anything_is_written(tmp_path, capsys, old, new, message):
    (tmp_path / "bad.csv").write_text("time,load\n0,1\n1,x\n")
    (tmp_path / "late.csv").write_text("time,load\n1,1\n2,1\n")
    (tmp_path / "good.csv").write_text("time,load\n0,1\n1,1\n")
    (tmp_path / "d.csv").write_text("duration [s]\n1\n0\n")
    path = tmp_path / "plan.toml"
    assert old in TOML
    path.write_text(TOML.replace(old, new))
    with pytest.raises(softlube.InputError, match=message):
        read_plan(path)
    before = set(tmp_path.iterdir())
    assert main(["sweep", str(path)]) == 2
    assert ", line " in capsys.readouterr().err
    assert set(tmp_path.iterdir()) == before


def test_no_result_overwrites_a_history(tmp_path, capsys):
    (tmp_path / "h.csv").write_text("time,height\n0,2e-5\n0.01,5e-6\n")
    path = tmp_path / "plan.toml"
    gone = ("load", "initial_height", "duration")
    path.write_text("".join(line for line in TOML.splitlines(True) if not line.startswith(gone)) + 'history = "h.csv"\n')
    assert main(["sweep", str(path), "--output", str(tmp_path / "h.csv")]) == 2
    assert "is read by the plan" in capsys.readouterr().err


def test_worked_example_of_the_page(tmp_path, monkeypatch):
    """The plan and the table of docs/how-to/sweeps.md."""
    page = (Path(__file__).parents[2] / "docs" / "how-to" / "sweeps.md").read_text(encoding="utf-8")
    page = page[page.index("## Squeeze films") : page.index("## What comes out")]
    monkeypatch.chdir(tmp_path)
    Path("plan.toml").write_text(re.findall(r"```toml\n(.*?)```", page, flags=re.DOTALL)[0])
    assert main(["sweep", "plan.toml", "--workers", "1"]) == 0
    header, _, *rows = ([cell.strip() for cell in line.strip("|").split("|")] for line in page.splitlines() if line[:1] == "|")
    table = pd.read_csv("plan-results.csv")
    assert len(rows) == len(table) == 3
    for shown, (_, row) in zip(rows, table.iterrows(), strict=True):
        for name, text in zip(header, shown, strict=True):
            if name == "ended_by":
                assert row[name] == text
            elif "_error" in name:
                # Round-off decides when inexact steps end, and the error of the time with it: loads that differ by 10⁻¹⁰
                # have 0.43 to 0.47 ms.
                assert row[name] == pytest.approx(float(text), rel=0.3), name
            else:
                digits = len(text.split("e")[0].replace(".", "").strip("0"))
                assert float(f"{row[name]:.{digits}g}") == pytest.approx(float(text), rel=1e-9), name
