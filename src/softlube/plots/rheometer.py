"""Pictures of flow curves: measured viscosities with the law through them."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np

from softlube.errors import printable
from softlube.plots.axes import label_logarithmic
from softlube.plots.experiments import COLOURS, STYLE, write

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from softlube.experiments.rheometer import LiquidFit

BEYOND = 3.0
"""Factor of the shear rate by which the law is drawn beyond the data, dashed."""


def plot_liquid(found: LiquidFit, path: str | os.PathLike[str] | None = None) -> Figure:
    """The flow curve with the law, and the residuals.

    Parameters
    ----------
    found : LiquidFit
        From `softlube.fit_liquid`.
    path : path, optional
        Written to if given (PNG, PDF, SVG by its ending).
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    data = found.model.data
    low, high = float(data.shear_rate.min()), float(data.shear_rate.max())
    with rc_context(STYLE):
        figure = Figure(figsize=(7.0, 3.0), layout="constrained")
        curve, residuals = figure.subplots(1, 2)
        curve.scatter(data.shear_rate, data.viscosity, s=12, linewidths=0, color=COLOURS[0], zorder=3, label="measured")
        for ends, style, label in (
            ((low, high), "-", found.model.candidate.words),
            ((low / BEYOND, low), "--", "beyond the data"),
            ((high, high * BEYOND), "--", None),
        ):
            rates = np.geomspace(*ends, 200)
            curve.plot(rates, found.viscosity(rates), style, color="black", lw=1, label=label)
        curve.set(xscale="log", yscale="log", xlabel="shear rate [1/s]", ylabel="viscosity [Pa s]")
        curve.legend()
        residuals.scatter(data.shear_rate, 100 * found.residuals, s=12, linewidths=0, color=COLOURS[0], zorder=3)
        residuals.axhline(0, color="black", lw=0.8)
        for side in (-2, 2):
            residuals.axhline(side * 100 * found.scatter, color="black", lw=0.8, ls=":")
        residuals.set(xscale="log", xlabel="shear rate [1/s]", ylabel="ln(measured/law) [%]")
        residuals.set_title("dotted: twice the scatter", loc="right", fontsize=7)
        for axes in (curve, residuals):
            label_logarithmic(axes)
        estimates = ", ".join(
            f"{name.replace('_', ' ')} = {e.value:.3g} {e.unit}".strip() for name, e in found.estimates.items()
        )
        figure.suptitle(f"{printable(data.source)}: {estimates}", fontsize=8, parse_math=False)
        return write(figure, path)
