"""Surfaces in the formats of instruments: the ball that was written, or one clear line."""

from importlib.util import find_spec

import numpy as np
import pytest

from softlube.cli.main import main
from softlube.files import topography
from softlube.files.profiles import read_profile
from softlube.files.topography import is_topography

RADIUS = 4e-3
REST = ["--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "10 mN"]
pytestmark = pytest.mark.filterwarnings("ignore::ImportWarning", "ignore:The Matplotlib:DeprecationWarning")
needs_reader = pytest.mark.skipif(find_spec("SurfaceTopography") is None, reason="the extra topography is not installed")


def ball(r, wear=0.0):
    """Height of a ball over its lowest point [m], its pole worn off by some length [m] with a round border."""
    full = RADIUS - np.sqrt(RADIUS**2 - r**2)
    return full if not wear else wear * np.log1p(np.expm1(full / wear / 2) ** 2)


def test_the_ending_tells_what_reads_a_file(tmp_path):
    for name in ("worn", "worn.csv", "worn.TXT", "worn.xlsx"):
        assert not is_topography(tmp_path / name)
    for name in ("scan.x3p", "scan.SUR", "scan.gwy"):
        assert is_topography(tmp_path / name)


def test_a_missing_extra_and_a_missing_file_are_one_line(tmp_path, monkeypatch, capsys):
    path = tmp_path / "scan.x3p"
    path.write_bytes(b"PK")
    monkeypatch.setattr(topography, "find_spec", lambda name: None)
    assert main(["solve", "--profile", str(path), *REST]) == 2
    printed = capsys.readouterr().err
    assert printed.count("\n") == 1
    assert "profile: scan.x3p: .x3p files need the extra topography: pip install 'softlube[topography]'" in printed
    assert main(["solve", "--profile", str(tmp_path / "none.x3p"), *REST]) == 2
    printed = capsys.readouterr().err
    assert printed.count("\n") == 1
    assert "does not exist" in printed


@needs_reader
@pytest.mark.parametrize("ending", ["x3p", "gwy", "nc"])
@pytest.mark.parametrize("upright", [1, -1])
def test_a_map_is_centred_and_averaged_over_the_angle(ending, upright, tmp_path):
    from SurfaceTopography import Topography

    n, width, centre = 121, 1e-3, (0.53e-3, 0.46e-3)
    x = np.arange(n) * width / n
    r = np.hypot(x[:, None] - centre[0], x - centre[1])
    noise = 5e-9 * np.random.default_rng(1).standard_normal(r.shape)
    scan = Topography((upright * ball(r) + noise) * 1e6, (width * 1e6, width * 1e6), unit="um")
    path = tmp_path / f"scan.{ending}"
    getattr(scan, {"nc": "to_netcdf"}.get(ending, f"to_{ending}"))(str(path))
    radii, z, scatter = read_profile(path)
    assert scatter == pytest.approx(5e-9, rel=0.2)
    assert radii.max() == pytest.approx(0.45e-3, rel=0.02)  # the largest circle on the map
    assert z - z[0] == pytest.approx(ball(radii) - ball(radii[0]), abs=4e-9)


@needs_reader
def test_a_line_scan_has_its_apex_on_the_axis(tmp_path):
    from SurfaceTopography import NonuniformLineScan

    x = np.linspace(0, 1e-3, 300)
    path = tmp_path / "trace.nc"
    NonuniformLineScan(x * 1e3, (3e-6 - ball(x - 0.41e-3, wear=2e-6)) * 1e3, unit="mm").to_netcdf(str(path))
    r, z, scatter = read_profile(path)
    assert scatter == 0
    assert r[0] == pytest.approx(-0.41e-3, abs=1e-6)
    assert z - z.min() == pytest.approx(ball(r, wear=2e-6), abs=4e-8)


@needs_reader
def test_places_without_a_height_are_left_out(tmp_path):
    from SurfaceTopography import Topography

    x = (np.arange(81) - 40) * 1e-3 / 81
    heights = np.ma.masked_invalid(-ball(np.hypot(x[:, None], x)))
    heights[40:50, 10:30] = np.ma.masked
    path = tmp_path / "holes.nc"
    Topography(heights, (1e-3, 1e-3), unit="m").to_netcdf(str(path))
    r, z, scatter = read_profile(path)
    assert scatter < 1e-10
    assert z == pytest.approx(ball(r), abs=1e-8)


@needs_reader
@pytest.mark.parametrize("content", [b"", b"PK\x03\x04 nothing", b"\x00\x01\x02" * 999, b"no numbers"])
def test_an_unreadable_file_is_one_line(content, tmp_path, capsys):
    path = tmp_path / "scan.x3p"
    path.write_bytes(content)
    assert main(["solve", "--profile", str(path), *REST]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    assert "profile: scan.x3p" in printed.err


@needs_reader
@pytest.mark.parametrize("shift", [0.7e-3, 5e-3])
def test_an_apex_beyond_the_scan_is_refused(shift, tmp_path, capsys):
    from SurfaceTopography import NonuniformLineScan

    x = np.linspace(0, 1e-3, 300)
    path = tmp_path / "flank.nc"
    NonuniformLineScan(x, (x + shift) ** 2 / 2 / RADIUS, unit="m").to_netcdf(str(path))
    assert main(["solve", "--profile", str(path), *REST]) == 2
    assert "the apex is not within the measured places" in capsys.readouterr().err


@needs_reader
def test_a_map_without_a_unit_is_refused(tmp_path, capsys):
    from SurfaceTopography import Topography

    x = np.linspace(-0.5, 0.5, 31)
    path = tmp_path / "bare.nc"
    Topography(x[:, None] ** 2 + x**2, (1, 1)).to_netcdf(str(path))
    assert main(["solve", "--profile", str(path), *REST]) == 2
    assert "no unit of length" in capsys.readouterr().err


@needs_reader
def test_a_scan_is_solved(tmp_path, capsys):
    from SurfaceTopography import Topography

    x = np.linspace(-0.7e-3, 0.7e-3, 101)
    path = tmp_path / "ball.x3p"
    Topography(-ball(np.hypot(x[:, None], x)), (1.4e-3, 1.4e-3), unit="m").to_x3p(str(path))
    assert main(["solve", "--profile", str(path), *REST, "--accuracy", "0.01"]) == 0
    printed = capsys.readouterr()
    assert "The profile is a map's mean over the angle, from which its heights differ by" in printed.out
