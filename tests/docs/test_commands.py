"""Every command and every Python block in the docs is run, and prints what the page shows."""

import os
import re
import sys
from pathlib import Path

import pytest
from follow import alike, blocks_of, differences, make_file, run_bash, run_python

from softlube.cli.main import app

ROOT = Path(__file__).parents[2]
PAGES = [path.relative_to(ROOT).as_posix() for path in sorted((ROOT / "docs").rglob("*.md")) if "_gallery" not in path.parts]
WITH_BLOCKS = [
    page for page in PAGES if re.search(r"^```(bash|python)$", (ROOT / page).read_text(encoding="utf-8"), re.MULTILINE)
]
OTHER_PROGRAMS = {"--nthreads"}
"""Options in the docs that are Dask's."""


def follow_page(page, folder, *, slow):
    """Run the commands of a page, then its Python, each in order; returns what differs."""
    environment = os.environ | {
        "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        "OPENBLAS_NUM_THREADS": "1",
        "COLUMNS": "120",
    }
    blocks = blocks_of((ROOT / page).read_text(encoding="utf-8"))
    assert {block.mark for block in blocks} <= {None, "file", "fresh", "slow", "not run"}
    for block in blocks:
        if block.mark == "file":
            make_file(block, folder)
    different = []
    for language, run in (("bash", run_bash), ("python", run_python)):
        wanted = [
            block for block in blocks if block.language == language and block.mark in ({None, "slow"} if slow else {None})
        ]
        for block, printed in zip(wanted, run(wanted, folder, environment), strict=True):
            if block.shows is not None:
                different += differences(block.shows, printed)
    return different


@pytest.mark.parametrize("page", WITH_BLOCKS)
def test_page_does_what_it_shows(tmp_path, page):
    different = follow_page(page, tmp_path, slow=False)
    assert not different, "\n".join(different)


@pytest.mark.slow
@pytest.mark.parametrize("page", [page for page in WITH_BLOCKS if "<!-- slow -->" in (ROOT / page).read_text(encoding="utf-8")])
def test_page_does_what_it_shows_the_slow_blocks_too(tmp_path, page):
    different = follow_page(page, tmp_path, slow=True)
    assert not different, "\n".join(different)


@pytest.mark.parametrize("page", [*PAGES, "README.md", "CHANGELOG.md"])
def test_no_command_stands_outside_the_blocks_that_are_run(page):
    """Indented commands look like commands, but no test runs them."""
    text = (ROOT / page).read_text(encoding="utf-8")
    outside = re.sub(r"^```(bash|python)\n.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
    stray = re.findall(r"^(?: {4}|\$ )(softlube .*)$", outside, flags=re.MULTILINE)
    assert stray == []


@pytest.mark.parametrize("page", [page for page in [*PAGES, "README.md"] if "/from-" not in page])  # old names stand there
def test_options_and_scripts_in_the_text_exist(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    mentioned = set(re.findall(r"(?<![\w-])--[a-z][a-z-]+", text))
    assert mentioned - OPTIONS - OTHER_PROGRAMS == set()
    for script in re.findall(r"`?\b((?:benchmarks|examples|tests)/[\w/]+\.py)\b", text):
        assert (ROOT / script).is_file(), script


def options_of_all_commands(app=app):
    """Names of the options of every command and of the commands under it, from the declarations."""
    names = {command for command in app if command.startswith("-")}
    for command in set(app) - names:
        names |= options_of_all_commands(app[command])
    if app.default_command is not None:
        for argument in app.assemble_argument_collection():
            names.update(name for name in argument.names if name.startswith("--"))
    return names


OPTIONS = options_of_all_commands() | {
    name for script in (ROOT / "benchmarks").glob("*.py") for name in re.findall(r'"(--[a-z-]+)"', script.read_text("utf-8"))
}


def test_comparison_of_what_is_shown_and_printed():
    assert differences("a 1.00 ± 0.02 nm\n…\nend\n", "a 1.001 ± 0.025 nm\nx\ny\nend\n") == []
    assert differences("a 1.00 ± 0.02 nm\n", "a 1.02 ± 0.02 nm\n") == ["a 1.00 ± 0.02 nm", "not shown: a 1.02 ± 0.02 nm"]
    assert differences("a\n", "a\nb\n") == ["not shown: b"]
    assert not alike("β = 100", "β = 101")
    assert alike("β = 32706", "β = 32707")
