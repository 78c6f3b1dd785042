"""What squeeze films and starts of sliding share: names, units, errors, warnings."""

import json
from dataclasses import fields

import numpy as np
import pytest

import softlube
from softlube.model.quantities import QUANTITIES
from softlube.transient.history import Transient

EVERY = ["squeezed", "slid", "fall", "started"]


def public(kind):
    return {name for name in (*dir(kind), *(each.name for each in fields(kind))) if not name.startswith("_")}


def test_sisters_have_the_same_names():
    common = public(Transient) | set(Transient.__annotations__)
    assert public(softlube.Squeeze) - common == {"rings", "dimple_time"}
    assert public(softlube.Slide) - common == {"angles", "theta"}


@pytest.mark.parametrize("name", EVERY)
def test_shapes_and_signs(request, name):
    result = request.getfixturevalue(name)
    steps = result.time.size
    assert result.film.shape == result.pressure.shape
    assert result.film.shape[:2] == (steps, result.r.size)
    assert result.histories.keys() == result.errors.keys() == result.final.keys() <= QUANTITIES.keys()
    for history, errors in zip(result.histories.values(), result.errors.values(), strict=True):
        assert history.shape == errors.shape == (steps,)
        assert np.all(errors >= 0)
    assert np.all(result.histories["film_min"] <= result.histories["film_center"] * (1 + 1e-6))
    assert result.time_error == 0.0


@pytest.mark.parametrize("name", EVERY)
def test_final_values_are_the_last_ones(request, name):
    result = request.getfixturevalue(name)
    for quantity in ("film_center", "load"):
        assert result.final[quantity] == result.histories[quantity][-1]
        assert result.final[quantity].error == result.errors[quantity][-1]
    units = ("m", "N") if name in ("fall", "started") else ("", "")
    assert (result.final["film_center"].unit, result.final["load"].unit) == units


@pytest.mark.parametrize("name", ["fall", "started"])
def test_in_si_everything_is_the_normalised_times_its_unit(request, name):
    result = request.getfixturevalue(name)
    assert result.time == pytest.approx(result.run.time * result.setup.units["time"][0], rel=1e-15)
    assert result.time[-1] == pytest.approx(result.setup.duration, rel=1e-12)
    for quantity, values in result.values.items():
        scale = result.setup.units[QUANTITIES[quantity].dimension][0]
        assert result.histories[quantity] == pytest.approx(values * scale, rel=1e-15)
        assert result.errors[quantity] == pytest.approx(result.value_errors[quantity] * scale, rel=1e-15)
    assert result.histories["load"][1:] == pytest.approx(0.1)
    assert result.scale("pressure") == result.setup.units["pressure"]


def test_without_a_physical_input_nothing_is_scaled_or_doubted(squeezed, slid):
    for result in (squeezed, slid):
        assert result.scale("load") == (1.0, "")
        assert result.time.tolist() == result.run.time.tolist()
        assert result.warnings == ()


def test_warnings_are_those_of_the_physical_input(started):
    """The physical input is told the extremes in SI."""
    extremes = started.extremes
    assert started.warnings == started.setup.doubts(extremes)
    assert extremes.largest_pressure == started.histories["pressure_max"].max()
    assert extremes.least_pressure == started.pressure.min() >= 0


@pytest.mark.parametrize("name", EVERY)
def test_json(request, name):
    result = request.getfixturevalue(name)
    plain = json.loads(json.dumps(result.to_dict(), allow_nan=False))
    common = {"ended_by", "time", "final", "accuracy", "steps", "warnings"}
    own = {"rings", "volume_error", "dimple_time"} if isinstance(result, softlube.Squeeze) else {"angles", "rejected_steps"}
    assert plain.keys() == common | own
    assert plain["time"] == {"value": result.time[-1], "error": 0.0}
    assert plain["final"]["film_min"]["unit"] == result.final["film_min"].unit or "1"
    assert plain["steps"] == result.time.size


def test_the_error_of_a_film_limit_s_time_is_in_seconds():
    ball = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "load": "100 mN"}
    fall = softlube.squeeze(**ball, initial_height="100 um", duration="0.1 s", film_limit="5 um")
    assert fall.run.ended_by == "film_limit"
    assert 0 < fall.time_error == fall.end_error * fall.setup.units["time"][0] < 1e-3 * fall.time[-1]
