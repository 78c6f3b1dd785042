"""Axes that can be read: labels of short logarithmic axes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SHORT = {1.0: (1.0, 2.0, 3.0, 5.0), 1.7: (1.0, 2.0, 5.0)}
"""Digits that are labelled on an axis of fewer decades, in plain numbers; of more, powers of ten only."""


def label_logarithmic(ax: Axes) -> None:
    """Label logarithmic axes whose ends are set: at powers of ten, and at multiples of these where there are few."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    for axis, scale, ends in ((ax.xaxis, ax.get_xscale(), ax.get_xlim()), (ax.yaxis, ax.get_yscale(), ax.get_ylim())):
        if scale != "log":
            continue
        axis.set_minor_formatter(NullFormatter())
        decades = abs(np.log10(ends[1] / ends[0]))
        digits = next((digits for most, digits in SHORT.items() if decades < most), None)
        if digits is not None:
            axis.set_major_locator(LogLocator(subs=digits))
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
