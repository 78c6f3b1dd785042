"""The tree itself: no circle of imports, few entries at the top, a test module for every module."""

import ast
import re
import tomllib
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src"
MOST_ENTRIES = 18
MODULES = {
    ".".join(path.relative_to(SOURCE).with_suffix("").parts).removesuffix(".__init__"): path for path in SOURCE.rglob("*.py")
}


def imports(path):
    """Modules of the package that a module imports: at the top, inside functions and for types."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found |= {item.name for item in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {
                f"{node.module}.{item.name}" if f"{node.module}.{item.name}" in MODULES else node.module for item in node.names
            }
    return found & MODULES.keys()


def excepted():
    """The exceptions to the order of the rooms, with their reasons in pyproject.toml."""
    (contract,) = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"]
    return {tuple(line.split(" -> ")) for line in contract["ignore_imports"]}


def find_circle(graph):
    """A circle of nodes, None if there is none."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return error.args[1]
    return None


def test_a_circle_is_found():
    assert find_circle({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}) is not None
    assert find_circle({"a": {"b", "c"}, "b": {"c"}, "c": set()}) is None


def test_no_circle_of_modules():
    exceptions = excepted()
    graph = {name: {other for other in imports(path) if (name, other) not in exceptions} for name, path in MODULES.items()}
    assert "softlube.solvers.newton" in graph["softlube.steady.level"]
    circle = find_circle(graph)
    assert circle is None, " <- ".join(circle)


def test_the_top_stays_small():
    entries = [path.name for path in (SOURCE / "softlube").iterdir() if path.name != "__pycache__"]
    assert len(entries) <= MOST_ENTRIES, entries


@pytest.mark.parametrize(
    "name", sorted(name for name, path in MODULES.items() if path.name not in ("__init__.py", "__main__.py"))
)
def test_every_module_has_its_test_module(name):
    parts = name.split(".")[1:]
    mirrored = ROOT.joinpath("tests", *parts[:-1], f"test_{parts[-1]}.py")
    assert mirrored.is_file(), f"{mirrored.relative_to(ROOT)} is missing"


def test_citation_and_changelog_are_of_this_version():
    version = re.search(r'__version__ = "(.+)"', (SOURCE / "softlube" / "__init__.py").read_text())[1]
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text()
    assert re.search(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)[1] == version


def test_contributing_names_every_room():
    """The tree of CONTRIBUTING has every folder with code, and no other; the files it sends newcomers to are there."""
    text = (ROOT / "CONTRIBUTING.md").read_text()
    tree = text.split("    src/softlube/\n")[1].split("    tests/")[0]
    named, folder = set(), {}
    for line in tree.splitlines():
        depth, name = len(line) - len(line.lstrip()), line.split()[0]
        if name.endswith("/"):
            folder[depth] = folder.get(depth - 2, Path()) / name
            named.add(folder[depth].as_posix())
    package = SOURCE / "softlube"
    there = {
        path.relative_to(package).as_posix() for path in package.rglob("*") if path.is_dir() and path.name != "__pycache__"
    }
    assert named == there
    for path in re.findall(r"`((?:src|tests|benchmarks)/[\w/.]+)`", text):
        assert list(ROOT.glob(path.replace("NAME", "*").rstrip("/"))), path
