"""SI input and output: Taylor's law with units, histories from files, refusals that name the parameter."""

import json
import math

import numpy as np
import pytest
import xarray as xr

import softlube
from softlube import substrates
from softlube.errors import InputError, NotConvergedError
from softlube.model import liquids as liquids
from softlube.model.dry import dry_contact_at
from softlube.model.exact import HERTZ_LOAD
from softlube.model.substrates import LayerKernel
from softlube.physical.squeeze import read_history

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s"}
FALL = BALL | {"load": "100 mN", "initial_height": "100 um", "duration": "0.1 s"}


@pytest.fixture(scope="module")
def fall():
    return softlube.squeeze(**FALL)


def test_stiff_substrate_gives_taylor_s_law_in_newtons():
    """6πηR²V/h for a ball on something that hardly yields."""
    result = softlube.squeeze(
        radius="2 mm",
        young_modulus="10 MPa",
        viscosity="2 Pa s",
        approach_speed="1 um/s",
        initial_height="20 um",
        duration="10 s",
    )
    taylor = 6 * math.pi * 2 * 2e-3**2 * 1e-6 / result.history("height")
    assert result.history("height")[-1] == pytest.approx(10e-6)
    assert result.history("load")[-1] == pytest.approx(taylor[-1], rel=2e-3)
    assert result.final["load"].unit == "N"


def test_load_in_newtons_and_dimple_in_metres(fall):
    assert fall.history("load") == pytest.approx(0.1)
    assert 0.9 < fall.final["film_min_radius"] / math.sqrt(2e-3 * -fall.final["height"]) < 1.1
    assert fall.time[-1] == pytest.approx(0.1)
    assert 0.001 < fall.dimple_time < 0.1
    assert fall.dataset.film.attrs["units"] == "m"
    assert not fall.warnings


def test_pressure_in_pascals_carries_the_load(fall):
    """∫p 2πr dr by the trapezoidal rule on the SI fields."""
    found = np.trapezoid(2 * np.pi * fall.r * fall.pressure[-1], fall.r)
    assert found == pytest.approx(0.1, rel=5e-3)


def test_a_function_is_as_good_as_a_constant(fall):
    same = softlube.squeeze(**FALL | {"load": lambda t: 0.1})
    assert same.final["film_min"] == pytest.approx(fall.final["film_min"], rel=1e-3)
    speed = BALL | {"duration": "1 s"}
    one = softlube.squeeze(**speed, approach_speed="10 um/s", initial_height="20 um")
    two = softlube.squeeze(**speed, height=lambda t: 20e-6 - 10e-6 * t)
    assert two.final["load"] == pytest.approx(one.final["load"], rel=1e-3)


def test_history_from_a_file(tmp_path, fall):
    path = tmp_path / "h.csv"
    path.write_text("# pressed, then held\ntime [ms], load [mN]\n0, 100\n50, 100\n100, 100\n", encoding="utf-8")
    result = softlube.squeeze(**BALL, history=path, initial_height="100 um")
    assert result.final["film_min"] == pytest.approx(fall.final["film_min"], rel=1e-3)
    path.write_text("time,height\n0,2e-5\n1,1e-5\n2,2e-5\n", encoding="utf-8")
    there_and_back = softlube.squeeze(**BALL, history=path)
    assert there_and_back.history("load").min() < 0 < there_and_back.history("load").max()


def test_suction_beyond_the_atmosphere_is_warned_of():
    result = softlube.squeeze(
        **BALL | {"young_modulus": "30 MPa"}, approach_speed="-100 mm/s", initial_height="5 um", duration="0.2 ms"
    )
    assert any("cavitate" in doubt for doubt in result.warnings)


