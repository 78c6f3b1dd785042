"""``python -m softlube``: the command line."""

import sys

from softlube.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
