"""The command line as a whole: commands, help, version, exit codes."""

import json

import pytest

import softlube
from softlube.cli.main import main


def test_unknown_command_exits_2(capsys):
    assert main(["slove"]) == 2
    assert "solve" in capsys.readouterr().err


def test_help_and_version(capsys):
    assert main(["--version"]) == 0
    assert softlube.__version__ in capsys.readouterr().out
    assert main(["solve", "--help"]) == 0
    out = capsys.readouterr().out
    assert "--young-modulus" in out
    assert "2 mm" in out


@pytest.mark.parametrize("command", ["sweep", "stribeck", "fit"])
def test_help(capsys, command):
    assert main([command, "--help"]) == 0
    out = capsys.readouterr().out
    assert f"softlube {command}" in out
    assert "[default" in out


def test_choices_are_in_the_help(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert main(["solve", "--help"]) == 0
    out = capsys.readouterr().out
    assert "[choices: newton, relaxation, cartesian]" in out
    assert '"frictionless" [default: bonded]' in out
    assert main(["--help"]) == 0
    assert "--install-completion" in capsys.readouterr().out


def test_an_option_of_02_is_refused_with_its_new_name(capsys):
    assert main(["curve", "--csv", "a.csv"]) == 2
    assert capsys.readouterr().err == "softlube: --csv: softlube curve calls it --output since 0.3.\n"


def test_help_names_the_commands(capsys):
    assert main(["--help"]) == 0
    out = capsys.readouterr().out
    assert "reproduce" in out
    assert "flow" in out


def test_json_of_the_solved_contact_is_untouched(capsys):
    """The new commands leave the old one as it was."""
    assert main(["solve", "--beta", "100", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["beta"] == 100


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["solve", "--beta", "1_000"], "--beta: cannot read '1_000': write it without signs between thousands, '1000'"),
        (["solve", "--beta", "inf"], "--beta: cannot read 'inf': expected a finite number"),
        (["solve", "--beta", "1e999"], "--beta: cannot read '1e999': the number is too large"),
        (["stribeck", "--slide-to-roll", "1,000"], "--slide-to-roll: cannot read '1,000': the comma may part"),
        (["stribeck", "--points", "1_0"], "--points: cannot read '1_0': expected a whole number"),
        (["solve", "--radius", "2\x1b[2J mm"], r"--radius: cannot read '2\x1b[2J mm'"),
        (["\x1b[2J"], r"\x1b[2J"),
        (["solve", "--\x1b", "3"], r"--\x1b"),
        (["solve", "--radius", "9" * 5000], "--radius: cannot read a text of 5000 characters"),
        (["flow", "--solution", "a\x1b.nc", "--plot", "a.png"], r"--solution: 'a\x1b.nc' does not exist"),
    ],
)
def test_a_refusal_is_one_line(capsys, arguments, message):
    assert main(arguments) == 2
    said = capsys.readouterr().err
    assert message in said
    assert said.endswith("\n")
    assert said[:-1].isprintable()
    assert len(said) < 320


def test_a_decimal_comma_is_a_decimal_sign(capsys):
    assert main(["solve", "--fast", "--json", "--beta", "10,5"]) == 0
    assert json.loads(capsys.readouterr().out)["beta"] == 10.5
