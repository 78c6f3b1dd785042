"""Fig. 11 and the flow in the gap."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from softlube.paper.figures.base import (
    LINES,
    OKABE_ITO,
    TWO_COLUMNS,
    Case,
    Drawn,
    FigureSpec,
    Solutions,
    Statement,
    Table,
    canvas,
    letters,
    styled,
)
from softlube.plots.flow import picture
from softlube.readout import flow

SHOWN = 1000.0
"""β of the flow's pictures; the paper does not say that of its Fig. 11."""


@styled
def averages(solutions: Solutions) -> Drawn:
    """Fig. 11: average velocities on the rings r = 0.5 and r = 1."""
    solution = solutions[Case(SHOWN)]
    degrees = np.linspace(0, 360, 721)
    figure, axes = canvas(TWO_COLUMNS, 2.7, 1, 2, sharex=True)
    columns: dict[str, NDArray[np.floating]] = {"theta [deg]": degrees}
    rings = {}
    for radius, colour, line in zip((0.5, 1.0), OKABE_ITO, LINES, strict=False):
        v_r, v_t = flow.mean_velocity(solution, radius, np.radians(degrees))
        rings[radius] = v_r, v_t
        for ax, values in zip(axes[0], (v_r, v_t), strict=True):
            ax.plot(degrees, values, color=colour, ls=line, label=rf"$r={radius:g}$")
        columns[f"v_r at r = {radius:g} [v]"], columns[f"v_theta at r = {radius:g} [v]"] = v_r, v_t
    axes[0, 0].set_ylabel(r"radial velocity $\langle v_r\rangle/v$")
    axes[0, 1].set_ylabel(r"swirl velocity $\langle v_\theta\rangle/v$")
    for ax in axes[0]:
        ax.set(xlabel=r"angle from the inlet $\theta$ [°]", xlim=(0, 360), xticks=[0, 90, 180, 270, 360])
    axes[0, 0].legend(frameon=False, loc="upper center")
    letters(axes[0])
    entering, leaving = (float(abs(rings[1.0][0][k] - np.cos(np.radians(degrees[k])))) for k in (0, 360))
    inner_in, inner_out = (float(abs(rings[0.5][0][k] - np.cos(np.radians(degrees[k])))) for k in (0, 360))
    swirl = rings[1.0][1]
    top = float(degrees[np.argmax(np.abs(swirl[:361]))])
    away = float(np.max(np.abs(swirl + 0.5 * np.sin(np.radians(degrees)))))
    inner = float(np.max(np.abs(rings[0.5][1] + 0.5 * np.sin(np.radians(degrees)))))
    return Drawn(
        figure,
        [Table("rings", columns)],
        [
            Statement(
                "On r = 1 the flow enters more slowly than it leaves, because the film is thicker at the intake.",
                f"relative to the sphere: in with {entering:.3f} v, out with {leaving:.3f} v",
            ),
            Statement(
                "On r = 0.5 entering and leaving velocities are practically the same.",
                f"in with {inner_in:.3f} v, out with {inner_out:.3f} v",
            ),
            Statement(
                "The swirl velocity is a sine, largest at θ = π/2, and nearly the same on both rings.",
                f"on r = 1 largest at {top:.0f}° and off −(1/2) sin θ by at most {away:.3f} v; on r = 0.5 by {inner:.3f} v",
                "90°",
                f"{top - 90:+.0f}°".replace("-", "−"),
                "agrees" if abs(top - 90) < 10 else "disagrees",
                "" if abs(top - 90) < 10 else "The free boundary behind the contact distorts the sine on r = 1.",
            ),
        ],
    )


def streamlines(solutions: Solutions) -> Drawn:
    """Streamlines in the plane and in the vertical mid-plane, and shear on the walls."""
    solution = solutions[Case(SHOWN)]
    figure, columns = picture(solution)
    tables = [Table(name, data) for name, data in columns.items()]
    gap = abs(flow.net_flux(solution, 0.9))
    r, theta = np.meshgrid(np.linspace(0, 2, 41), np.linspace(0, np.pi, 37), indexing="ij")
    slips = []
    for height, speed in ((flow.substrate_height(solution, r, theta), 0.0), (flow.sphere_height(solution, r), 1.0)):
        v_r, v_t = flow.velocity(solution, r, theta, z=height)
        slips.append(float(np.max(np.abs(v_r - speed * np.cos(theta)) + np.abs(v_t + speed * np.sin(theta)))))
    turning = _highest_entering(solution)
    return Drawn(
        figure,
        tables,
        [
            Statement("No slip on either wall.", f"largest slip {max(slips):g} v", "0", verdict="agrees"),
            Statement("Liquid is conserved.", f"net flux through r = 0.9 over the flux into it: {gap:.0e}", "0"),
            Statement(
                "How much of the liquid enters.",
                f"at x = 1.5 only the lowest {100 * turning:.1f} % of the film goes under the sphere; the rest turns round "
                f"before it",
                verdict="more",
                remark="The flow in front of the intake is a vortex under the advancing sphere, seen from it.",
            ),
        ],
    )


def _highest_entering(solution) -> float:
    """Level at x = 1.5 that separates what enters the contact from what turns back, by following streamlines."""
    low, high = 0.0, 1.0
    for _ in range(2):
        levels = np.linspace(low, high, 26)[1:-1]
        lines = flow.section_streamlines(solution, [(1.5, level) for level in levels])
        enters = [line[-1, 0] < 0 for line in lines]
        low, high = (
            max((v for v, e in zip(levels, enters, strict=True) if e), default=low),
            min((v for v, e in zip(levels, enters, strict=True) if not e), default=high),
        )
    return low


FIGURES = (
    FigureSpec(
        "11",
        "Average velocities on two rings",
        "Velocity averaged through the film at β = 1000, frame of the substrate: radial (a), swirl (b).",
        (Case(SHOWN),),
        averages,
    ),
    FigureSpec(
        "flow",
        "Flow in the gap",
        "β = 1000, frame of the sphere. Streamlines of the mean flow over its speed (a; grey: broken film), streamlines in "
        "the vertical mid-plane, "
        "where the height is a share of the film (b), shear stress on sphere and substrate along x (c) and y (d). Inlet on "
        "the right.",
        (Case(SHOWN),),
        streamlines,
    ),
)
