"""Pictures of fits and Stribeck curves: what is drawn is the data, on labelled axes."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

import softlube
from softlube.experiments.friction_model import make_model
from softlube.experiments.measurements import Measurements
from softlube.plots.experiments import COLOURS, MOST_DOTS, _some, plot_fit, plot_stribeck


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
    first, second = friction.get_lines()  # λ = 2 is no full film: the curve is there in grey only
    assert {line.get_color() for line in (first, second)} == {"0.55"}
    assert first.get_marker() != second.get_marker()
    assert first.get_xdata() == pytest.approx(table[column][:5])
    assert first.get_ydata() == pytest.approx(0.01 * table["entrainment_speed [m/s]"][:5] ** 0.5)
    assert [text.get_text() for text in friction.get_legend().get_texts()] == ["50 mN", "100 mN"]
    assert [text.get_text() for text in film.get_legend().get_texts()][:2] == ["centre", "minimum"]
    centre, least = film.get_lines()[:2]
    assert centre.get_ydata() == pytest.approx(np.full(5, 200))
    assert least.get_ydata() == pytest.approx(np.full(5, 100))
    assert (centre.get_linestyle(), least.get_linestyle()) == ("-", "--")
    lambda_3 = next(line for line in film.get_lines() if line.get_label() == "λ = 3: full film above")
    assert lambda_3.get_ydata()[0] == pytest.approx(150)  # three times the roughness, 100 nm over λ = 2


def test_parts_of_the_friction_are_drawn_where_the_substrate_remembers(table):
    viscous = 0.8 * table["friction_coefficient"] * table["load [N]"]
    table = table.assign(**{"friction_viscous [N]": viscous, "friction_hysteresis [N]": viscous / 4})
    friction, _ = plot_stribeck(table).axes
    assert [text.get_text() for text in friction.get_legend().get_texts()] == ["50 mN", "100 mN", "viscous", "hysteresis"]
    whole, by_liquid, by_substrate = friction.get_lines()[:3]
    assert [line.get_linestyle() for line in (whole, by_liquid, by_substrate)] == ["-", "--", ":"]
    assert by_liquid.get_ydata() + by_substrate.get_ydata() == pytest.approx(whole.get_ydata())


def test_regimes_have_their_greys(table):
    table = table[table["load [N]"] < 0.07].assign(lambda_ratio=[0.5, 0.9, 2.0, 4.0, 8.0])
    table["film_min [m]"] = 5e-8 * table["lambda_ratio"]
    friction, film = plot_stribeck(table).axes
    drawn = {line.get_color(): np.flatnonzero(np.isfinite(line.get_ydata())).tolist() for line in friction.get_lines()}
    assert drawn == {"0.75": [0, 1, 2], "0.55": [2, 3], COLOURS[0]: [3, 4]}
    labels = [text.get_text() for text in film.get_legend().get_texts()]
    assert labels == ["centre", "minimum", "λ = 3: full film above", "λ < 1: the surfaces touch"]
    (band,) = [patch for patch in film.patches if patch.get_height() > 0]
    assert band.get_y() + band.get_height() == pytest.approx(50)


def test_a_picture_of_another_kind_is_refused(table, tmp_path):
    with pytest.raises(softlube.InputError, match="plot: expected a file ending in"):
        plot_stribeck(table, tmp_path / "s.gif")
    assert list(tmp_path.iterdir()) == []
