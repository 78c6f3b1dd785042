"""softlube flow: pictures, numbers, refusals."""

import pytest

from softlube.cli.main import main

BALL = ["--radius", "2 mm", "--young-modulus", "3 MPa", "--viscosity", "2 Pa s", "--speed", "0.1 mm/s", "--load", "100 mN"]


def test_flow_of_a_dimensionless_contact(tmp_path, capsys):
    path = tmp_path / "flow.png"
    assert main(["flow", "--beta", "100", "--plot", str(path), "--level", "0.25"]) == 0
    out = capsys.readouterr().out
    assert "β = 100" in out
    assert "v |h0| a" in out
    assert path.read_bytes().startswith(b"\x89PNG")


def test_flow_of_a_solved_contact_in_si(tmp_path, capsys, physical):
    stored, path = tmp_path / "a.nc", tmp_path / "flow.pdf"
    physical.save(stored)
    assert main(["flow", "--solution", str(stored), "--plot", str(path)]) == 0
    out = capsys.readouterr().out
    assert "Pa on the sphere" in out
    assert "m³/s" in out
    # liquid through the contact, about the centre film times its width times half the speed
    flux = float(out.split("front half: ")[1].split()[0])
    assert flux == pytest.approx(174e-9 * 2 * 334e-6 * 0.1e-3 / 2, rel=0.15)
    assert path.read_bytes().startswith(b"%PDF")


def test_flow_of_a_physical_contact(tmp_path):
    path = tmp_path / "flow.svg"
    assert main(["flow", *BALL, "--plot", str(path)]) == 0
    drawing = path.read_text(encoding="utf-8")
    assert "[Pa]" in drawing


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--plot", "a.png"], "--solution: missing; give --solution, --beta, or a physical contact"),
        (["--beta", "10", "--radius", "2 mm", "--plot", "a.png"], "--beta, --radius: give one contact, not several"),
        (["--beta", "10", "--plot", "a.gif"], "--plot: expected a file ending in"),
        (["--beta", "10", "--plot", "a.png", "--level", "1.5"], "--level: expected a share of the film between 0"),
        (["--solution", "a.nc", "--plot", "a.png"], "'a.nc' does not exist"),
        (["--solution", "a.nc", "--cavitation", "none", "--plot", "a.png"], "--cavitation: the solution has its own"),
        (["--beta", "10"], "plot"),
    ],
)
def test_flow_refuses_bad_input(tmp_path, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(tmp_path)
    assert main(["flow", *arguments]) == 2
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_the_flow_under_a_ball_that_turns_is_refused(tmp_path, capsys):
    rolling = ["--entrainment-speed" if each == "--speed" else each for each in BALL]
    assert main(["flow", *rolling, "--slide-to-roll", "0", "--plot", str(tmp_path / "flow.png")]) == 2
    assert "--slide-to-roll: velocities and stresses are drawn for a ball that does not turn" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
