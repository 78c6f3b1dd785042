"""SI input and output: Taylor's law with units, histories from files, refusals that name the parameter."""

import math

import numpy as np
import pytest

import softlube
from softlube.approach.physical import read_history
from softlube.errors import InputError

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


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"radius": None}, "radius: missing"),
        ({"load": None}, "all missing"),
        ({"approach_speed": "1 um/s"}, "load, approach_speed: given together"),
        ({"shear_modulus": "1 MPa"}, "young_modulus, shear_modulus: are both given"),
        ({"initial_height": None}, "initial_height: missing"),
        ({"initial_height": "-1 um"}, "initial_height: expected a positive"),
        ({"initial_height": "1 s"}, "initial_height: '?1 s'? has the wrong dimension"),
        ({"duration": None}, "duration: missing"),
        ({"duration": "1 m"}, "duration: cannot read"),
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
    "text", ["", "time,speed\n0,1\n1,2\n", "0,1\n1,2\n", "time,load\n0,a\n", "time [kg],load\n0,1\n1,1\n", "time,load\n0\n1\n"]
)
def test_bad_files_are_refused(tmp_path, text):
    path = tmp_path / "h.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match="history"):
        read_history(path)
    with pytest.raises(InputError, match="does not exist"):
        read_history(tmp_path / "none.csv")
