"""Pictures of the flow: the data on the axes, and their units."""

import numpy as np
import pytest

import softlube
from softlube import flow
from softlube.plots.flow import picture


def test_panels_show_the_flow(solution):
    figure, tables = picture(solution)
    assert list(tables) == ["plane", "section", "shear-x", "shear-y"]
    plane = tables["plane"]
    x, y = plane["x [sqrt(R|h0|)]"], plane["y [sqrt(R|h0|)]"]
    k = int(np.argmin(np.abs(x - 0.4) + np.abs(y - 0.2)))
    r, theta = np.hypot(x[k], y[k]), np.arctan2(y[k], x[k])
    v_r, v_t = flow.mean_velocity(solution, r, theta, frame="sphere")
    assert plane["v_x [v]"][k] == pytest.approx(v_r * np.cos(theta) - v_t * np.sin(theta))
    shear = tables["shear-x"]
    place = np.argmin(np.abs(shear["x [sqrt(R|h0|)]"]))
    # at the centre the film is all but flat: both walls are sheared by v/u
    both = [shear[f"tau_zx on the {wall} [eta v/|h0|]"][place] * solution.film_center for wall in ("sphere", "substrate")]
    assert both == pytest.approx([1, 1], abs=0.02)
    labels = [ax.get_ylabel() + ax.get_xlabel() for ax in figure.axes]
    assert all("Pa" not in label for label in labels)


def test_a_level_s_plane(solution):
    """On the substrate every line is straight and every speed 1, relative to the sphere."""
    _, tables = picture(solution, level=0.0)
    assert tables["plane"]["v_x [v]"] == pytest.approx(-1)
    assert tables["plane"]["v_y [v]"] == pytest.approx(0, abs=1e-12)


def test_units_of_a_physical_contact(physical):
    figure, _ = picture(physical)
    labels = [ax.get_ylabel() + ax.get_xlabel() for ax in figure.axes]
    assert any("µm" in label for label in labels)
    assert any("[Pa]" in label for label in labels)
    # the contact's edge, at 334 µm
    low, high = figure.axes[0].get_xlim()
    assert high == pytest.approx(1.6 * 334.1, rel=0.01)
    assert low == -high


def test_a_level_outside_the_film_is_refused(solution):
    with pytest.raises(softlube.InputError, match="level: expected a share of the film"):
        picture(solution, level=-0.1)


def test_a_substrate_that_remembers_has_maps_of_what_is_lost():
    contact = softlube.Contact(
        radius="2 mm", young_modulus="3 MPa", prony=[("6 MPa", "0.2 s")], viscosity="2 Pa s", speed="1 mm/s", load="100 mN"
    )
    solution = contact.solve(accuracy=3e-3)
    figure, tables = picture(solution)
    assert list(tables)[-2:] == ["film-loss", "substrate-work"]
    work = tables["substrate-work"]
    x, _, density = work.values()
    # On an even grid, the sum is the friction of the substrate to the width of its cells.
    cell = (x[1] - x[0]) ** 2
    assert np.sum(density) * cell == pytest.approx(solution.friction_hysteresis, rel=0.02)
    labels = [ax.get_xlabel() + ax.get_title() for ax in figure.axes]
    assert sum("[W/m²]" in label for label in labels) == 2
