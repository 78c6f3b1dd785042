"""softlube fit: output, files, refusals."""

import json

import pytest

import softlube
from softlube.cli.main import main

RIG = ["--radius", "2 mm", "--young-modulus", "3 MPa"]
HEADER = "load [mN], speed [mm/s], friction [mN]\n"


@pytest.fixture
def data(tmp_path):
    """Twelve rows on the paper's Eq. (28), which is no more than a few per cent from the curve."""
    rows = []
    for load in (0.05, 0.1, 0.2):
        for speed in (1e-4, 3e-4, 1e-3, 3e-3):
            contact = softlube.Contact(radius="2 mm", young_modulus="3 MPa", viscosity=2.0, speed=speed, load=load)
            friction = 2e6 * 3.14159 / 3 * contact.unit_height**2 * 4.806 * contact.problem().beta_load ** -0.4398
            rows.append(f"{1e3 * load}, {1e3 * speed}, {1e3 * friction}\n")
    path = tmp_path / "data.csv"
    path.write_text(HEADER + "".join(rows))
    return path


def test_fit(data, tmp_path, capsys):
    files = ["--plot", str(tmp_path / "f.png"), "--output", str(tmp_path / "f.json")]
    assert main(["fit", str(data), *RIG, "--free", "viscosity", "--hold-out", "0.25", *files]) == 0
    out = capsys.readouterr().out
    for fragment in (
        "9 rows of data.csv",
        "viscosity",
        "held",
        "The data determine viscosity",
        "3 rows left out",
        "Taken as measured: the whole horizontal force on the ball (total), within 2 radii",
        "If something else was measured",
        "the shear on the ball, Eq. (27a) (sphere), within 2 radii of the dry contact: ",
    ):
        assert fragment in out
    assert main(["fit", str(data), *RIG, "--force", "sphere", "--json"]) == 0
    captured = capsys.readouterr()
    found = json.loads(captured.out)
    assert captured.err == ""
    assert found["values"]["viscosity"] == pytest.approx(2.0, rel=0.06)
    assert found["estimates"]["viscosity"]["low"] < found["values"]["viscosity"] < found["estimates"]["viscosity"]["high"]
    saved = json.loads((tmp_path / "f.json").read_text())
    assert saved["hold_out"]["covered"] <= 1
    assert (tmp_path / "f.png").exists()


@pytest.mark.parametrize(
    ("content", "arguments", "fragment"),
    [
        ("", RIG, "data.csv, line 1: the file is empty"),
        (HEADER + "100, 0.1, much\n", RIG, "data.csv, line 2: friction: 'much' under 'friction [mN]' is no number"),
        (HEADER + "100, -0.1, 1\n", RIG, "data.csv, line 2: speed: expected a positive"),
        ("load [m], speed [m/s], friction [N]\n1,1,1\n", RIG, "data.csv, line 1: load cannot be in 'm'"),
        (None, RIG[:2], "--young-modulus: missing; give it or fit it"),
        (None, RIG[2:], "--radius: missing"),
        (None, [*RIG, "--free", "colour"], "--free: expected one or more"),
        (None, [*RIG, "--hold-out", "2"], "--hold-out: expected a fraction"),
        (None, [*RIG, "--plot", "a.gif"], "--plot: expected a file ending"),
        (None, [*RIG, "--output", "no/such/folder/a.json"], "--output: the folder"),
        (None, [*RIG, "--output", "DATA"], "expected files of their own"),
    ],
)
def test_a_bad_fit_exits_2_with_one_line_and_writes_nothing(data, tmp_path, capsys, content, arguments, fragment):
    if content is not None:
        data.write_text(content)
    before = data.read_bytes()
    plot = [] if "--plot" in arguments else ["--plot", str(tmp_path / "f.png")]
    assert main(["fit", str(data), *(str(data) if a == "DATA" else a for a in arguments), *plot]) == 2
    captured = capsys.readouterr()
    assert fragment in captured.err
    assert captured.err.count("\n") == 1
    assert captured.out == ""
    assert list(tmp_path.iterdir()) == [data]
    assert data.read_bytes() == before


def test_a_layer_is_fitted(data, capsys):
    assert main(["fit", str(data), *RIG, "--thickness", "1 mm", "--json"]) == 0
    layer = json.loads(capsys.readouterr().out)
    assert main(["fit", str(data), *RIG, "--json"]) == 0
    half_space = json.loads(capsys.readouterr().out)
    assert layer["force"] == half_space["force"] == "total"
    assert layer["values"]["viscosity"] != pytest.approx(half_space["values"]["viscosity"], rel=5e-3)
    assert layer["beta"] != half_space["beta"]
