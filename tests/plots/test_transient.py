"""Pictures of squeeze films and of starts of sliding show the numbers, and are written where they should be."""

import numpy as np
import pytest

from softlube.errors import InputError
from softlube.plots.transient import PROFILES, picture


@pytest.mark.parametrize("name", ["squeezed", "slid", "fall", "started"])
def test_every_film_in_time_has_a_picture(request, name, tmp_path):
    result = request.getfixturevalue(name)
    figure = result.plot(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    film, pressure, left, right, twin = figure.axes
    assert 5 <= len(film.lines) == len(pressure.lines) <= PROFILES
    assert [ax.get_title(loc="left") for ax in figure.axes[:4]] == ["(a)", "(b)", "(c)", "(d)"]
    unit = {"squeezed": "", "slid": "", "fall": " [µm]", "started": " [µm]"}[name]
    assert film.get_ylabel() == f"film $u${unit}"
    assert left.get_yscale() == "log"
    assert twin.get_ylabel().startswith("height")
    assert ("friction" in right.get_ylabel()) == (name in ("slid", "started"))


def test_lines_are_the_numbers(squeezed, started):
    figure = picture(squeezed)
    film, pressure, left, right, _ = figure.axes
    assert film.lines[-1].get_ydata()[0] == pytest.approx(squeezed.final["film_center"], rel=1e-3)
    assert film.lines[-1].get_ydata().min() == pytest.approx(squeezed.final["film_min"], rel=1e-3)
    assert pressure.lines[-1].get_ydata()[0] == pytest.approx(squeezed.final["pressure_center"], rel=1e-3)
    assert right.lines[0].get_ydata()[-1] == squeezed.final["pressure_center"]
    assert left.lines[2].get_xdata()[0] == squeezed.dimple_time
    figure = picture(started)
    assert figure.axes[0].lines[-1].get_ydata().min() == pytest.approx(float(started.final["film_min"]) * 1e6, rel=0.1)
    x = figure.axes[0].lines[-1].get_xdata()
    assert x[0] == -x[-1]
    friction = figure.axes[3].lines[0].get_ydata()
    assert friction / friction[-1] == pytest.approx(started.histories["friction_total"] / started.final["friction_total"])


def test_a_film_that_slows_down_has_a_logarithmic_time(squeezed, slid):
    assert [ax.get_xscale() for ax in picture(squeezed).axes[2:4]] == ["log", "log"]
    assert np.all(picture(squeezed).axes[2].lines[0].get_xdata() > 0)
    assert picture(slid).axes[2].get_xscale() == "linear"


def test_refused(squeezed, tmp_path):
    with pytest.raises(InputError, match="plot"):
        squeezed.plot(tmp_path / "a.bmp")
    with pytest.raises(InputError, match="plot: the folder"):
        picture(squeezed, tmp_path / "none" / "a.png")
