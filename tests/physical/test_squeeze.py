"""How a sphere is moved, in SI: the normalised motion, histories, refusals."""

import math

import numpy as np
import pytest

import softlube
from softlube.errors import InputError
from softlube.model.exact import HERTZ_LOAD
from softlube.physical.squeeze import WAYS, WRITTEN_WAYS, History, check_one_way, read_motion

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s"}
FALL = BALL | {"load": "100 mN", "initial_height": "100 um", "duration": "0.1 s"}


def test_a_load_is_normalised_with_its_hertz_contact():
    setup, motion = read_motion(FALL)
    indentation = (3 * 0.1 / (16 * 1e6 * math.sqrt(2e-3))) ** (2 / 3)  # Eq. (29)
    assert setup.unit_height == pytest.approx(indentation, rel=1e-14)
    assert motion.control == "load"
    assert motion.drive(0.0) == pytest.approx(HERTZ_LOAD, rel=1e-12)
    assert motion.initial_height == pytest.approx(100e-6 / indentation, rel=1e-14)
    assert motion.duration * setup.units["time"][0] == pytest.approx(0.1, rel=1e-14)
    assert setup.description == "load 100 mN"


def test_a_speed_is_normalised_with_the_height_at_first():
    setup, motion = read_motion(BALL | {"approach_speed": "-10 um/s", "initial_height": "5 um", "duration": "2 s"})
    assert setup.unit_height == pytest.approx(5e-6, rel=1e-14)
    assert (motion.control, motion.initial_height) == ("height", 1.0)
    assert motion.drive(motion.duration) == pytest.approx(5.0, rel=1e-12)  # 20 µm further away


@pytest.mark.parametrize("control", ["load", "height"])
def test_a_history_is_the_motion_at_its_points(control):
    values = {"load": [0.02, 0.1, 0.05], "height": [2e-5, -1e-5, 1e-5]}[control]
    course = History(control, [0, 0.5, 2], values, "rig 3")
    start = {"initial_height": "100 um"} if control == "load" else {}
    setup, motion = read_motion(BALL | {"history": course} | start)
    time, unit = setup.units["time"][0], setup.units[control][0]
    assert [motion.drive(t / time) * unit for t in course.time] == pytest.approx(values, rel=1e-12)
    assert (setup.duration, setup.description) == (2.0, "history rig 3")
    assert setup.initial_height == pytest.approx(100e-6 if control == "load" else 2e-5, rel=1e-14)


def test_a_substrate_creeps_in_the_time_of_the_film():
    """Its creep times, 9/3 of the relaxation time, over 16ηR²/(πN); an elastic ball yields at once."""
    given = FALL | {"prony": "6 MPa @ 20 ms"}
    setup, motion = read_motion(given)
    assert motion.substrate.shares == pytest.approx((2 / 3,))
    assert motion.substrate.times == pytest.approx((0.06 / (16 * 2 * 2e-3**2 / (math.pi * 0.1)),))
    assert setup.unit_height == read_motion(FALL)[0].unit_height  # of the relaxed substrate
    _, soft = read_motion(given | {"ball_young_modulus": "3 MPa", "ball_poisson_ratio": 0.5})
    assert soft.substrate.shares == pytest.approx((1 / 3,))
    _, layer = read_motion(given | {"thickness": "0.5 mm"})
    assert layer.substrate.elastic == read_motion(FALL | {"thickness": "0.5 mm"})[1].substrate


def test_on_a_layer_that_remembers_the_doubt_is_that_of_the_relaxed_one(fall):
    deep = type(fall.extremes)(**vars(fall.extremes) | {"least_height": -3e-5})
    doubts = [
        read_motion(FALL | {"thickness": "0.5 mm"} | series)[0].doubts(deep) for series in ({}, {"prony": "6 MPa @ 20 ms"})
    ]
    assert doubts[0] == doubts[1]
    assert "compared with a half-space" in doubts[0][-1]


def test_histories_are_checked():
    assert isinstance(softlube.History("load", [0, 1], [1, 1]).values, np.ndarray)
    for control, time, values, message in (
        ("speed", [0, 1], [1, 1], "expected a history of 'load' or 'height', got 'speed'"),
        ("load", [0, 1], [1, 1, 1], "at least two points"),
        ("load", [0], [1], "at least two points"),
        ("load", [0, 1], [1, np.nan], "finite numbers"),
        ("load", [0, 1, 1], [1, 1, 1], "times that start at 0 and increase"),
        ("load", [1, 2], [1, 1], "times that start at 0 and increase"),
    ):
        with pytest.raises(InputError, match=f"history: .*{message}"):
            History(control, time, values)


def test_exactly_one_way_of_moving():
    check_one_way({"load": 1.0, "radius": 1.0}, WAYS)
    with pytest.raises(InputError, match="load, approach_speed, height, history: all missing; give exactly one"):
        check_one_way({}, WAYS)
    with pytest.raises(InputError, match=r"^load, history: given together; give exactly one of them$"):
        check_one_way({"load": 1.0, "history": "h.csv"}, WRITTEN_WAYS)


def test_doubts(fall):
    extremes = fall.extremes
    assert fall.setup.doubts(extremes) == ()
    suction = type(extremes)(**vars(extremes) | {"least_pressure": -2e5})
    assert any("2e+05 Pa below the surroundings" in doubt for doubt in fall.setup.doubts(suction))
    fast = type(extremes)(**vars(extremes) | {"largest_speed": 10.0})
    assert any("inertia" in doubt for doubt in fall.setup.doubts(fast))
    deep = type(extremes)(**vars(extremes) | {"least_height": -3e-4})
    assert any("linear elasticity" in doubt for doubt in fall.setup.doubts(deep))


def test_two_bodies_are_squeezed_as_the_one_that_they_make_up():
    """E* of both moduli and R of both curvatures, on a rigid ball and an incompressible half-space with G = E*/4."""
    two = FALL | {"ball_young_modulus": "5 MPa", "ball_poisson_ratio": 0.3, "poisson_ratio": 0.4, "substrate_radius": "-5 mm"}
    modulus, radius = 1 / ((1 - 0.3**2) / 5e6 + (1 - 0.4**2) / 3e6), 1 / (1 / 2e-3 - 1 / 5e-3)
    one = FALL | {"young_modulus": None, "shear_modulus": modulus / 4, "radius": radius}
    (setup, motion), (expected, _) = read_motion(two), read_motion(one)
    assert setup.unit_height == pytest.approx(expected.unit_height, rel=1e-13)
    for name, (value, unit) in expected.units.items():
        assert setup.units[name] == (pytest.approx(value, rel=1e-13), unit)
    assert read_motion(two | {"thickness": "1 mm"})[1].substrate.share == pytest.approx(modulus * (1 - 0.4**2) / 3e6, rel=1e-13)
    assert motion.drive(0.0) == pytest.approx(HERTZ_LOAD, rel=1e-12)
