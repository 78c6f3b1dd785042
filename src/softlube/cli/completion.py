"""``softlube --install-completion``: the shell completes commands, options and their choices."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter

from softlube.errors import printable


def install_completion(*, shell: Annotated[Literal["bash", "zsh", "fish"] | None, Parameter(negative=())] = None) -> int:
    """Write the completion script of the shell into the home folder, and a line that loads it into the shell's start file.

    Parameters
    ----------
    shell
        Whose script [default: the shell that this runs in].
    """
    from cyclopts.completion.detect import ShellDetectionError

    from softlube.cli.main import app
    from softlube.errors import InputError

    try:
        path = app.install_completion(shell=shell)
    except ShellDetectionError:
        raise InputError("shell: cannot tell which shell this is; give --shell bash, zsh or fish") from None
    print(f"Wrote {printable(path)}: it works in the next shell that you start")
    return 0