def test_on_a_layer_the_ball_comes_to_the_dry_contact():
    """In SI: the load N at the indentation δ of the dry contact, in units of the half-space's Hertz indentation."""
    slab = BALL | {"thickness": "0.5 mm", "poisson_ratio": 0.3, "base": "frictionless"}
    press = softlube.squeeze(**slab, load="100 mN", initial_height="100 um", duration="1000 s")
    modulus = 3e6 / (1 - 0.3**2)  # E*
    hertz = (9 * 0.1**2 / (16 * modulus**2 * 2e-3)) ** (1 / 3)
    layer = LayerKernel(0.5e-3 / math.sqrt(2e-3 * hertz), 0.3, "frictionless")
    dry = dry_contact_at(layer, load=HERTZ_LOAD)
    assert press.final["height"] == pytest.approx(-dry.indentation * hertz, rel=5e-3)
    highest = modulus * math.sqrt(hertz / 2e-3) * math.pi * float(dry.pressure(0.0))  # 4πG → πE*
    assert press.final["pressure_center"] == pytest.approx(highest, rel=2e-3)
    assert 0.9 < press.final["film_min_radius"] / (dry.radius * math.sqrt(2e-3 * hertz)) < 1
    assert press.run.volume_error < 1e-6
    effect = 100 * (dry.indentation - 1)
    assert any(f"indentation of a dry contact {effect:+.2g} %" in doubt for doubt in press.warnings)


def test_a_very_thick_layer_is_the_half_space(fall):
    thick = softlube.squeeze(**FALL, thickness="2 m")
    for name in ("film_center", "film_min", "height", "pressure_center"):
        assert thick.final[name] == pytest.approx(float(fall.final[name]), rel=1e-3), name
    assert not thick.warnings


def test_poisson_s_ratio_acts_through_the_effective_modulus():
    """A half-space of E and ν is an incompressible one with E* = E/(1 − ν²)."""
    given = FALL | {"duration": "0.01 s"}
    one = softlube.squeeze(**given | {"poisson_ratio": 0.2})
    two = softlube.squeeze(**given | {"young_modulus": 3e6 * 0.75 / (1 - 0.2**2)})
    for name in ("film_center", "height", "pressure_center"):
        assert one.final[name] == pytest.approx(float(two.final[name]), rel=1e-9), name


def test_a_layer_that_is_pulled_from_and_pressed_to_a_height():
    slab = BALL | {"thickness": "0.2 mm"}
    pulled = softlube.squeeze(**slab, approach_speed="-10 um/s", initial_height="5 um", duration="1 s")
    assert pulled.history("pressure_min").min() < 0
    assert np.all(pulled.history("load")[1:] < 0)
    pressed = softlube.squeeze(**slab, height=lambda t: 5e-6 - 25e-6 * min(t, 1.0), duration="2 s", accuracy=1e-2)
    depth = dry_contact_at(LayerKernel(0.2e-3 / math.sqrt(2e-3 * 5e-6)), indentation=4.0)
    assert pressed.final["load"] == pytest.approx(4 * math.pi * 1e6 * 5e-6 * math.sqrt(2e-3 * 5e-6) * depth.load, rel=0.05)
    assert any("load of a dry contact +" in doubt for doubt in pressed.warnings)


def test_barus_in_si():
    """P = −ln(1 − αq)/α with Taylor's q = 3ηRV/h² under a ball on something that hardly yields."""
    result = softlube.squeeze(
        **BALL | {"young_modulus": "10 MPa"},
        approach_speed="1 um/s",
        initial_height="20 um",
        duration="10 s",
        pressure_viscosity="5 kPa^-1",
    )
    q = 3 * 2 * 2e-3 * 1e-6 / 10e-6**2
    assert result.final["pressure_center"] == pytest.approx(-math.log(1 - 5e-3 * q) / 5e-3, rel=5e-3)
    assert not result.warnings
    thin = softlube.squeeze(**FALL, pressure_viscosity="1 GPa^-1")
    assert any("the viscosity rises by 0.04" in doubt for doubt in thin.warnings)


