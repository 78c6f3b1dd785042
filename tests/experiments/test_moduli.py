"""Tests of viscoelastic solids: what is read, what is refused, and what a series gives at a frequency or time."""

import math

import numpy as np
import pytest

from softlube.errors import InputError
from softlube.experiments.moduli import PROCEDURES, Moduli, read_moduli


@pytest.mark.parametrize(
    ("content", "name", "shear", "where", "columns"),
    [
        ("frequency [Hz], E' [MPa], E'' [MPa]\n1,2,0.1\n", "oscillation", False, 2 * math.pi, [2e6, 1e5]),
        ("frequency [rad/s], E' [MPa], E'' [MPa]\n1,2,0.1\n", "oscillation", False, 1.0, [2e6, 1e5]),
        ("frequency / mHz; G′ / kPa; G″ / kPa\n1;2;0,15\n", "oscillation", True, 2e-3 * math.pi, [2e3, 150.0]),
        ("Angular Frequency (rad/s)\tG' (Pa)\tG\" (Pa)\n3\t2\t1\n", "oscillation", True, 3.0, [2.0, 1.0]),
        ("ω [rad/s],G' [Pa],G'' [Pa],tan δ\n3,2,1,0.5\n", "oscillation", True, 3.0, [2.0, 1.0]),
        (
            "frequency [Hz], tensile storage modulus [Pa], tensile loss modulus [Pa]\n1,2,3\n",
            "oscillation",
            False,
            None,
            [2, 3],
        ),
        ("time [ms], E [MPa]\n5,2\n", "relaxation", False, 5e-3, [2e6]),
        ("time [min], shear relaxation modulus [kPa]\n5,2\n", "relaxation", True, 300.0, [2e3]),
        ("time [s], D [1/MPa], strain\n5,2,1\n", "creep", False, 5.0, [2e-6]),
        ("time [s], J [1/kPa]\n5,2\n", "creep", True, 5.0, [2e-3]),
    ],
)
def test_reading(tmp_path, content, name, shear, where, columns):
    path = tmp_path / "moduli.csv"
    path.write_text(content)
    found = read_moduli(path)
    assert (found.procedure.name, found.procedure.shear) == (name, shear)
    assert found.where[0] == pytest.approx(2 * math.pi if where is None else where)
    assert [found.values[each][0] for each in found.procedure.measured] == pytest.approx(columns)
    assert found.stacked == pytest.approx(columns)


def test_what_is_left_out_is_told(tmp_path):
    path = tmp_path / "moduli.csv"
    path.write_text("# 25 °C\nfrequency [Hz], E' [MPa], E'' [MPa]\n1, 20, 3\n10, 25, 3\n10, 25, 3\n100, NA, 3\n")
    found = read_moduli(path)
    assert found.lines.tolist() == [3, 4]
    assert len(found.notices) == 2
    assert found.headline == "Moduli: oscillation, 2 rows of moduli.csv, 6.283 to 62.83 rad/s"
    assert "25 MPa" in str(found.summary())
    assert list(found.to_dataframe()) == ["frequency [rad/s]", "storage_modulus [Pa]", "loss_modulus [Pa]", "line"]


@pytest.mark.parametrize(
    ("content", "fragment"),
    [
        ("", "line 1: the file is empty"),
        ("frequency [Hz], E' [MPa], E'' [MPa]\n", "there are no rows"),
        ("frequency [Hz], storage modulus [MPa], loss modulus [MPa]\n1,2,3\n", "say by the name whether a modulus is E or G"),
        ("frequency [Hz], E' [MPa]\n1,2\n", "no test: expected frequency with E' and E''"),
        ("frequency [Hz], E' [MPa], E'' [MPa], G' [MPa], G'' [MPa]\n1,2,3,4,5\n", "keep the columns of one test"),
        ("E' [MPa], E'' [MPa]\n1,2\n", "no column frequency"),
        ("frequency, E' [MPa], E'' [MPa]\n1,2,3\n", "line 1: frequency has no unit; expected one in the header"),
        ("frequency [1/s], E' [MPa], E'' [MPa]\n1,2,3\n", "say whether cycles or radians are counted"),
        (
            "ω [Hz], E' [MPa], E'' [MPa]\n1,2,3\n",
            "frequency cannot be in 'Hz'; expected a unit of a frequency such as '1 rad/s'",
        ),
        ("frequency [Hz], E' [mm], E'' [MPa]\n1,2,3\n", "storage_modulus cannot be in 'mm'"),
        ("time [s], E [MPa]\n0,2\n", "line 2: time: expected a positive, finite number"),
        ("time [s], J [MPa]\n1,2\n", "creep_compliance cannot be in 'MPa'"),
        ("time [s], E [MPa]\n1,2,3\n", "line 2: 3 cells under 2 columns"),
    ],
)
def test_refusals(tmp_path, content, fragment):
    path = tmp_path / "moduli.csv"
    path.write_text(content)
    with pytest.raises(InputError) as error:
        read_moduli(path)
    assert fragment in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"frequency": [1, 2], "storage_modulus": [1, 2]},
        {"frequency": [1, 2], "storage_modulus": [1, 2], "loss_modulus": [1]},
        {"time": [1, 2], "relaxation_modulus": [1, -2]},
        {"time": [1, 2], "relaxation_modulus": [1, 2], "creep_compliance": [1, 2]},
    ],
)
def test_arrays_that_are_no_test(given):
    with pytest.raises(InputError):
        Moduli.from_arrays(**given)


@pytest.mark.parametrize("procedure", PROCEDURES[:3], ids=lambda each: each.name)
def test_kernels_against_closed_forms_and_their_slopes_against_differences(procedure):
    where, times = np.geomspace(0.01, 100, 9), np.array([0.3, 4.0])
    matrix, slopes = procedure.kernels(where, times)
    if procedure.name == "oscillation":
        response = 1j * np.multiply.outer(where, times) / (1 + 1j * np.multiply.outer(where, times))
        expected = np.vstack((response.real, response.imag))
    else:
        expected = np.exp(-where[:, None] / times)
        expected = expected if procedure.name == "relaxation" else 1 - expected
    np.testing.assert_allclose(matrix[:, 1:], expected, rtol=1e-12)
    assert matrix[:9, 0] == pytest.approx(1)
    assert not matrix[9:, 0].any()
    step = 1e-5
    ahead, behind = (procedure.kernels(where, times * math.exp(each))[0][:, 1:] for each in (step, -step))
    np.testing.assert_allclose(slopes, (ahead - behind) / (2 * step), rtol=1e-6, atol=1e-9)
