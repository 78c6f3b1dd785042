"""The velocity's figures: averages on rings, flow and shear in the gap."""

import numpy as np
import pytest


def test_velocities_on_rings(drawn):
    columns = {name: np.asarray(values) for name, values in drawn("11").tables[0].columns.items()}
    theta = np.radians(columns["theta [deg]"])
    for radius in ("0.5", "1"):
        radial, swirl = (columns[f"v_{name} at r = {radius} [v]"] for name in ("r", "theta"))
        assert radial == pytest.approx(radial[::-1], abs=1e-9)  # the contact is even about its axis of sliding
        assert swirl == pytest.approx(-swirl[::-1], abs=1e-7)
    # Half the sphere's speed where the gap is even: at r = 0.5 the mean flow is (1/2)(cos θ, −sin θ) within a few per cent.
    assert columns["v_r at r = 0.5 [v]"] == pytest.approx(np.cos(theta) / 2, abs=0.05)
    assert columns["v_theta at r = 0.5 [v]"] == pytest.approx(-np.sin(theta) / 2, abs=0.05)


@pytest.mark.slow
def test_the_sphere_carries_the_shear_of_couette_in_the_middle(drawn, solution):
    """Where the pressure has no gradient both walls carry ηv/u."""
    shear = {name: np.asarray(values) for name, values in drawn("flow").tables[2].columns.items()}
    centre = np.argmin(np.abs(shear["x [sqrt(R|h0|)]"]))
    mean = (shear["tau_zx on the sphere [eta v/|h0|]"] + shear["tau_zx on the substrate [eta v/|h0|]"])[centre] / 2
    assert mean == pytest.approx(1 / float(solution.film_center), rel=2e-3)


def test_no_liquid_moves_with_the_broken_film(drawn):
    section = {name: np.asarray(values) for name, values in drawn("flow").tables[1].columns.items()}
    wall = section["level"] == 1.0
    assert section["v_x [v]"][wall & np.isfinite(section["v_x [v]"])] == pytest.approx(0, abs=1e-12)  # at rest with the sphere
    base = (section["level"] == 0.0) & np.isfinite(section["v_x [v]"])
    assert section["v_x [v]"][base] == pytest.approx(-1, abs=1e-12)  # the substrate passes with −v
