"""Every example runs, and one number of each is what it should be."""

import runpy
import shutil
import warnings
from pathlib import Path

import numpy as np
import pytest

import softlube

EXAMPLES = Path(__file__).parents[2] / "examples"


def run(name, folder, monkeypatch, doubt=None):
    """Names of an example after it ran in a copy of its folder: examples read and write files beside them.

    Warnings are errors, but for one that the text of the page speaks of.
    """
    shutil.copytree(EXAMPLES, folder, dirs_exist_ok=True)
    monkeypatch.chdir(folder)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        if doubt is not None:
            warnings.filterwarnings("ignore", doubt, softlube.ValidityWarning)
        return runpy.run_path(str(EXAMPLES / f"{name}.py"))


def test_first_contact(tmp_path, monkeypatch):
    names = run("first_contact", tmp_path, monkeypatch)
    assert names["solution"].dimensional["film_center"] == pytest.approx(174.1e-9, rel=1e-3)
    assert names["change"] == pytest.approx(1.1**0.593 - 1, rel=0.02)  # the film's local exponent, in asymptotics.md
    for quantity in ("film_center", "film_min", "friction_total"):
        value = names["coarse"].dimensional[quantity]
        assert abs(value - names["fine"].dimensional[quantity]) < value.error
    assert (tmp_path / "first_contact.png").exists()


def test_stribeck_curve(tmp_path, monkeypatch):
    names = run("stribeck_curve", tmp_path, monkeypatch)
    assert names["both"].reduced_modulus == pytest.approx(names["rig"].reduced_modulus / 2)
    assert (names["table"]["lambda_ratio"].diff().dropna() > 0).sum() == 90  # grows with the speed, for every load
    assert (tmp_path / "stribeck_curve.png").exists()


def test_worn_ball(tmp_path, monkeypatch):
    names = run("worn_ball", tmp_path, monkeypatch)
    assert names["indenter"].tolerance == pytest.approx(names["NOISE"], rel=0.15)
    assert abs(names["smoothing"]) < 0.01
    # The flat that is left, √(2Rh) of the height worn off, bears the load with less pressure.
    assert names["worn"].dimensional["contact_radius"] == pytest.approx(np.sqrt(2 * names["R"] * names["WORN"]), rel=0.3)
    for quantity, told in (("film_center", -0.07), ("film_min", -0.22), ("friction_total", 0.4), ("pressure_max", -1 / 3)):
        assert names["change"][quantity] == pytest.approx(told, abs=0.03)
    assert (tmp_path / "worn_ball.png").exists()


def test_fit_viscosity(tmp_path, monkeypatch):
    names = run("fit_viscosity", tmp_path, monkeypatch)
    assert names["viscosity"].low <= 2.0 <= names["viscosity"].high
    assert names["fit"].hold_out.probability > 0.01
    assert (tmp_path / "fit_viscosity.png").exists()


@pytest.mark.slow
def test_hyaluronic_acid(tmp_path, monkeypatch):
    names = run("hyaluronic_acid", tmp_path, monkeypatch, doubt="the liquid thins with shear")
    assert names["fit"].model.candidate.kind == "carreau-yasuda"  # what the data were made with
    # A constant viscosity with the same film, which goes like it to the power 0.6, is the law's at a rate of the film.
    same_film = names["ratio"]["film_center"] ** (-1 / 0.6) * names["fit"].liquid.viscosity
    found = names["thinning"].dimensional
    slow, fast = names["fit"].viscosity([1e-3 / found["film_inlet"] / 2, found["shear_rate_max"]])
    assert fast < same_film < slow
    assert names["ratio"]["film_center"] == pytest.approx(3.85, rel=2e-3)
    assert names["ratio"]["friction_total"] == pytest.approx(2.40, rel=3e-3)
    assert names["gain"] == pytest.approx(1.468, rel=2e-3)
    assert names["exponent"]["film_center [m]"] < 0.6
    assert names["exponent"]["friction_coefficient"] < 0.4
    assert (tmp_path / "hyaluronic_acid_stribeck.png").exists()


