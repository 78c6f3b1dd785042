"""How long `softlube reproduce` takes on two cores, from a cold start: at most a minute.

    python benchmarks/bench_reproduce.py

Nothing else may run beside it.  Exit code 1 if it takes longer.
"""

import argparse
import subprocess
import sys
import tempfile
import time

LIMIT = 60.0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--processes", type=int, default=2)
    options = parser.parse_args()
    code = "import sys; from softlube.cli.main import main; sys.exit(main())"
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        command = [sys.executable, "-c", code, "reproduce", folder, "--processes", str(options.processes)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        seconds = time.perf_counter() - began
    print(f"softlube reproduce: {seconds:.1f} s with {options.processes} processes (limit {LIMIT:.0f} s)")
    return 0 if seconds <= LIMIT else 1


if __name__ == "__main__":
    sys.exit(main())
