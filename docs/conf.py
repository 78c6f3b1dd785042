"""How Sphinx builds the site: `sphinx-build -W --keep-going -b html docs site`, without a network."""

import os
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).parent
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(HERE / "_ext"))

from docutils import nodes  # noqa: E402

import softlube  # noqa: E402
from softlube.plots.calculator.page import page as calculator  # noqa: E402

project = "softlube"
author = "The softlube developers"
version = release = softlube.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "numpydoc",
    "sphinx_gallery.gen_gallery",
    "cyclopts.ext.sphinx",
]
nitpicky = True
exclude_patterns = ["_gallery", "_ext", "_extra"]
templates_path = ["_templates"]

html_theme = "furo"
html_title = f"softlube {release}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_copyright = False
html_copy_source = False
html_show_search_summary = False  # it fetches pages, which browsers refuse for a site that is opened as files

myst_heading_anchors = 4
myst_enable_extensions = ["deflist"]

default_role = "code"
autodoc_typehints = "none"  # the docstrings say what the arguments are
autodoc_member_order = "bysource"
numpydoc_show_class_members = False
# File names of classes that differ from a function's in the case only, which some file systems do not tell apart.
autosummary_filename_map = {f"softlube.{name}": f"softlube.{name}-class" for name in ("Fit", "Slide", "Squeeze", "Sweep")}
# Public classes have pages of their own, and the pages of modules leave them out.
described = sorted(name for name in softlube.__all__ if isinstance(getattr(softlube, name), type))
autosummary_context = {"described": ", ".join(described)}

# The calculator is a page by itself, beside the others.
(HERE / "_extra").mkdir(exist_ok=True)
(HERE / "_extra" / "calculator.html").write_text(calculator(), encoding="utf-8")
html_extra_path = ["_extra"]

# The examples run in a copy, because they write files into their folder.
shutil.rmtree(HERE / "_gallery", ignore_errors=True)
shutil.copytree(HERE.parent / "examples", HERE / "_gallery", ignore=shutil.ignore_patterns("__pycache__"))
sphinx_gallery_conf = {
    "examples_dirs": "_gallery",
    "gallery_dirs": "tutorials",
    "within_subsection_order": "tutorials.Order",
    "image_scrapers": ("tutorials.pictures",),
    "filename_pattern": r"\.py$",
    "ignore_pattern": "synthetic_friction",
    "capture_repr": (),
    "download_all_examples": False,
    "show_memory": False,
    "show_signature": False,
    "min_reported_time": 1e9,
    "write_computation_times": False,
    "abort_on_example_error": True,
    "plot_gallery": True,
    "reset_modules": (),
}


def escape_bars(app, what, name, obj, options, lines):
    """Absolute values in docstrings: reStructuredText takes |h₀| for a substitution."""
    lines[:] = [line if "``" in line or line.lstrip().startswith(">>>") else line.replace("|", r"\|") for line in lines]


def no_links_to_examples(app, doctree):
    """Addresses of schedulers in help texts are examples, of which docutils makes links."""
    for link in list(doctree.findall(nodes.reference)):
        if link.get("refuri", "").startswith("tcp:"):
            link.replace_self(link.children)


def setup(app):
    """Connect what the extensions leave to this site."""
    app.connect("autodoc-process-docstring", escape_bars, priority=900)  # after numpydoc
    app.connect("doctree-read", no_links_to_examples)
