"""The picture of a test of a viscoelastic solid."""

import numpy as np

from softlube.experiments.moduli import Moduli
from softlube.experiments.substrate_fit import fit_substrate
from softlube.plots.moduli import plot_substrate


def test_data_series_times_and_residuals_are_drawn(tmp_path):
    frequency = np.geomspace(0.01, 1e3, 15)
    modulus = 3e6 + 4e6 * 1j * frequency * 0.1 / (1 + 1j * frequency * 0.1)
    scatter = np.exp(0.01 * np.random.default_rng(0).standard_normal(15))
    data = Moduli.from_arrays(frequency=frequency, storage_modulus=modulus.real * scatter, loss_modulus=modulus.imag)
    found = fit_substrate(data)
    figure = plot_substrate(found, tmp_path / "moduli.png")
    curve, residuals = figure.axes
    assert np.array_equal(curve.collections[0].get_offsets()[:, 1], data.values["storage_modulus"])
    assert len(curve.lines) == 6 + len(found.terms)
    assert curve.lines[-1].get_xdata()[0] == 1 / found.series.times[-1]
    assert len(residuals.collections) == 2
    assert (tmp_path / "moduli.png").stat().st_size > 10_000
