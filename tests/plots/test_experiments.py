"""Pictures of fits and Stribeck curves: what is drawn is the data, on labelled axes."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

import softlube
from softlube.experiments.friction_model import make_model
from softlube.experiments.measurements import Measurements
from softlube.plots.experiments import MOST_DOTS, _some, plot_fit, plot_stribeck


@pytest.fixture(scope="module")
def found():
    """Friction on Eq. (28) with a little noise, fitted."""
    load, speed = (grid.ravel() for grid in np.meshgrid([0.05, 0.1, 0.2], np.geomspace(1e-4, 1e-3, 5)))
    data = Measurements.from_arrays(load, speed, np.ones(load.size))
    values = {"viscosity": 2.0, "young_modulus": 3e6, "friction_offset": 0.0}
    model = make_model(data, radius="2 mm", young_modulus="3 MPa", viscosity=2.0)
    friction = model.unit(values) * 4.806 * model.beta(values) ** -0.4398
    noise = np.exp(0.03 * np.random.default_rng(0).normal(size=load.size))
    return softlube.fit(replace(data, friction=friction * noise), radius="2 mm", young_modulus="3 MPa", compare=False)


def test_a_fit_is_drawn_with_its_data(found, tmp_path):
    figure = plot_fit(found, tmp_path / "fit.pdf")
    assert (tmp_path / "fit.pdf").read_bytes().startswith(b"%PDF")
    collapse, residuals = figure.axes[:2]
    drawn = collapse.collections[0].get_offsets()
    assert np.asarray(drawn) == pytest.approx(np.column_stack(found.points))
    curve, paper = collapse.get_lines()
    beta, friction = curve.get_data()
    assert friction == pytest.approx(found.model.family.friction(0.1, beta))
    beta, friction = paper.get_data()
    assert friction == pytest.approx(4.806 * beta**-0.4398)
    shown = np.asarray(residuals.collections[0].get_offsets())
    assert shown[:, 1] == pytest.approx(100 * found.residuals)
    assert "[%]" in residuals.get_ylabel()
    assert "viscosity" in figure.get_suptitle()


def test_the_name_of_a_file_is_no_formula(found, tmp_path):
    model = replace(found.model, data=replace(found.model.data, source="$\\frac{a$ \x1b.csv"))
    figure = plot_fit(replace(found, model=model), tmp_path / "fit.png")
    assert figure.get_suptitle().startswith("$\\frac{a$ \\x1b.csv: ")


def test_large_data_are_thinned():
    assert len(range(MOST_DOTS)[_some(MOST_DOTS)]) == MOST_DOTS
    assert len(range(10 * MOST_DOTS)[_some(10 * MOST_DOTS)]) == MOST_DOTS


@pytest.fixture
def table():
    speed = np.geomspace(1e-4, 1e-2, 5)
    rows = [
        {
            "load [N]": load,
            "entrainment_speed [m/s]": v,
            "hersey": 10 * v / load,
            "friction_coefficient": -0.01 * v**0.5,
            "film_center [m]": 2e-7,
            "film_min [m]": 1e-7,
            "lambda_ratio": 2.0,
        }
        for load in (0.05, 0.1)
        for v in speed
    ]
    return pd.DataFrame(rows)


@pytest.mark.parametrize(("against", "column"), [("hersey", "hersey"), ("speed", "entrainment_speed [m/s]")])
def test_a_stribeck_curve(table, tmp_path, against, column):
    figure = plot_stribeck(table, tmp_path / "s.png", against=against)
    assert (tmp_path / "s.png").read_bytes().startswith(b"\x89PNG")
    friction, film = figure.axes
    first, second = (line for line in friction.get_lines() if line.get_color() != "0.75")
    assert first.get_xdata() == pytest.approx(table[column][:5])
    assert np.isnan(first.get_ydata()).all()  # λ = 2 is no full film: the curve is there in grey only
    grey = next(line for line in friction.get_lines() if line.get_color() == "0.75")
    assert grey.get_ydata() == pytest.approx(0.01 * table["entrainment_speed [m/s]"][:5] ** 0.5)
    assert (first.get_label(), second.get_label()) == ("50 mN", "100 mN")
    centre, _, least, _, lambda_3 = film.get_lines()[:5]
    assert centre.get_ydata() == pytest.approx(np.full(5, 200))
    assert least.get_ydata() == pytest.approx(np.full(5, 100))
    assert lambda_3.get_ydata()[0] == pytest.approx(150)  # three times the roughness, 100 nm over λ = 2


def test_a_picture_of_another_kind_is_refused(table, tmp_path):
    with pytest.raises(softlube.InputError, match="plot: expected a file ending in"):
        plot_stribeck(table, tmp_path / "s.gif")
    assert list(tmp_path.iterdir()) == []
