"""softlube substrate: output, files, refusals."""

import json
import shlex

import pytest

from softlube.cli.main import main

MODULI = """frequency [Hz], E' [MPa], E'' [MPa]
0.01, 3.03, 0.124
0.02, 3.11, 0.217
0.05, 3.3, 0.288
0.1, 3.41, 0.245
0.2, 3.48, 0.252
0.5, 3.57, 0.393
1, 3.84, 0.595
2, 4.29, 0.67
5, 4.58, 0.598
10, 4.7, 0.666
20, 4.95, 1.05
50, 5.85, 1.85
100, 7.16, 1.96
"""


@pytest.fixture
def data(tmp_path):
    path = tmp_path / "moduli.csv"
    path.write_text(MODULI)
    return path


def test_fit(data, tmp_path, capsys):
    files = ["--plot", str(tmp_path / "f.png"), "--output", str(tmp_path / "f.json")]
    assert main(["substrate", "fit", str(data), *files]) == 0
    out = capsys.readouterr().out
    for fragment in (
        "13 rows of moduli.csv; oscillation",
        "AICc over least",
        "Largest misfit: 2.3 %, of the loss modulus",
        '--young-modulus "3.005 MPa" --prony "',
        "softlube.Viscoelastic(young_modulus=",
        "Wrote ",
    ):
        assert fragment in out
    saved = json.loads((tmp_path / "f.json").read_text())
    assert len(saved["terms"]) == 3  # what the data were made with: 4 MPa in 2 ms, 1.2 MPa in 0.1 s, 0.5 MPa in 4 s
    assert [each["time"] for each in saved["terms"]] == pytest.approx([2e-3, 0.1, 4.0], rel=0.05)
    assert saved["options"] in out
    assert (tmp_path / "f.png").exists()


def test_the_printed_options_make_a_contact(data, capsys):
    """What is printed can be pasted after `softlube stribeck` or `softlube solve`."""
    from softlube.physical.contact import Contact

    assert main(["substrate", "fit", str(data), "--terms", "2", "--poisson-ratio", "0.45", "--json"]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    words = shlex.split(json.loads(captured.out)["options"])
    given = {name.removeprefix("--").replace("-", "_"): value for name, value in zip(words[::2], words[1::2], strict=True)}
    contact = Contact(radius="2 mm", viscosity="1 Pa s", speed="1 mm/s", load="10 mN", **given)
    assert len(contact.substrate.terms) == 2
    assert contact.substrate.poisson_ratio == 0.45


@pytest.mark.parametrize(
    ("arguments", "fragment"),
    [
        (["no.csv"], "no.csv: the file does not exist"),
        (["--terms", "9"], "--terms: the data take 3 times at most, got 9"),
        (["--terms", "2.5"], "--terms"),
        (["--plot", "f.doc"], "--plot"),
        (["--poisson-ratio", "2"], "--poisson-ratio"),
    ],
)
def test_refusals(data, arguments, fragment, capsys):
    given = arguments if arguments[0].endswith(".csv") else [str(data), *arguments]
    assert main(["substrate", "fit", *given]) == 2
    said = capsys.readouterr().err
    assert fragment in said
    assert said.count("\n") == 1


def test_a_malformed_file_is_a_line_and_exit_code_2(tmp_path, capsys):
    path = tmp_path / "bad.csv"
    path.write_text(MODULI.replace("3.3,", "three,"))
    assert main(["substrate", "fit", str(path)]) == 2
    said = capsys.readouterr().err
    assert said.startswith("softlube: bad.csv, line 4: storage_modulus: 'three'")
    assert said.count("\n") == 1
