"""Completion of the shell: a script in the home folder that knows commands, options and choices."""

import pytest

from softlube.cli.main import app, main


@pytest.mark.parametrize(("shell", "start"), [("bash", ".bashrc"), ("zsh", ".zshrc")])
def test_script_and_start_file(shell, start, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("HOME", str(tmp_path))
    for name in ("ZDOTDIR", "XDG_DATA_HOME", "XDG_CONFIG_HOME"):
        monkeypatch.delenv(name, raising=False)
    assert main(["--install-completion", "--shell", shell]) == 0
    said = capsys.readouterr().out
    (written,) = [path for path in tmp_path.rglob("*") if path.is_file() and path.name != start]
    assert said.startswith(f"Wrote {written}")
    assert "stribeck" in written.read_text()
    assert (tmp_path / start).exists()


def test_choices_are_completed():
    script = app.generate_completion(shell="bash")
    for word in ("--young-modulus", "relaxation", "frictionless", "dowson-higginson", "stribeck"):
        assert word in script


def test_a_shell_that_is_not_known_is_asked_for(monkeypatch, capsys):
    def unknown(*positional, **named):
        from cyclopts.completion.detect import ShellDetectionError

        raise ShellDetectionError

    monkeypatch.setattr(type(app), "install_completion", unknown)
    assert main(["--install-completion"]) == 2
    assert "--shell: cannot tell which shell this is" in capsys.readouterr().err
