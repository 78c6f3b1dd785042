"""Checks of a fit: the order of residuals, and rows that it has not seen."""

from dataclasses import replace

import numpy as np

from softlube import fit

KNOWN = {"radius": "2 mm", "young_modulus": "3 MPa"}


def noisy(data, seed, noise=0.05):
    return replace(data, friction=data.friction * np.exp(noise * np.random.default_rng(seed).standard_normal(len(data))))


def test_rows_left_out_are_predicted_or_not(clean):
    data = noisy(clean, 1)
    good = fit(data, **KNOWN, hold_out=0.25, seed=4, compare=False)
    assert len(good.hold_out.lines) == 18
    assert len(good.model.data) == 54
    assert not set(good.hold_out.lines) & set(good.model.data.lines.tolist())
    assert good.hold_out.probability > 0.01
    assert good.hold_out.covered > 0.8
    friction = data.friction.copy()
    friction[np.array(good.hold_out.lines) - 1] *= 1.3
    bad = fit(replace(data, friction=friction), **KNOWN, hold_out=0.25, seed=4, compare=False)
    assert bad.hold_out.lines == good.hold_out.lines
    assert bad.hold_out.probability < 1e-6
    assert any("worse than those fitted" in text for text in bad.verdicts)
