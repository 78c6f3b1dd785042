"""What is prescribed against time: values, and back from plain values."""

import json

import numpy as np
import pytest

from softlube.errors import InputError
from softlube.transient.drives import Constant, Descent, Points, from_plain, sampled, to_plain

DRIVES = [Constant(0.3), Descent(1.0, 0.25), Points((0.0, 1.0, 3.0), (1.0, 2.0, 0.5))]


@pytest.mark.parametrize("drive", DRIVES, ids=lambda drive: drive.kind)
def test_many_times_are_one_after_the_other(drive):
    times = np.linspace(0, 3, 13)
    each = [drive(time) for time in times]
    assert drive.at(times) == pytest.approx(each)
    assert sampled(drive, times) == pytest.approx(each)


def test_values():
    assert Constant(0.3)(7.0) == 0.3
    assert Descent(1.0, 0.25)(2.0) == 0.5
    assert Descent(1.0, -0.25)(2.0) == 1.5


def test_points_are_met_and_make_no_extremes_of_their_own():
    drive = Points((0.0, 1.0, 3.0, 4.0), (1.0, 2.0, 2.0, -1.0))
    assert [drive(time) for time in drive.time] == pytest.approx(drive.values)
    assert sampled(drive, np.linspace(1, 3, 50)) == pytest.approx(2.0)
    assert np.all(np.diff(sampled(drive, np.linspace(0, 1, 50))) > 0)
    assert sampled(drive, np.linspace(0, 4, 500)).max() == pytest.approx(2.0)


def test_any_function_can_be_sampled_but_not_written_down():
    assert sampled(lambda time: time**2, np.array([1.0, 2.0])).tolist() == [1.0, 4.0]
    with pytest.raises(InputError, match="history: a function of the time cannot be written down"):
        to_plain(lambda time: time**2)


@pytest.mark.parametrize("drive", DRIVES, ids=lambda drive: drive.kind)
def test_round_trip_through_json(drive):
    assert from_plain(json.loads(json.dumps(to_plain(drive)))) == drive
