"""Flow curves: what is read, what is refused, and the laws through them against closed forms."""

import numpy as np
import pytest

from softlube.errors import InputError
from softlube.experiments.flow_curve import CANDIDATES, FlowCurve, FlowModel, read_flow_curve

BY_WORDS = {each.words: each for each in CANDIDATES}
RATES = np.geomspace(1e-3, 1e6, 50)


def test_reading(tmp_path):
    path = tmp_path / "flow.csv"
    path.write_text("shear rate [1/s], viscosity [mPa s], temperature\n1, 20, 37\n10, 15, 37\n10, 15, 37\n100, NA, 37\n")
    found = read_flow_curve(path)
    assert found.shear_rate.tolist() == [1, 10]
    assert found.viscosity == pytest.approx([0.02, 0.015])
    assert found.lines.tolist() == [2, 3]
    assert len(found.notices) == 2
    assert found.headline == "FlowCurve: 2 rows of flow.csv, 1 to 10 1/s"
    assert "0.02" not in str(found.summary())
    assert "20 mPa s" in str(found.summary())
    assert list(found.to_dataframe()) == ["shear_rate [1/s]", "viscosity [Pa s]", "line"]


def test_a_shear_stress_gives_the_viscosity(tmp_path):
    path = tmp_path / "flow.csv"
    path.write_text("shear_rate (s^-1);shear stress (kPa)\n0,5;1,5\n2;3\n")
    assert read_flow_curve(path).viscosity == pytest.approx([3000, 1500])


@pytest.mark.parametrize(
    ("content", "fragment"),
    [
        (
            "shear_rate, viscosity [Pa s]\n1,2\n",
            "line 1: shear_rate has no unit; expected one in the header, as in 'shear_rate [1/s]'",
        ),
        ("shear_rate [1/s], viscosity [Pa]\n1,2\n", "viscosity cannot be in 'Pa'"),
        ("shear_rate [1/s], viscosity [Pa s], shear_stress [Pa]\n1,2,3\n", "are both there"),
        ("shear_rate [1/s], viscosity [Pa s]\n0,2\n", "shear_rate: expected a positive"),
        ("rate [1/s], viscosity [Pa s]\n1,2\n", "no column shear_rate"),
    ],
)
def test_refusals(tmp_path, content, fragment):
    path = tmp_path / "flow.csv"
    path.write_text(content)
    with pytest.raises(InputError) as error:
        read_flow_curve(path)
    assert fragment in str(error.value)


@pytest.mark.parametrize(
    ("rate", "viscosity"), [([1, 2], [1]), ([1, -2], [1, 1]), ([1, 2], [1, np.nan]), ("a", [1]), ([[1, 2]], [[1, 1]])]
)
def test_arrays_that_are_no_flow_curve(rate, viscosity):
    with pytest.raises(InputError):
        FlowCurve.from_arrays(rate, viscosity)


VALUES = {"viscosity": 2.0, "infinite_viscosity": 0.01, "relaxation_time": 0.3, "index": 0.4, "transition": 0.7}


@pytest.mark.parametrize(
    ("words", "closed"),
    [
        ("newtonian", lambda g: 2 + 0 * g),
        ("carreau", lambda g: 2 * (1 + (0.3 * g) ** 2) ** -0.3),
        ("carreau with a second plateau", lambda g: 0.01 + 1.99 * (1 + (0.3 * g) ** 2) ** -0.3),
        ("cross", lambda g: 2 / (1 + (0.3 * g) ** 0.6)),
        ("cross with a second plateau", lambda g: 0.01 + 1.99 / (1 + (0.3 * g) ** 0.6)),
        ("carreau-yasuda with a second plateau", lambda g: 0.01 + 1.99 * (1 + (0.3 * g) ** 0.7) ** (-0.6 / 0.7)),
    ],
)
def test_laws_against_their_formulas(words, closed):
    candidate = BY_WORDS[words]
    values = {name: VALUES[name] for name in candidate.names}
    assert candidate.viscosity(RATES, values) == pytest.approx(closed(RATES), rel=1e-12)


def test_power_law():
    values = {"consistency": 3.0, "index": 0.6}
    assert BY_WORDS["power-law"].viscosity(RATES, values) == pytest.approx(3 * RATES**-0.4)


def test_starts_lie_within_the_bounds():
    for candidate in CANDIDATES:
        model = FlowModel(FlowCurve.from_arrays(RATES, 2 * (1 + RATES) ** -0.5), candidate, {}, candidate.names)
        low, high = model.bounds()
        for start in model.starts():
            assert np.all((low <= model.vector(start)) & (model.vector(start) <= high))
            assert model.values(model.vector(start)) == pytest.approx(start)
