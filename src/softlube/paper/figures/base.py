"""What every figure is made of: the cases it needs, the picture, the data behind it, and what it shows beside the paper."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from softlube.model.problem import Cavitation
from softlube.model.quantities import FIELDS
from softlube.plots.solution import STYLE, over_unit
from softlube.steady.solution import Solution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.floating]

ONE_COLUMN, TWO_COLUMNS = 3.4, 6.9
"""Widths of a picture in inches, as journals print them."""


# --- cases ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, order=True)
class Case:
    """One contact to solve: β and the cavitation condition, or the README's ball on rubber."""

    beta: float
    cavitation: Cavitation = "reynolds"
    physical: bool = False

    @property
    def name(self) -> str:
        """Name of its file."""
        if self.physical:
            return "ball-on-rubber"
        return f"beta-{self.beta:g}" + ("" if self.cavitation == "reynolds" else "-full-film")

    @property
    def accuracy(self) -> float:
        """Accuracy asked for: finer than the default where fields are drawn, coarser for the dear last points of a curve."""
        if self.cavitation == "none":
            return 1e-2
        if self.beta in PROFILES:
            return 6e-4
        return 1e-3 if self.beta <= 1e4 else 5e-3


BALL_ON_RUBBER = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "0.1 mm/s", "load": "100 mN"}
"""The contact of the README: the paper's glass ball on PDMS in silicone oil."""
CONTACT = Case(1.6e4, physical=True)

PROFILES = (100.0, 200.0, 500.0, 1000.0)
"""β of the paper's profiles, Figs. 5, 6 and 8."""
MAPS = (100.0, 300.0, 500.0, 1000.0)
"""β of the paper's contours, Fig. 9."""
FITTED = (100.0, 200.0, 300.0, 500.0, 1000.0, 2000.0, 3000.0, 5000.0, 1e4)
"""β over the range of the paper's fits."""
WIDE = (10.0, 30.0, *FITTED, 3e4, 1e5)
"""β of `FITTED`, and a decade to either side."""

Solutions = Mapping[Case, Solution]


def reynolds(betas: Sequence[float]) -> tuple[Case, ...]:
    """Cases with the Reynolds condition."""
    return tuple(Case(beta) for beta in betas)


def chosen(solutions: Solutions, betas: Sequence[float]) -> list[Solution]:
    """Solutions with the Reynolds condition at the given β."""
    return [solutions[Case(beta)] for beta in betas]


# --- what a figure gives --------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Table:
    """Data behind a picture: named columns of equal length, numbers or text."""

    name: str
    columns: Mapping[str, Sequence[float | str] | Array]

    def write(self, path: Path) -> None:
        """Write as CSV, whole or not at all."""
        import csv
        import io

        from softlube.files.writing import write_whole

        stream = io.StringIO(newline="")
        writer = csv.writer(stream)
        writer.writerow(self.columns)
        for row in zip(*self.columns.values(), strict=True):
            writer.writerow([cell if isinstance(cell, str) else f"{float(cell):.8g}" for cell in row])
        write_whole({path: stream.getvalue().encode()})


Verdict = Literal["agrees", "disagrees", "more"]


@dataclass(frozen=True)
class Statement:
    """One thing that the paper says or prints, and what is found here.

    Attributes
    ----------
    claim : str
        The paper's statement, or what is compared.
    paper, ours, difference : str
        The two numbers and how far they are apart; empty where there is none.
    verdict : {"agrees", "disagrees", "more"}
        "more" for what the paper does not have.
    remark : str
        A sentence; always given where they disagree.
    """

    claim: str
    ours: str
    paper: str = ""
    difference: str = ""
    verdict: Verdict = "agrees"
    remark: str = ""

    def __post_init__(self) -> None:
        if self.verdict == "disagrees" and not self.remark:
            raise ValueError(f"a disagreement needs a sentence: {self.claim}")


@dataclass(frozen=True)
class Drawn:
    """A figure, drawn: the picture, the data behind it, what it shows."""

    figure: Figure
    tables: Sequence[Table]
    statements: Sequence[Statement] = field(default=())


