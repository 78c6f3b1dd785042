"""softlube liquid: output, files, refusals."""

import json

import pytest

from softlube.cli.main import main

FLOW = """shear rate [1/s], viscosity [mPa s]
0.01, 2050
0.03, 1980
0.1, 2010
0.3, 1980
1, 1930
3, 1500
10, 1130
30, 660
100, 365
300, 208
1000, 116
"""


@pytest.fixture
def data(tmp_path):
    path = tmp_path / "flow.csv"
    path.write_text(FLOW)
    return path


def test_fit(data, tmp_path, capsys):
    files = ["--plot", str(tmp_path / "f.png"), "--output", str(tmp_path / "f.json")]
    assert main(["liquid", "fit", str(data), "--law", "carreau", "--no-second-plateau", *files]) == 0
    out = capsys.readouterr().out
    for fragment in (
        "11 rows of flow.csv; law: carreau",
        "AICc over least",
        "The data determine viscosity, relaxation_time, index within the intervals stated.",
        "--viscosity-law carreau --viscosity",
        "softlube.Carreau(viscosity=",
        "Wrote ",
    ):
        assert fragment in out
    saved = json.loads((tmp_path / "f.json").read_text())
    assert saved["values"]["viscosity"] == pytest.approx(2.0, rel=0.05)
    assert saved["options"] in out
    assert (tmp_path / "f.png").exists()


def test_json(data, capsys):
    assert main(["liquid", "fit", str(data), "--json"]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    assert len(json.loads(captured.out)["laws"]) == 8


def test_the_printed_options_make_a_contact(data, capsys):
    """What is printed can be pasted after `softlube stribeck` or `softlube solve`."""
    import shlex

    from softlube.physical.contact import Contact

    assert main(["liquid", "fit", str(data), "--json"]) == 0
    words = shlex.split(json.loads(capsys.readouterr().out)["options"])
    given = {name.removeprefix("--").replace("-", "_"): value for name, value in zip(words[::2], words[1::2], strict=True)}
    contact = Contact(radius="2 mm", young_modulus="1 MPa", speed="1 mm/s", load="10 mN", **given)
    assert contact.viscosity == pytest.approx(2.0, rel=0.05)


@pytest.mark.parametrize(
    ("arguments", "fragment"),
    [
        (["no.csv"], "no.csv: the file does not exist"),
        (["--law", "bingham"], "--law: expected one of"),
        (["--plot", "f.doc"], "--plot"),
        (["--confidence", "2"], "--confidence"),
    ],
)
def test_refusals(data, arguments, fragment, capsys):
    given = arguments if arguments[0].endswith(".csv") else [str(data), *arguments]
    assert main(["liquid", "fit", *given]) == 2
    assert fragment in capsys.readouterr().err


def test_files_of_their_own(data, capsys):
    assert main(["liquid", "fit", str(data), "--output", str(data)]) == 2
    assert "files of their own" in capsys.readouterr().err
    assert data.read_text() == FLOW
