"""The calculator's page: template, styles, bundled scripts and the exported tables in one file."""

from __future__ import annotations

import json
import re
from importlib import resources

from softlube.model.inputs import Input
from softlube.physical.inputs import SLIDING_BODIES, Loading, names_of
from softlube.plots.calculator.export import exported

FOLDER = "web"


def page() -> str:
    """The page as HTML: it refers to nothing outside itself.

    Examples
    --------
    >>> page().startswith("<!DOCTYPE html>")
    True
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined
    from markupsafe import Markup

    files = resources.files("softlube.plots.calculator").joinpath(FOLDER)

    def part(name: str) -> Markup:
        return Markup(files.joinpath(name).read_text(encoding="utf-8").strip())

    declared = names_of(SLIDING_BODIES, Loading)
    data = exported()
    environment = Environment(
        loader=PackageLoader("softlube.plots.calculator", FOLDER),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    text = environment.get_template("page.html.jinja").render(
        data=data,
        derived={row["name"]: row for row in data["derived"]},
        json=Markup(embedded(data)),
        styles=part("bundle.css") + "\n" + part("page.css"),
        script=part("bundle.js"),
        words=lambda name, end="": short_words(declared[name]).removesuffix(end),
        percent=lambda share: f"{100 * share:g} %",
    )
    return text.lstrip() + "\n"


def embedded(data: object) -> str:
    """JSON that ends no script element."""
    return json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace("</", "<\\/")


def short_words(declared: Input) -> str:
    """An input's words as the label of a field: up to a comma, a colon or a semicolon, and without "instead".

    Examples
    --------
    >>> from softlube.physical.inputs import declared
    >>> short_words(declared()["shear_modulus"])
    'Shear modulus'
    """
    return re.split("[,:;]", declared.words)[0].removesuffix(" instead")
