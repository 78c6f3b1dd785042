"""The command ``softlube``, also ``python -m softlube``."""

import sys


def main() -> int:
    """Run the command line; returns the exit code."""
    from softlube.cli.stopping import stoppable

    return stoppable(_command)


def _command() -> int:
    from softlube.cli.main import main

    return main()


if __name__ == "__main__":
    sys.exit(main())
