"""What the documentation shows is what the command makes."""

import inspect
import re
from pathlib import Path

import numpy as np
import pytest

import softlube
from softlube import scaling
from softlube.paper.figures import FIGURES

ROOT = Path(__file__).parents[2]


def test_gallery_shows_every_figure():
    text = (ROOT / "docs" / "theory" / "gallery.md").read_text(encoding="utf-8")
    shown = re.findall(r"\]\(../figures/([\w-]+)\.png\)", text)
    assert shown == [spec.stem for spec in FIGURES.values()]
    for stem in shown:
        picture = ROOT / "docs" / "figures" / f"{stem}.png"
        assert picture.read_bytes().startswith(b"\x89PNG")
        assert picture.stat().st_size < 500_000


def test_readme_shows_the_command_s_picture():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert re.findall(r"!\[[^]]*\]\(([^)]+)\)", text) == [f"docs/figures/{FIGURES['contact'].stem}.png"]


def test_links_between_the_pages_lead_somewhere():
    for page in (ROOT / "README.md", *(ROOT / "docs").rglob("*.md")):
        for target in re.findall(r"\]\((?!https?:|#)([^)#]+)", page.read_text(encoding="utf-8")):
            path = page.parent / target
            if tutorial := re.fullmatch(r"(?:\.\./)?tutorials/(\w+)", target):  # made from the examples
                path = ROOT / "examples" / ("GALLERY_HEADER.rst" if tutorial[1] == "index" else f"{tutorial[1]}.py")
            assert path.exists(), f"{page.name}: {target}"


def test_reference_has_every_public_name():
    folder = ROOT / "docs" / "reference"
    python, modules = ((folder / f"{page}.md").read_text(encoding="utf-8") for page in ("python", "modules"))
    for name in set(softlube.__all__) - {"__version__"}:
        if inspect.ismodule(owner := getattr(softlube, name)):
            assert f"| `{name}` | {{py:mod}}`{owner.__name__}` |" in modules
            assert f"\n   {owner.__name__}\n" in modules
        else:
            assert f"\n   {name}\n" in python, name


def test_table_of_the_laws_is_what_we_find():
    """Paper's and our prefactors and exponents in docs/theory/paper-comparison.md against a fit made here."""
    text = (ROOT / "docs" / "theory" / "paper-comparison.md").read_text(encoding="utf-8")
    betas = (30.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0, 1e4)
    solutions = [softlube.solve(beta=beta, accuracy=3e-3) for beta in betas]
    for law in scaling.LAWS:
        row = next(line for line in text.splitlines() if line.startswith(f"| ({law.equation})"))
        found = [float(word) for word in re.findall(r"[-−]?\d+\.\d+", row.replace("−", "-"))]
        assert found[0] == law.prefactor
        assert found[1] == pytest.approx(law.exponent)
        ours = scaling.compare(solutions, law).fit
        # fitted to fewer and coarser solutions here
        assert found[3] == pytest.approx(ours.exponent, abs=0.004)
        assert found[2] == pytest.approx(ours.prefactor, rel=0.03)
        assert np.sign(found[6]) == np.sign(found[3] - found[1])
