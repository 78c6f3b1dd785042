"""Squeeze films and starts of sliding in SI: known laws with units, histories from files, refusals that name the parameter."""

import math

import numpy as np
import pytest

import softlube
from softlube.errors import InputError, NotConvergedError
from softlube.model.dry import dry_contact_at
from softlube.model.exact import HERTZ_LOAD
from softlube.model.substrates import LayerKernel

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s"}
FALL = BALL | {"load": "100 mN", "initial_height": "100 um", "duration": "0.1 s"}
SLIDING = BALL | {"load": "100 mN", "speed": "20 mm/s"}
START = SLIDING | {"initial_height": "100 um", "duration": "0.2 s", "accuracy": 0.05}


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
    taylor = 6 * math.pi * 2 * 2e-3**2 * 1e-6 / result.histories["height"]
    assert result.histories["height"][-1] == pytest.approx(10e-6)
    assert result.histories["load"][-1] == pytest.approx(taylor[-1], rel=2e-3)
    assert result.final["load"].unit == "N"


def test_load_in_newtons_and_dimple_in_metres(fall):
    assert fall.histories["load"] == pytest.approx(0.1)
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
    path.write_text("# pressed, then held\ntime (ms); load [mN]\n0; 100\n50; 100,0\n100; 100\n", encoding="utf-8")
    result = softlube.squeeze(**BALL, history=path, initial_height="100 um")
    assert result.final["film_min"] == pytest.approx(fall.final["film_min"], rel=1e-3)
    assert result.setup.description == "history h.csv"
    path.write_text("time,height\n0,2e-5\n1,1e-5\n2,2e-5\n", encoding="utf-8")
    there_and_back = softlube.squeeze(**BALL, history=str(path))
    assert there_and_back.histories["load"].min() < 0 < there_and_back.histories["load"].max()


def test_a_history_is_as_good_as_its_file(tmp_path):
    path = tmp_path / "h.csv"
    path.write_text("time,height\n0,2e-5\n0.1,1e-5\n", encoding="utf-8")
    course = softlube.History("height", [0, 0.1], [2e-5, 1e-5])
    one, two = (softlube.squeeze(**BALL, history=each, accuracy=0.02).final for each in (path, course))
    assert one == two
    assert softlube.squeeze(**BALL, history=softlube.read_history(path), accuracy=0.02).final == one


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
    assert pulled.histories["pressure_min"].min() < 0
    assert np.all(pulled.histories["load"][1:] < 0)
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
        ({"load": None, "history": 3}, "history: expected a file or a softlube.History"),
        ({"history": "none.csv"}, "load, history: given together"),
        ({"load": None, "history": "none.csv"}, "history: none.csv: the file does not exist"),
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


def test_a_liquid_that_no_pressure_drives_out_is_refused():
    """1 − αq < 0: under Barus' law a rigid sphere cannot come down at that speed."""
    with pytest.raises(NotConvergedError, match="rises too steeply"):
        softlube.squeeze(
            **BALL, approach_speed="1 um/s", initial_height="20 um", duration="10 s", pressure_viscosity="50 kPa^-1"
        )


def test_ends_in_steady_sliding(started):
    steady = softlube.Contact(**SLIDING).solve().dimensional
    for name in ("film_center", "film_min", "friction_domain", "pressure_max"):
        assert started.final[name] == pytest.approx(float(steady[name]), rel=5e-3), name
        assert started.final[name].unit == steady[name].unit
    assert -started.final["height"] == pytest.approx(float(steady["indentation"]), rel=1e-3)


def test_on_a_layer_it_ends_in_steady_sliding():
    model = {"thickness": "0.5 mm", "poisson_ratio": 0.4, "base": "frictionless", "pressure_viscosity": "0.5 MPa^-1"}
    start = softlube.slide(**START | {"duration": "0.1 s"}, **model)
    steady = softlube.Contact(**SLIDING, **model).solve().dimensional
    for name in ("film_center", "film_min", "friction_domain", "pressure_max"):
        assert start.final[name] == pytest.approx(float(steady[name]), rel=6e-3), name
    assert -start.final["height"] == pytest.approx(float(steady["indentation"]), rel=1e-3)
    assert any("dry contact thick" in doubt for doubt in start.warnings)


def test_a_height_from_a_file_ends_in_steady_sliding(tmp_path):
    path = tmp_path / "h.csv"
    path.write_text("time [ms],height [um]\n0,20\n10,-20\n20,-40\n120,-40\n", encoding="utf-8")
    moved = {name: value for name, value in SLIDING.items() if name != "load"}
    start = softlube.slide(**moved, history=path, accuracy=0.1)
    steady = softlube.Contact(**moved, indentation="40 um").solve().dimensional
    assert start.histories["height"][[0, -1]] == pytest.approx([20e-6, -40e-6])
    for name in ("film_center", "film_min", "load", "pressure_max"):
        assert start.final[name] == pytest.approx(float(steady[name]), rel=2e-2), name
    assert start.run.fields[-1].height == pytest.approx(-2)


def test_film_limit_of_a_start(started):
    stopped = softlube.slide(**START | {"film_limit": "20 um", "duration": "10 ms"})
    assert stopped.run.ended_by == stopped.to_dict()["ended_by"] == "film_limit"
    assert stopped.final["film_min"] == pytest.approx(20e-6, rel=1e-3)
    crossed = np.interp(-20e-6, -started.histories["film_min"], started.time)
    assert stopped.time[-1] == pytest.approx(crossed, rel=5e-3)
    assert 0 < stopped.time_error < 0.05 * stopped.time[-1]


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"load": None}, "load, .*: all missing"),
        ({"speed": None}, "speed: missing"),
        ({"load": lambda t: 0.1 * np.cos(100 * t)}, "not positive all the time"),
        ({"duration": None}, "duration: missing"),
        ({"initial_height": "0 m"}, "initial_height"),
        ({"pressed": "-1 s"}, "pressed"),
        ({"load": None, "approach_speed": "1 um/s", "pressed": "1 s"}, "pressed: a sphere is pressed by a load"),
        ({"film_limit": "150 um"}, "film_limit"),
        ({"cavitation": "jfo"}, "cavitation"),
        ({"accuracy": 1e-6}, "accuracy"),
        ({"speed": "-1 m/s"}, "speed"),
    ],
)
def test_a_start_is_refused(change, text):
    with pytest.raises(InputError, match=text):
        softlube.slide(**START | change)