@dataclass(frozen=True)
class FigureSpec:
    """One figure of the paper, or one beyond it.

    Attributes
    ----------
    key : str
        "5" … "13" as in the paper, "S1" … for the supporting information, a word for those beyond.
    title, caption : str
        What it shows.
    cases : tuple of Case
        What must be solved for it.
    draw : callable
        From the solutions to `Drawn`; Fig. 13 also takes data.
    """

    key: str
    title: str
    caption: str
    cases: tuple[Case, ...]
    draw: Callable[..., Drawn]

    @property
    def stem(self) -> str:
        """Name of its files."""
        return f"figure-{self.key}" if self.key[0].isdigit() or self.key[0] == "S" else self.key

    @property
    def heading(self) -> str:
        """Heading in the report."""
        if self.key[0].isdigit():
            return f"Figure {self.key}. {self.title}"
        return f"Supporting information: {self.title}" if self.key[0] == "S" else self.title


# --- drawing --------------------------------------------------------------------------------------------------------

BLACK, GREY = "#000000", "0.35"
OKABE_ITO = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Colours that colour-blind readers tell apart (Okabe & Ito 2008)."""
MARKERS = ("o", "s", "^", "D", "v", "P")
LINES = ("-", "--", "-.", (0, (5, 1.5, 1, 1.5, 1, 1.5)), (0, (1, 1.2)))
"""Line styles, so that curves differ without colour as well."""

LENGTH = over_unit("r")
FILM = f"film ${FIELDS['film'].symbol}{over_unit('film')}$"
PRESSURE = f"{FIELDS['pressure'].words} ${FIELDS['pressure'].symbol}{over_unit('pressure')}$"
BETA = r"$\beta$"


def canvas(width: float, height: float, rows: int = 1, columns: int = 1, **options) -> tuple[Figure, NDArray]:
    """A figure with the house's style and its axes as an array."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure, figure.subplots(rows, columns, squeeze=False, **options)


def styled(draw: Callable[..., Drawn]) -> Callable[..., Drawn]:
    """Draw with the house's style, without touching the caller's."""
    from functools import wraps

    @wraps(draw)
    def inner(*arguments, **options) -> Drawn:
        import matplotlib as mpl

        with mpl.rc_context(STYLE):
            drawn = draw(*arguments, **options)
            # Text is laid out when drawn, with the style of that moment.
            drawn.figure.canvas.draw()
        return drawn

    return inner


def letters(axes: Sequence[Axes]) -> None:
    """(a), (b), … over the axes."""
    for letter, ax in zip("abcdefgh", axes, strict=False):
        ax.set_title(f"({letter})", loc="left")


def beta_text(beta: float) -> str:
    """Label of a curve."""
    exponent = int(np.floor(np.log10(beta) + 1e-9))
    if exponent < 4:
        return rf"$\beta$ = {beta:g}"
    mantissa = beta / 10**exponent
    return rf"$\beta = 10^{exponent}$" if abs(mantissa - 1) < 1e-9 else rf"$\beta = {mantissa:g}\times10^{exponent}$"


def beta_colours(n: int) -> list[str]:
    """Colours in the order of β, dark to light, even in lightness for every reader."""
    from matplotlib import colormaps
    from matplotlib.colors import to_hex

    return [to_hex(colormaps["viridis"](x)) for x in np.linspace(0.0, 0.82, n)]


def diameter(solution: Solution, reach: float) -> Array:
    """Places along a diameter from −reach to reach, dense where the grid is."""
    nodes = solution.fields.r
    fine = np.interp(np.arange(0, nodes.size - 1, 0.125), np.arange(nodes.size), nodes)
    fine = np.concatenate([[0.0], fine[fine < reach], [reach]])
    return np.concatenate([-fine[::-1], fine[1:]])


def along(solution: Solution, direction: str, reach: float) -> tuple[Array, Array, Array]:
    """Places along the x or y axis with their polar coordinates."""
    place = diameter(solution, reach)
    theta = np.where(place >= 0, 0.0, np.pi) if direction == "x" else np.full(place.size, np.pi / 2)
    return place, np.abs(place), theta


def percent(ratio: float) -> str:
    """A ratio as a signed difference in per cent."""
    return f"{100 * (ratio - 1):+.1f} %".replace("-", "−")


def number(value: float, digits: int = 4) -> str:
    """A number for a reader, with a true minus sign."""
    return f"{value:.{digits}g}".replace("-", "−")
