"""Do what a page of the docs says: make its files, run its commands, and compare what they print with what the page shows.

A fenced block of ``bash`` or ``python`` is run; a block of ``text`` right after it is what it must print, ``…`` standing for
any lines.  A comment before a block says what else it is:

| comment | the block |
|---|---|
| ``<!-- file: NAME -->`` | is the content of a file |
| ``<!-- fresh: why -->`` | is run only when the page is followed in a fresh environment |
| ``<!-- slow -->`` | takes longer than half a minute; is run with the slow tests |
| ``<!-- not run: why -->`` | is not run |

In a fresh environment: ``python tests/docs/follow.py docs/start/five-minutes.md FOLDER``, with the folder of a clone.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

END = "@@ end of block @@"
LONGEST = 300.0
"""Seconds that the commands of a page may take."""
BLOCK = re.compile(
    r"^(?:<!-- (?P<mark>file|fresh|slow|not run)(?:: (?P<word>[^\n]*?))? -->\n+)?^```(?P<language>\w+)\n(?P<text>.*?)^```$",
    flags=re.DOTALL | re.MULTILINE,
)
NUMBER = re.compile(r"[-−+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
RELATIVE = 2e-3
"""Two runs may end on different grids, and then differ by the accuracy asked for, 10⁻³."""


@dataclass(frozen=True)
class Block:
    """A fenced block of a page."""

    language: str
    text: str
    mark: str | None
    word: str | None
    shows: str | None
    """What the page shows that it prints."""


def blocks_of(page: str) -> list[Block]:
    """Fenced blocks in their order; what a block prints belongs to it."""
    found: list[Block] = []
    end = -1
    for match in BLOCK.finditer(page):
        block = Block(match["language"], match["text"], match["mark"], match["word"], None)
        between = page[end : match.start()] if end >= 0 else "x"
        if block.language == "text" and block.mark is None and found and found[-1].language in ("bash", "python"):
            paragraphs = [text for text in between.split("\n\n") if text.strip()]
            if len(paragraphs) <= 1 and not any(text.lstrip().startswith("#") for text in paragraphs):
                last = found.pop()
                block = Block(last.language, last.text, last.mark, last.word, block.text)
        found.append(block)
        end = match.end()
    return found


def run_bash(blocks: list[Block], folder: Path, environment: dict[str, str]) -> list[str]:
    """Run blocks in one shell, as a reader would; what each printed on both streams."""
    script = "".join(f"{block.text}\necho '{END}'\n" for block in blocks)
    run = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", script],
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        check=False,
        timeout=LONGEST,
    )
    outputs = run.stdout.split(f"{END}\n")
    if run.returncode:
        raise AssertionError(f"exit code {run.returncode}: {blocks[len(outputs) - 1].text}\n{outputs[-1]}")
    return outputs[:-1]


def run_python(blocks: list[Block], folder: Path, environment: dict[str, str]) -> list[str]:
    """Run blocks in one interpreter; what each printed, without its warnings."""
    script = "".join(f"{block.text}\nprint({END!r}, flush=True)\n" for block in blocks)
    run = subprocess.run(
        [sys.executable, "-c", script],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
        timeout=LONGEST,
    )
    if run.returncode:
        raise AssertionError(f"{script}\n{run.stderr}")
    return run.stdout.split(f"{END}\n")[:-1]


def differences(shown: str, printed: str) -> list[str]:
    """Lines of the page that were not printed, in order; numbers may differ by a rounding, errors by a half."""
    left = [line for line in printed.splitlines() if line.strip()]
    missing = []
    anywhere = False
    for line in (line for line in shown.splitlines() if line.strip()):
        if line.strip() == "…":
            anywhere = True
            continue
        places = range(len(left)) if anywhere else range(min(1, len(left)))
        place = next((place for place in places if alike(line, left[place])), None)
        if place is None:
            missing.append(line)
            if not anywhere and left:
                missing.append(f"not shown: {left.pop(0)}")
        else:
            del left[: place + 1]
            anywhere = False
    if left and not anywhere:
        missing.extend(f"not shown: {line}" for line in left)
    return missing


def alike(shown: str, printed: str) -> bool:
    """Whether two lines have the words and, within their accuracy, the numbers of each other."""
    if re.sub(r"[─\s]+", " ", NUMBER.sub("0", shown)).strip() != re.sub(r"[─\s]+", " ", NUMBER.sub("0", printed)).strip():
        return False
    for expected, found in zip(NUMBER.finditer(shown), NUMBER.finditer(printed), strict=True):
        number, other = (float(match[0].replace("−", "-")) for match in (expected, found))
        is_error = shown[: expected.start()].rstrip().endswith("±")
        digits = len(expected[0].partition("e")[0].partition(".")[2])
        rounding = 0.6 * 10.0**-digits if "." in expected[0] and "e" not in expected[0] else 0.0
        if abs(number - other) > (0.5 if is_error else RELATIVE) * abs(number) + rounding:
            return False
    return True


def make_file(block: Block, folder: Path) -> None:
    """Write the block into the file that its mark names."""
    (folder / (block.word or "")).write_text(block.text, encoding="utf-8")


def main(page: str, folder: str) -> int:
    """Follow a page's commands literally, those that install included, in one shell; returns the exit code."""
    blocks = blocks_of(Path(page).read_text(encoding="utf-8"))
    for block in blocks:
        if block.mark == "file":
            make_file(block, Path(folder))
    commands = [block for block in blocks if block.language == "bash" and block.mark != "not run"]
    bad = 0
    for block, printed in zip(commands, run_bash(commands, Path(folder), dict(os.environ)), strict=True):
        print(block.text + printed)
        for line in differences(block.shows, printed) if block.shows is not None else ():
            bad = 1
            print(f"{page}: not as shown: {line}", file=sys.stderr)
    return bad


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
