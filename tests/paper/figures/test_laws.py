"""The laws' figures: our values, the paper's, the limits."""

import numpy as np
import pytest

from softlube.model.exact import HERTZ_LOAD
from softlube.paper.figures import Case
from softlube.paper.figures.base import WIDE


def test_laws_in_the_tables(drawn, solutions):
    table = drawn("10").tables[0].columns
    ours = [float(solutions[Case(beta)].film_center) for beta in WIDE]
    assert table["(22a) film at the centre"] == pytest.approx(ours)
    assert table["(22a) paper"] == pytest.approx(0.9051 * np.array(WIDE) ** -0.5826)
    load = drawn("12").tables[0].columns["load"]
    assert load[-1] == pytest.approx(HERTZ_LOAD, rel=5e-3)


def test_exponents_and_limits_in_the_tables(drawn):
    """The local exponent is the slope of the column; far out the values come to the Hertz limit."""
    for key, name in (("7", "(20) largest |dp/dr| at the inlet, over p_H(0)"), ("10", "(22a) film at the centre")):
        columns = drawn(key).tables[0].columns
        equation = name.split(" ")[0]
        values, beta = np.asarray(columns[name]), np.asarray(columns["beta"])
        slope = np.gradient(np.log(values), np.log(beta))
        assert np.asarray(columns[f"{equation} local exponent"])[1:-1] == pytest.approx(slope[1:-1], abs=0.02)
        assert values[-1] == pytest.approx(columns[f"{equation} Hertz limit"][-1], rel=0.01)


def test_theory_of_figure_13_is_normalised_with_the_load(drawn, solutions):
    columns = drawn("13").tables[0].columns
    for row, beta in enumerate(WIDE):
        solution = solutions[Case(beta)]
        assert columns["beta by the load (30)"][row] == pytest.approx(solution.beta_load)
        by_load = float(solution.friction_within(2 * (solution.beta_load / beta) ** 0.25)) * beta / solution.beta_load
        # δ differs from |h₀|: lengths go like the root of its unit, forces like its square, β like its square.
        assert columns["friction r <= 2"][row] == pytest.approx(by_load, rel=0.1 if beta < 100 else 0.01)
