"""Compare the numbers of two installed versions of softlube on some eighty cases (`version_cases.py`).

    python benchmarks/compare_versions.py OLD_PYTHON NEW_PYTHON [--quick] [--except PATTERN ...]

Both arguments are Python interpreters with a version of softlube installed, or files that `version_cases.py` wrote before.
Only the new interpreter sees PYTHONPATH, so that it can point to a working tree.  A quantity or an error that differs by more
than `LARGEST_DIFFERENCE`, relative, ends the comparison with exit code 1, unless its name matches a pattern of `--except`
(for instance `--except pressure_max "SI pressure_max*"`).
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from fnmatch import fnmatch
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

LARGEST_DIFFERENCE = 1e-9
CASES = Path(__file__).with_name("version_cases.py")
Numbers = dict[str, NDArray[np.floating]]


def start(source: str, output: Path, quick: bool, search_path: str | None) -> subprocess.Popen[bytes] | None:
    """Start the cases in an interpreter, unless the source is a file of numbers."""
    if source.endswith(".npz"):
        return None
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | {"OPENBLAS_NUM_THREADS": "1"}
    if search_path:
        environment["PYTHONPATH"] = search_path
    return subprocess.Popen([source, str(CASES), str(output), *(["--quick"] if quick else [])], env=environment)


def difference(old: NDArray[np.floating], new: NDArray[np.floating]) -> float:
    """Largest relative difference: of a field, relative to its largest value; of a number or a curve, point by point."""
    if old.shape != new.shape:
        return float("inf")
    finite = np.isfinite(old)
    if not np.array_equal(finite, np.isfinite(new)) or not np.array_equal(old[~finite], new[~finite], equal_nan=True):
        return float("inf")
    if not finite.any():
        return 0.0
    largest = np.max(np.abs(old[finite]))
    scale = largest if old.ndim > 1 else np.maximum(np.abs(old[finite]), 1e-12 * largest)
    change = np.abs(new[finite] - old[finite])
    return float(np.max(np.divide(change, scale, out=np.where(change > 0, np.inf, 0.0), where=scale > 0)))


def compare(old: Numbers, new: Numbers, excepted: list[str], quick: bool) -> bool:
    """Print a row for each group of cases, and every number that differs; say whether all agree."""
    groups: dict[str, list[tuple[float, str]]] = defaultdict(list)
    passed_over: list[tuple[float, str]] = []
    ran = {name.rsplit(" | ", 1)[0] for name in new} if quick else None
    for name in sorted(old.keys() | new.keys()):
        case, quantity = name.rsplit(" | ", 1)
        if ran is not None and case not in ran:
            continue
        apart = difference(old[name], new[name]) if name in old and name in new else float("inf")
        if any(fnmatch(quantity, pattern) for pattern in excepted):
            passed_over.append((apart, name))
        else:
            groups[case.split(" | ")[0]].append((apart, name))
    print(f"{'group':<18} {'cases':>5} {'compared':>9} {'largest difference':>19}  where")
    for group, rows in groups.items():
        largest, name = max(rows)
        where = name.split(" | ", 1)[1] if largest > 0 else ""
        print(f"{group:<18} {len({n.rsplit(' | ', 1)[0] for _, n in rows}):5d} {len(rows):9d} {largest:19.1e}  {where}")
    for apart, name in sorted(passed_over, reverse=True)[:10]:
        print(f"excepted: {apart:.1e}  {name}")
    wrong = [row for rows in groups.values() for row in rows if row[0] > LARGEST_DIFFERENCE]
    for apart, name in sorted(wrong, reverse=True):
        missing = "" if name in new else "  (the new version has it not)" if name in old else ""
        missing = "  (the old version has it not)" if name not in old else missing
        print(f"DIFFERS: {apart:.1e}  {name}{missing}")
    cases = {n.rsplit(" | ", 1)[0] for rows in groups.values() for _, n in rows}
    print(f"{len(cases)} cases, {sum(map(len, groups.values()))} numbers and arrays, {len(wrong)} above {LARGEST_DIFFERENCE:g}")
    return not wrong


def main() -> int:
    """Run both versions side by side and compare."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--quick", action="store_true", help="a dozen fast cases only")
    parser.add_argument(
        "--except", dest="excepted", nargs="+", default=[], metavar="PATTERN", help="quantities that may differ"
    )
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        paths, running = [], []
        for source, name, search_path in ((arguments.old, "old", None), (arguments.new, "new", os.environ.get("PYTHONPATH"))):
            output = Path(folder, name).with_suffix(".npz")
            process = start(source, output, arguments.quick, search_path)
            paths.append(Path(source) if process is None else output)
            running.append(process)
        codes = [process.wait() for process in running if process is not None]
        if any(codes):
            print("a version failed to compute its cases")
            return 2
        old, new = ({name: np.asarray(file[name]) for name in file.files} for file in map(np.load, paths))
    return 0 if compare(old, new, arguments.excepted, arguments.quick) else 1


if __name__ == "__main__":
    sys.exit(main())
