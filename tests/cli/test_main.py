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


def test_help_names_the_commands(capsys):
    assert main(["--help"]) == 0
    out = capsys.readouterr().out
    assert "reproduce" in out
    assert "flow" in out


def test_json_of_the_solved_contact_is_untouched(capsys):
    """The new commands leave the old one as it was."""
    assert main(["solve", "--beta", "100", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["beta"] == 100
