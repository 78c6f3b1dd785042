"""Axes of a plan: lists, ranges, columns of files, and how they are combined."""

import math

import numpy as np
import pytest

import softlube
from softlube.sweeps.axes import Axis, combined, read_axes
from softlube.sweeps.plan import make_plan

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s", "load": "100 mN"}


def speeds(plan):
    return [case.inputs["speed"] for case in plan.cases]


def test_lists_ranges_and_the_product_last_axis_fastest():
    log = {"from": "25 um/s", "to": "1 mm/s", "count": 5}
    plan = make_plan({"load": ["18.6 mN", "238,1 mN"], **{name: BALL[name] for name in BALL if name != "load"}, "speed": log})
    assert len(plan.cases) == 10
    assert speeds(plan)[:5] == pytest.approx([2.5e-5 * 40 ** (i / 4) for i in range(5)])
    assert [case.inputs["load"] for case in plan.cases] == pytest.approx([0.0186] * 5 + [0.2381] * 5)
    linear = make_plan(BALL | {"speed": log | {"spacing": "linear"}})
    assert speeds(linear)[2] == pytest.approx((2.5e-5 + 1e-3) / 2)


@pytest.mark.parametrize(
    "change",
    [
        {"load": ["20 mN", 50]},
        {"load": [0.02, "50 mN"]},
        {"speed": {"from": "25 um/s", "to": 1, "count": 5}},
    ],
)
def test_a_number_without_unit_beside_one_with_a_unit_is_refused(change):
    with pytest.raises(softlube.InputError, match="has no unit, and others have; give all of them a unit, or none"):
        make_plan(BALL | change)


def test_numbers_alone_are_si_and_plain_numbers_have_no_unit():
    plan = make_plan(BALL | {"load": [0.02, np.float32(0.5), 1], "poisson_ratio": [0.5, "0,5"]})
    assert [case.inputs["load"] for case in plan.cases[::2]] == [0.02, 0.5, 1.0]
    assert {case.inputs["poisson_ratio"] for case in plan.cases} == {0.5}
    for wrong in (True, [0.02, True], np.array([True])):
        with pytest.raises(softlube.InputError, match="load: cannot read True"):
            make_plan(BALL | {"load": wrong})


def test_zipped():
    plan = make_plan(BALL | {"load": [0.1, 0.2], "speed": ["1 mm/s", "2 mm/s"]}, combine="zip")
    assert [(case.inputs["load"], case.inputs["speed"]) for case in plan.cases] == [(0.1, 1e-3), (0.2, 2e-3)]
    with pytest.raises(softlube.InputError, match="load: has 2 values and another parameter 3"):
        make_plan(BALL | {"load": [0.1, 0.2], "speed": [1.0, 2.0, 3.0]}, combine="zip")


def test_columns_of_one_file_go_together(tmp_path):
    (tmp_path / "cases.csv").write_text("N [mN]; speed [mm/s]\n50; 0,1\n100; 0,2\n")
    columns = {"load": {"csv": "cases.csv", "column": "N"}, "speed": {"csv": "cases.csv"}}
    plan = make_plan(BALL | columns | {"viscosity": [1.0, 2.0]}, folder=tmp_path)
    assert [(c.inputs["viscosity"], c.inputs["load"], c.inputs["speed"]) for c in plan.cases] == [
        pytest.approx(row) for row in [(1, 0.05, 1e-4), (1, 0.1, 2e-4), (2, 0.05, 1e-4), (2, 0.1, 2e-4)]
    ]
    assert plan.sources == (tmp_path / "cases.csv",)


def test_ranges_end_where_they_should():
    values = speeds(make_plan(BALL | {"speed": {"from": 3e-5, "to": 7e-4, "count": 7}}))
    assert (values[0], values[-1]) == (3e-5, 7e-4)
    assert math.log(values[1] / values[0]) == pytest.approx(math.log(values[6] / values[5]))


def test_columns_go_together_and_with_the_other_axes(tmp_path):
    axes = [Axis([{"load": 1.0, "speed": 0.1}, {"load": 2.0, "speed": 0.2}], ["a, line 2", "a, line 3"])]
    axes.append(Axis([{"radius": 3.0}, {"radius": 4.0}, {"radius": 5.0}], ["", "", ""]))
    rows = list(combined(axes, "product"))
    assert len(rows) == 6
    assert rows[0] == ({"load": 1.0, "speed": 0.1, "radius": 3.0}, "a, line 2")
    assert rows[-1] == ({"load": 2.0, "speed": 0.2, "radius": 5.0}, "a, line 3")


def test_a_single_value_goes_with_every_row():
    axes = [Axis([{"radius": 1.0}], [""]), Axis([{"load": 1.0}, {"load": 2.0}], ["", ""])]
    assert [row for row, _ in combined(axes, "zip")] == [{"radius": 1.0, "load": 1.0}, {"radius": 1.0, "load": 2.0}]


def test_ranges_through_zero_are_linear(tmp_path):
    given = {"from": "-1 um", "to": "1 um", "count": 3}
    with pytest.raises(softlube.InputError, match=r'indentation: from, to: expected values of one sign, or spacing = "linear"'):
        read_axes({"indentation": given}, tmp_path)
    ((axis,), files, notices) = read_axes({"indentation": given | {"spacing": "linear"}}, tmp_path)
    assert [row["indentation"] for row in axis.rows] == pytest.approx([-1e-6, 0, 1e-6], abs=1e-20)
    assert (files, notices) == ((), ())


def test_texts_are_no_columns(tmp_path):
    (tmp_path / "a.csv").write_text("base\nbonded\n")
    with pytest.raises(softlube.InputError, match="base: expected 'base' in the plan, not in a column"):
        read_axes({"base": {"csv": "a.csv"}}, tmp_path)


def test_numbers_of_numpy_are_numbers(tmp_path):
    ((axis,), _, _) = read_axes({"beta": np.array([1, 10])}, tmp_path)
    assert [row["beta"] for row in axis.rows] == [1.0, 10.0]
