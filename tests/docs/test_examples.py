"""Every example runs, and one number of each is what it should be."""

import runpy
import warnings
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"


def run(name, folder, monkeypatch):
    monkeypatch.chdir(folder)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return runpy.run_path(str(EXAMPLES / f"{name}.py"))


def test_first_contact(tmp_path, monkeypatch):
    names = run("first_contact", tmp_path, monkeypatch)
    assert names["solution"].dimensional["film_center"] == pytest.approx(174.1e-9, rel=1e-3)
    assert (tmp_path / "first_contact.png").exists()


def test_stribeck_curve(tmp_path, monkeypatch):
    names = run("stribeck_curve", tmp_path, monkeypatch)
    assert names["both"].reduced_modulus == pytest.approx(names["rig"].reduced_modulus / 2)
    assert (names["table"]["lambda_ratio"].diff().dropna() > 0).sum() == 90  # grows with the speed, for every load
    assert (tmp_path / "stribeck_curve.png").exists()


def test_fit_viscosity(tmp_path, monkeypatch):
    names = run("fit_viscosity", tmp_path, monkeypatch)
    assert names["viscosity"].low <= 2.0 <= names["viscosity"].high
    assert names["fit"].hold_out.probability > 0.01
    assert (tmp_path / "fit_viscosity.png").exists()


def test_read_solution(tmp_path, monkeypatch):
    names = run("read_solution", tmp_path, monkeypatch)
    # Below the Hertz maximum 2/π² at so small a β, and above none of it
    assert names["highest"] == pytest.approx(2 / np.pi**2, rel=0.02)


def test_the_synthetic_data_are_what_the_script_makes_and_say_that_they_are_synthetic(tmp_path, monkeypatch):
    names = run("synthetic_friction", tmp_path, monkeypatch)
    names["main"](str(tmp_path / "made.csv"))
    kept = (EXAMPLES / "data" / "synthetic_friction.csv").read_text()
    assert kept.startswith("# SYNTHETIC data, not measured")
    # The last digit may differ on another machine.
    columns = [np.genfromtxt(path.splitlines()[3:], delimiter=",") for path in (kept, (tmp_path / "made.csv").read_text())]
    assert columns[0].shape == (72, 3)
    np.testing.assert_allclose(columns[1], columns[0], rtol=2e-4)
    load, speed = columns[0][:, 0], columns[0][:, 1]
    assert (load.min(), load.max(), speed.min(), speed.max()) == (18.6, 238.1, 0.025, 1.0)


def test_wherever_synthetic_data_appear_they_are_called_so():
    for path in [*EXAMPLES.glob("*.py"), *EXAMPLES.glob("data/*"), *(EXAMPLES.parent / "docs").rglob("*.md")]:
        text = path.read_text()
        if "synthetic_friction" in text:
            assert "synthetic" in text.lower().replace("synthetic_friction", ""), path.name
