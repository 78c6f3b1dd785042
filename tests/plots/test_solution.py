"""Pictures: the right data on labelled axes, in every format."""

from dataclasses import replace

import numpy as np
import pytest

import softlube
from softlube.plots.solution import plot


def test_profiles_show_the_solution(solution):
    figure = plot(solution)
    along_x = figure.axes[2]
    x, film = along_x.lines[0].get_data()
    k = int(np.argmin(np.abs(x)))
    assert film[k] == pytest.approx(solution.film_center, rel=1e-6)
    assert np.min(film) == pytest.approx(solution.film_outlet_min, rel=2e-3)
    # the outlet, where the film is thinner, is on the left
    assert x[np.argmin(film)] < 0


def test_the_film_is_drawn_where_its_minimum_is_not_given(solution):
    missing = dict.fromkeys(("film_min", "film_min_radius", "film_min_angle_deg"), softlube.Quantity(np.nan))
    without = replace(solution, quantities={**solution.quantities, **missing})
    drawn, wanted = (plot(each).axes[0].collections[0].levels for each in (without, solution))
    assert drawn[0] <= solution.fields.film.min()
    assert drawn[-1] == pytest.approx(wanted[-1], rel=0.1)


def test_axes_carry_units(physical, solution):
    labels = [axis.get_ylabel() + axis.get_xlabel() for axis in plot(physical).axes]
    assert any("µm" in label for label in labels)
    assert any("nm" in label for label in labels)
    assert any("kPa" in label for label in labels)
    labels = [axis.get_ylabel() + axis.get_xlabel() for axis in plot(solution).axes]
    assert any("h_0" in label for label in labels)


@pytest.mark.parametrize(("ending", "magic"), [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")])
def test_formats(physical, tmp_path, ending, magic):
    path = tmp_path / f"contact.{ending}"
    physical.plot(path)
    assert path.read_bytes().startswith(magic)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


def test_unknown_format_is_refused(solution, tmp_path):
    with pytest.raises(softlube.InputError, match=r"plot: expected a file ending in"):
        solution.plot(tmp_path / "a.xyz")


def test_marks_are_explained(physical, solution):
    film, pressure = plot(physical).axes[:2]
    assert film.get_title(loc="right") == "dashed: dry contact; +: minimum film"
    assert pressure.get_title(loc="right") == "dashed: dry contact"
    for ax in (film, pressure):
        assert {"sphere slides →", "inlet"} <= {text.get_text() for text in ax.texts}


def test_the_dry_contact_of_a_substrate_that_remembers_is_the_one_whose_radius_is_printed():
    contact = softlube.Contact(radius="2 mm", young_modulus="3 MPa", prony="9 MPa @ 10 ms", viscosity="1 Pa s", speed="10 mm/s",
                               load="100 mN")  # fmt: skip
    solution = contact.solve(accuracy=0.05)
    film = plot(solution).axes[0]
    assert film.get_title(loc="right") == "dashed: dry contact at rest; +: minimum film"
    (circle,) = [line for line in film.get_lines() if line.get_linestyle() == "--"]
    assert np.max(circle.get_xdata()) == pytest.approx(solution.dimensional["contact_radius"] * 1e6, rel=1e-3)


def test_the_maps_hold_the_dry_contact_of_any_indenter():
    punch = softlube.RoundedPunch(face_radius="0.5 mm", edge_radius="2 mm")
    contact = softlube.Contact(indenter=punch, young_modulus="0.3 MPa", viscosity="1 Pa s", speed="1 mm/s", load="100 mN")
    solution = contact.solve(accuracy=0.05)
    film = plot(solution).axes[0]
    (circle,) = [line for line in film.get_lines() if line.get_linestyle() == "--"]
    assert np.max(circle.get_xdata()) == pytest.approx(solution.dimensional["contact_radius"] * 1e6, rel=1e-3)
    assert film.get_xlim()[1] == pytest.approx(1.4 * np.max(circle.get_xdata()), rel=1e-3)
