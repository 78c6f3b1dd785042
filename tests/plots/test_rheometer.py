"""The picture of a flow curve."""

import numpy as np

from softlube.experiments.flow_curve import FlowCurve
from softlube.experiments.rheometer import fit_liquid
from softlube.plots.rheometer import plot_liquid


def test_data_law_and_residuals_are_drawn(tmp_path):
    rate = np.geomspace(0.01, 1e3, 12)
    scatter = np.exp(0.01 * np.random.default_rng(0).standard_normal(12))
    found = fit_liquid(FlowCurve.from_arrays(rate, 2 * (1 + (0.3 * rate) ** 2) ** -0.25 * scatter))
    figure = plot_liquid(found, tmp_path / "flow.png")
    curve, residuals = figure.axes
    assert np.array_equal(curve.collections[0].get_offsets()[:, 1], found.model.data.viscosity)
    assert len(curve.lines) == 3
    assert residuals.collections[0].get_offsets()[:, 1].max() < 10
    assert (tmp_path / "flow.png").stat().st_size > 10_000
