"""Bundle the calculator's scripts with npm and esbuild, in a scratch folder: nothing but the bundle comes back.

python .ci/calculator_bundle.py           # after a change of the scripts
python .ci/calculator_bundle.py FOLDER    # into another folder, with node_modules, to compare
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PAGE = Path(__file__).parents[1] / "src" / "softlube" / "plots" / "calculator" / "web"
BUNDLE = ("bundle.js", "bundle.css")


def build(folder: Path) -> None:
    """Install what the lock file names and bundle, in a folder."""
    shutil.copytree(PAGE, folder, dirs_exist_ok=True)
    npm = shutil.which("npm")
    if npm is None:
        sys.exit("npm is not installed (apt-get install npm)")
    for command in (["ci", "--ignore-scripts", "--no-audit", "--no-fund"], ["run", "build"]):
        run = subprocess.run([npm, *command], cwd=folder, capture_output=True, text=True, check=False)
        if run.returncode:
            sys.exit(f"npm {' '.join(command)} failed:\n{run.stdout}{run.stderr}")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        build(Path(sys.argv[1]))
    else:
        with tempfile.TemporaryDirectory() as scratch:
            build(Path(scratch))
            for name in BUNDLE:
                shutil.copy(Path(scratch) / name, PAGE / name)
