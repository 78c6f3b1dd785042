"""The key of an outcome: what is in it, and what is not."""

import ast
import re
import shutil
import subprocess
import sys

import pytest

import softlube
from softlube.errors import NotConvergedError
from softlube.model.problem import Problem
from softlube.solvers import code_version
from softlube.solvers.code_version import package_folder
from softlube.sweeps import work
from softlube.sweeps.steady import SteadyTask
from softlube.sweeps.work import ROOMS, content_key, solve_one, solver_version

WITHOUT_NUMBERS = ("files", "physical", "plots", "paper")
"""Folders that the code of a task imports, for `save` and `plot`, the types of inputs and other methods than its own."""


def test_the_key_is_made_of_all_that_determines_a_solution(monkeypatch):
    key = content_key(SteadyTask(Problem(beta=10)), 1e-3)
    assert key == content_key(SteadyTask(Problem(beta=10.0)), 1e-3)
    others = [
        content_key(SteadyTask(Problem(beta=11)), 1e-3),
        content_key(SteadyTask(Problem(beta_load=10)), 1e-3),
        content_key(SteadyTask(Problem(beta=10, cavitation="none")), 1e-3),
        content_key(SteadyTask(Problem(beta=10)), 2e-3),
    ]
    monkeypatch.setattr("softlube.sweeps.work.solver_version", lambda kind: "another")
    others.append(content_key(SteadyTask(Problem(beta=10)), 1e-3))
    assert len({key, *others}) == 6


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """A copy of the package that versions are taken of."""
    folder = tmp_path / "softlube"
    shutil.copytree(package_folder(), folder, ignore=shutil.ignore_patterns("__pycache__", "data"))
    monkeypatch.setattr(code_version, "package_folder", lambda: folder)
    monkeypatch.setattr(work, "code_version", code_version.code_version.__wrapped__)
    return folder


def versions():
    return {kind: work.solver_version(kind) for kind in ROOMS}


def changed(before):
    """The kinds whose version is another one now."""
    now = versions()
    return {kind for kind in ROOMS if now[kind] != before[kind]}


def another_constant(path):
    """Change the first number that a module gives a name to."""
    text, count = re.subn(r"(?m)^([A-Z_]+) = ([0-9.e-]+)$", r"\1 = 2 * \2", path.read_text(), count=1)
    assert count == 1
    path.write_text(text)


@pytest.mark.parametrize(
    ("folder", "kinds"),
    [
        ("transient/squeeze", {"squeeze", "sliding"}),
        ("transient/sliding", {"sliding"}),
        ("steady/refinements/spike", {"steady", "sliding"}),
        ("discretization", {"steady", "squeeze", "sliding"}),
        ("model", {"steady", "squeeze", "sliding"}),
        ("plots", set()),
        ("cli", set()),
        ("theory", set()),
    ],
)
def test_code_counts_by_folder(copy, folder, kinds):
    before = versions()
    with (sorted((copy / folder).glob("[!_]*.py"))[0]).open("a") as file:
        file.write("\n\nNEW = 1\n")
    assert changed(before) == kinds


def test_a_new_module_counts(copy):
    before = versions()
    (copy / "discretization" / "another.py").write_text("SIZE = 3\n")
    assert changed(before) == set(ROOMS)


def test_docstrings_comments_and_layout_do_not_count(copy):
    before = versions()
    for path in copy.rglob("*.py"):
        tree = ast.parse(path.read_text())
        for node in ast.walk(tree):
            if code_version._stands_alone(node):
                node.value.value = "Another text."
        path.write_text(ast.unparse(tree) + "\n# a remark\n")  # which has no comments, and other line breaks
    assert "Another text." in (copy / "solvers" / "newton.py").read_text()
    assert changed(before) == set()


@pytest.mark.parametrize("kind", ROOMS)
def test_all_code_that_computes_is_in_the_version(kind):
    """Whatever the solving module imports, directly or not, is in its folders, or in one that has no say in the numbers."""
    start = {"steady": "steady.solve", "squeeze": "transient.squeeze.result", "sliding": "transient.sliding.result"}[kind]
    folder = package_folder()
    covered = {path for pattern in ROOMS[kind] for path in folder.glob(pattern)}
    waiting, seen = [start], set()
    while waiting:
        name = waiting.pop()
        path = folder.joinpath(*name.split(".")).with_suffix(".py")
        if name in seen or name == "errors" or name.split(".")[0] in WITHOUT_NUMBERS or not path.is_file():
            continue
        seen.add(name)
        assert path in covered, name
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("softlube."):
                inner = node.module.removeprefix("softlube.")
                waiting += [inner, *(f"{inner}.{item.name}" for item in node.names)]
    assert len(seen) > 8


RUN = """
import softlube
result = softlube.sweep(
    {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "load": ["50 mN", "100 mN"],
     "initial_height": "20 um", "duration": "10 ms"},
    motion="squeeze", accuracy=0.05, store="store", workers=1)
print(result.n_found, result.n_foreign)
"""


@pytest.mark.slow
def test_a_store_of_squeeze_films_outlives_changes_elsewhere(tmp_path):
    """Pictures and the mesh about a spike changed: nothing is solved again.  The squeeze film's own code changed: all is."""
    copied = tmp_path / "src" / "softlube"
    shutil.copytree(package_folder(), copied, ignore=shutil.ignore_patterns("__pycache__"))

    def sweep():
        command = [sys.executable, "-c", RUN]
        environment = {"PYTHONPATH": str(tmp_path / "src"), "PATH": "", "OPENBLAS_NUM_THREADS": "1"}
        ran = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True)
        return tuple(map(int, ran.stdout.split()))

    assert sweep() == (0, 0)
    with (copied / "plots" / "transient.py").open("a") as file:
        file.write("\nWIDTH = 3.0\n")
    another_constant(copied / "steady" / "refinements" / "spike" / "closeup.py")
    assert sweep() == (2, 0)
    another_constant(copied / "transient" / "squeeze" / "rings.py")
    assert sweep() == (0, 2)


def test_what_goes_wrong_is_an_outcome():
    class Wrong(SteadyTask):
        def solve(self, accuracy, with_fields):
            raise NotConvergedError("no grid") if accuracy == 1 else ZeroDivisionError("by zero")

    task = Wrong(Problem(beta=10))
    assert solve_one(task, 1, False).reason == "no grid"
    assert solve_one(task, 2, False).reason == "ZeroDivisionError: by zero"


def test_the_version_is_the_release_and_a_digest():
    release, digest = solver_version("steady").split("+")
    assert release == softlube.__version__
    assert len(digest) == 12


def test_words_of_inputs_do_not_count_and_their_laws_do(copy):
    before = versions()
    path = copy / "model" / "substrates" / "layer.py"
    text = path.read_text()
    path.write_text(text.replace("Thickness of the substrate", "How thick it is"))
    assert path.read_text() != text
    assert changed(before) == set()
    path.write_text(text.replace("LARGEST_WAVENUMBER = 18.0", "LARGEST_WAVENUMBER = 19.0"))
    assert changed(before) == set(ROOMS)
