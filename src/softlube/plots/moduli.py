"""Pictures of tests of viscoelastic solids: moduli or compliances with the Prony series through them."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np

from softlube.errors import printable
from softlube.experiments.moduli import COLUMNS
from softlube.plots.axes import label_logarithmic
from softlube.plots.experiments import COLOURS, STYLE, write

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from softlube.experiments.substrate_fit import SubstrateFit

BEYOND = 10.0
"""Factor of frequency or time by which the series is drawn beyond the data, dashed."""


def plot_substrate(found: SubstrateFit, path: str | os.PathLike[str] | None = None) -> Figure:
    """The test with the series, whose times are marked, and the residuals.

    Parameters
    ----------
    found : SubstrateFit
        From `softlube.fit_substrate`.
    path : path, optional
        Written to if given (PNG, PDF, SVG by its ending).
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    data, where = found.data, found.data.where
    low, high = float(where.min()), float(where.max())
    label = "angular frequency [rad/s]" if data.procedure.rates else "time [s]"
    unit = COLUMNS[data.procedure.measured[0]].unit
    with rc_context(STYLE):
        figure = Figure(figsize=(7.0, 3.0), layout="constrained")
        curve, residuals = figure.subplots(1, 2)
        for number, (name, measured) in enumerate(data.values.items()):
            colour = COLOURS[number]
            curve.scatter(where, measured, s=12, linewidths=0, color=colour, zorder=3, label=name.replace("_", " "))
            for ends, style in (((low, high), "-"), ((low / BEYOND, low), "--"), ((high, high * BEYOND), "--")):
                places = np.geomspace(*ends, 200)
                curve.plot(places, found.predicted(places)[name], style, color=colour, lw=1)
            off = 100 * found.series.residuals[name]
            residuals.scatter(where, off, s=12, linewidths=0, color=colour, zorder=3)
        for time in found.series.times:
            place = 1 / time if data.procedure.rates else time
            curve.axvline(place, ymax=0.04, color="black", lw=1)
        curve.set(xscale="log", yscale="log", xlabel=label, ylabel=f"{found.symbol} [{unit}]")
        curve.set_title("dashed: beyond the data; ticks: times of the series", loc="right", fontsize=7)
        curve.legend()
        residuals.axhline(0, color="black", lw=0.8)
        residuals.set(xscale="log", xlabel=label, ylabel="1 - series/measured [%]")
        for axes in (curve, residuals):
            label_logarithmic(axes)
        figure.suptitle(f"{printable(data.source)}: {found.headline.partition(': ')[2]}", fontsize=8, parse_math=False)
        return write(figure, path)
