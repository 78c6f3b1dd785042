"""Labels of logarithmic axes: few, plain and apart."""

from itertools import pairwise

import numpy as np
import pytest
from matplotlib.figure import Figure

from softlube.plots.axes import label_logarithmic


def labels(low, high):
    """Texts of the labels on an axis, with their places in inches."""
    figure = Figure(figsize=(3.5, 3.0), layout="constrained")
    ax = figure.subplots()
    ax.plot([low, high], [1, 2])
    ax.set(xscale="log", xlim=(low, high))
    label_logarithmic(ax)
    figure.draw_without_rendering()
    shown = [each for each in [*ax.get_xticklabels(), *ax.get_xticklabels(minor=True)] if each.get_text()]
    boxes = [each.get_window_extent() for each in shown if low <= each.get_position()[0] <= high]
    return [each.get_text() for each in shown if low <= each.get_position()[0] <= high], boxes


@pytest.mark.parametrize(
    ("low", "high", "texts"),
    [
        (1e-4, 8e-4, ["0.0001", "0.0002", "0.0003", "0.0005"]),
        (0.3, 9, ["0.5", "1", "2", "5"]),
    ],
)
def test_a_short_axis_has_plain_numbers(low, high, texts):
    found, boxes = labels(low, high)
    assert found == texts
    ends = sorted((box.x0, box.x1) for box in boxes)
    assert all(right < left for (_, right), (left, _) in pairwise(ends))


def test_a_long_axis_has_powers_of_ten():
    found, _ = labels(1e-6, 1e2)
    assert all("10^" in text for text in found)
    assert len(found) >= 3


def test_a_linear_axis_is_left_alone():
    ax = Figure().subplots()
    before = ax.xaxis.get_major_locator()
    label_logarithmic(ax)
    assert ax.xaxis.get_major_locator() is before
    assert np.isfinite(ax.get_xlim()).all()