def test_layer_under_lens(tmp_path, monkeypatch):
    names = run("layer_under_lens", tmp_path, monkeypatch)
    # what the text of the page says: indentation, centre film, minimum film, friction at t/a = 4
    assert names["changes"]["2 mm"] == pytest.approx([-0.18, -0.0067, -0.0079, -0.0015], abs=1e-4)
    dry = softlube.dry.dry_contact_at(softlube.substrates.LayerKernel(thickness_in_units(names)), load=4 / (3 * np.pi))
    # The film holds the lens up by a part of its thickness.
    lubricated = names["layers"]["0.3 mm"].dimensional
    difference = float(names["half_space"].dimensional["indentation"]) * dry.indentation - float(lubricated["indentation"])
    assert 0 < difference < lubricated["film_center"]
    assert (tmp_path / "layer_under_lens.png").exists()


def thickness_in_units(names):
    """Thickness of 0.3 mm in units of √(Rδ), with the Hertz indentation δ of the load."""
    contact = names["half_space"].dimensional
    return 0.3e-3 / float(contact["contact_radius"])


@pytest.mark.slow
def test_pdms_memory(tmp_path, monkeypatch):
    names = run("pdms_memory", tmp_path, monkeypatch)
    assert [term.time for term in names["fit"].terms] == pytest.approx([1e-3, 1e-2, 0.1, 1, 10], rel=0.1)  # the data's own
    found = names["found"]
    assert float(found["friction_hysteresis"]) == pytest.approx(1.322e-3, rel=2e-3)
    assert found["friction_viscous"] + found["friction_hysteresis"] == pytest.approx(float(found["friction_total"]), rel=1e-6)
    assert names["coefficient"] == pytest.approx(names["rule"], rel=0.1)  # the rule is one for a little loss
    assert names["elastic"].dimensional["film_center"] == pytest.approx(174.1e-9, rel=1e-3)  # the README's contact
    assert names["growth"] < 2
    assert names["by_liquid"] == pytest.approx(40**0.44, rel=0.15)
    assert names["share_little"] == pytest.approx(0.27, abs=0.01)
    assert names["more"] == pytest.approx(0.227, abs=0.005)
    # The published series at v/a, by the loss tangent (Greenwood & Tabor 1958).
    radius, series = float(names["plain"]["contact_radius"]), names["elite"].terms
    modulus = 1.196e6 + sum(3 * term.weight / (1 + radius / (1j * 1e-3 * term.time)) for term in series)  # weights are of G
    rule = 3 / 16 * np.pi * modulus.imag / modulus.real * radius / 2e-3 * 0.1
    assert float(names["found_elite"]["friction_hysteresis"]) == pytest.approx(rule, rel=0.1)
    for picture in ("moduli", "film", "stribeck"):
        assert (tmp_path / f"pdms_memory_{picture}.png").exists()


def test_squeeze_dimple(tmp_path, monkeypatch):
    names = run("squeeze_dimple", tmp_path, monkeypatch)
    assert names["exponent"] == pytest.approx(-0.5, abs=0.005)
    assert names["fall"].dimple_time == pytest.approx(7.11e-3, rel=0.01)
    assert names["touch"].time[-1] == pytest.approx(0.5327, rel=1e-3)  # the sweep of docs/how-to/sweeps.md
    assert (tmp_path / "squeeze_dimple.png").exists()


@pytest.mark.slow
def test_killed_sweep(tmp_path, monkeypatch, capfd):
    names = run("killed_sweep", tmp_path, monkeypatch)
    assert 10 <= names["kept"] < 36
    assert f"{names['kept']} were in the store, {36 - names['kept']} solved now" in names["second"].stdout
    assert "same table: True" in capfd.readouterr().out
    assert names["table"]["film_min [m]"].iloc[0] == pytest.approx(46.32e-9, rel=1e-3)
    assert (tmp_path / "killed_sweep.png").exists()


def test_read_solution(tmp_path, monkeypatch):
    names = run("read_solution", tmp_path, monkeypatch)
    # Below the Hertz maximum 2/π² at so small a β, and above none of it
    assert names["highest"] == pytest.approx(2 / np.pi**2, rel=0.02)
    # The y axis passes beside the side lobe, which lies behind it.
    assert float(names["solution"].film_min) < names["film"].min() < float(names["solution"].film_center)
    assert (tmp_path / "read_solution.png").exists()


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
