"""Profiles of indenters from CSV files, and files that are none: one clear line, exit 2."""

import numpy as np
import pytest

from softlube.cli.main import main
from softlube.files.profiles import read_profile

GOOD = [f"{r:.3f}; {r**2 / 4 * 1e3:.4f}" for r in np.linspace(0, 1, 30)]
HEADER = "r [mm]; z [um]"
REST = ["--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "100 mN"]


def rows(*lines):
    return "\n".join([HEADER, *lines])


MALFORMED = {
    "empty": ("", "the file is empty"),
    "header only": (HEADER, "line 1: there are no rows below the header"),
    "no r": ("\n".join(["x [mm]; z [um]", *GOOD]), "no column r"),
    "no z": ("\n".join(["r [mm]; h [um]", *GOOD]), "no column z"),
    "no unit": ("\n".join(["r; z [um]", *GOOD]), "r has no unit"),
    "wrong unit": ("\n".join(["r [mm]; z [mN]", *GOOD]), "z cannot be in 'mN'"),
    "unknown unit": ("\n".join(["r [mm]; z [furlong]", *GOOD]), "z cannot be in 'furlong'"),
    "two columns of r": ("\n".join(["r [mm]; r [mm]; z [um]", *(f"0; {each}" for each in GOOD)]), "two columns are called r"),
    "text in a cell": (rows(*GOOD, "1.1; high"), "line 32: z: 'high'"),
    "a cell is missing": (rows(*GOOD[:9], "0.4; ", *GOOD[9:]), "line 11: z is missing"),
    "a row is short": (rows(*GOOD[:9], "0.4", *GOOD[9:]), "line 11: 1 cells under 2 columns"),
    "an infinite height": (rows(*GOOD, "1.1; inf"), "line 32"),
    "units in the cells": (rows(*GOOD, "1.1 mm; 300"), "line 32: r: '1.1 mm'"),
    "points and commas": (rows(*GOOD, "1,1; 300"), "is the decimal sign a comma or a point"),
    "too few places": (rows(*GOOD[:8]), "expected at least 12 different radii, got 8"),
    "one radius": (rows(*["0.1; 1"] * 30), "expected at least 12 different radii, got 1"),
    "not from the axis": (rows(*GOOD[12:]), "the innermost radius is 0.000414 m"),
    "upside down": (rows(*(each.replace("; ", "; -") for each in GOOD)), "does not rise from the axis"),
    "flat": (rows(*(each.partition(";")[0] + "; 0" for each in GOOD)), "does not rise from the axis"),
    "a ring": (
        rows(*(f"{r:.3f}; {(r**2 - 0.2) ** 2 * 1e3:.4f}" for r in np.linspace(0, 1, 40))),
        "the lowest point is 4.01e-05 m below the axis",
    ),
    "not text": ("\0\1\2", "not a text file"),
}


def test_twenty_at_least():
    assert len(MALFORMED) >= 20


@pytest.mark.parametrize("case", MALFORMED)
def test_a_malformed_file_is_one_line(case, tmp_path, capsys):
    content, message = MALFORMED[case]
    path = tmp_path / "worn.csv"
    path.write_text(content, encoding="utf-8")
    assert main(["solve", "--profile", str(path), *REST]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    assert "profile" in printed.err
    assert message in printed.err


def test_a_file_that_is_not_there(tmp_path, capsys):
    assert main(["solve", "--profile", str(tmp_path / "none.csv"), *REST]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_radii_of_both_signs_and_other_units(tmp_path):
    path = tmp_path / "trace.csv"
    path.write_text("z (nm), r / um\n10, -2\n0, 0\n12, 3\n")
    r, z, scatter = read_profile(path)
    assert scatter == 0
    assert r == pytest.approx([-2e-6, 0, 3e-6])
    assert z == pytest.approx([1e-8, 0, 1.2e-8])