def test_the_file_records_substrate_and_liquid(tmp_path):
    model = {"thickness": "1 mm", "poisson_ratio": 0.4, "base": "frictionless", "pressure_viscosity": "1 MPa^-1"}
    press = softlube.squeeze(**FALL | {"duration": "1 ms", "accuracy": 0.01}, **model)
    press.save(tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as data:
        inputs = json.loads(data.attrs["inputs_SI"])
        assert (inputs["thickness"], inputs["poisson_ratio"], inputs["base"]) == (1e-3, 0.4, "frictionless")
        assert inputs["pressure_viscosity"] == pytest.approx(1e-6)
        assert substrates.from_plain(json.loads(data.attrs["substrate"])) == press.run.motion.substrate
        assert liquids.from_plain(json.loads(data.attrs["liquid"])) == press.run.motion.liquid
        assert data.film.attrs["units"] == "m"
    press.plot(tmp_path / "a.png")


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"thickness": "0 m"}, "thickness: expected a positive"),
        ({"base": "frictionless"}, "base, thickness: the first means nothing without the second"),
        ({"poisson_ratio": 0.6}, "poisson_ratio: expected a number between 0 and 0.5"),
        ({"viscosity_law": "roelands"}, "viscosity_law, pressure_viscosity"),
        ({"pressure_viscosity": "1 Pa"}, "pressure_viscosity: 1 Pa has the wrong dimension"),
        ({"radius": None}, "radius: missing"),
        ({"load": None}, "all missing"),
        ({"approach_speed": "1 um/s"}, "load, approach_speed: given together"),
        ({"shear_modulus": "1 MPa"}, "young_modulus, shear_modulus: are both given"),
        ({"initial_height": None}, "initial_height: missing"),
        ({"initial_height": "-1 um"}, "initial_height: expected a positive"),
        ({"initial_height": "1 s"}, "initial_height: '?1 s'? has the wrong dimension"),
        ({"duration": None}, "duration: missing"),
        ({"duration": "1 m"}, "duration: 1 m has the wrong dimension"),
        ({"duration": "10"}, "duration: '10' has no unit"),
        ({"duration": "-1 s"}, "duration: expected a positive"),
        ({"load": None, "approach_speed": "0 m/s"}, "approach_speed: zero"),
        ({"load": "-1 N"}, "load: expected a positive"),
        ({"load": lambda t: -1.0}, "load: expected a history that presses"),
        ({"load": None, "height": lambda t: 1e-5}, "initial_height: the history has its own"),
        ({"load": None, "height": lambda t: -1e-5, "initial_height": None}, "height: expected a history that starts above"),
        ({"film_limit": "200 um"}, "film_limit"),
        ({"young_modulus": "1 GPa", "load": None, "approach_speed": "1 um/s", "duration": "50 s"}, "rigid sphere"),
    ],
)
def test_refused(change, text):
    with pytest.raises(InputError, match=text):
        softlube.squeeze(**FALL | change)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "line 1: expected two columns"),
        ("time,speed\n0,1\n1,2\n", "line 1: expected two columns headed"),
        ("0,1\n1,2\n", "line 1: expected two columns headed"),
        ("time,load\n0,a\n", "line 2: expected two numbers, got '0, a'"),
        ("time [kg],load\n0,1\n1,1\n", "line 1: cannot read '1 kg'"),
        ("time,load\n0\n1\n", "line 2: expected two numbers"),
        ("# a rig\ntime,load\n\n0,1\n1,nan\n", "line 5: expected finite numbers"),
        ("time,load\n1,1\n2,1\n", "line 2: expected times that start at 0"),
        ("time,load\n0,1\n2,1\n2,1\n", "line 4: expected times that start at 0 and increase, got 2"),
        ("time,load\n0,1\n", "line 2: expected at least two points"),
    ],
)
def test_bad_files_are_refused_with_the_line(tmp_path, text, message):
    path = tmp_path / "h.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=f"history: '.*h.csv', {message}"):
        read_history(path)
    with pytest.raises(InputError, match="does not exist"):
        read_history(tmp_path / "none.csv")


def test_a_liquid_that_no_pressure_drives_out_is_refused():
    """1 − αq < 0: under Barus' law a rigid sphere cannot come down at that speed."""
    with pytest.raises(NotConvergedError, match="rises too steeply"):
        softlube.squeeze(
            **BALL, approach_speed="1 um/s", initial_height="20 um", duration="10 s", pressure_viscosity="50 kPa^-1"
        )
