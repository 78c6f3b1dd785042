"""``softlube flow``: pictures of the flow in the gap.  Heavy imports live inside."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from cyclopts import Parameter

from softlube.cli.echo import echo, understood
from softlube.cli.inputs import GIVEN, PHYSICAL, one_contact, takes
from softlube.cli.numbers import CHOICE, FLOAT, Cavitation
from softlube.errors import printable
from softlube.physical.inputs import SLIDING_BODIES, Loading


@takes((PHYSICAL, SLIDING_BODIES, Loading))
def flow(
    *,
    plot: str,
    level: Annotated[float | None, FLOAT] = None,
    solution: Annotated[str | None, Parameter(group=GIVEN)] = None,
    beta: Annotated[float | None, FLOAT, Parameter(group=GIVEN)] = None,
    cavitation: Annotated[Cavitation | None, CHOICE, Parameter(group=GIVEN)] = None,
    **physical: str,
) -> int:
    """Draw streamlines, velocities and wall shear in the film of one contact.

    Give --solution (a file of `softlube solve --output`), --beta, or a physical contact.

    Parameters
    ----------
    plot
        Picture to write (.png, .pdf or .svg).
    level
        Level of the film for the streamlines in the plane, 0 (substrate) to 1 (sphere) [default: mean flow].
    solution
        NetCDF file written by `softlube solve --output`.
    beta
        β = (2/3)(h0²/R) πG/(ηv) of a dimensionless contact.
    cavitation
        "reynolds" (no negative pressure) or "none".
    **physical
        Inputs of the experiment, as they are declared.
    """
    import numpy as np
    from rich.console import Console

    from softlube.cli.progress import status_line
    from softlube.errors import InputError
    from softlube.files.writing import check_destination, write_whole
    from softlube.plots.flow import picture
    from softlube.plots.solution import check_format, image
    from softlube.readout.flow import flux, net_flux, shear_stress

    check_format("plot", plot)
    check_destination("plot", plot)
    if level is not None and not 0 <= level <= 1:
        raise InputError(f"level: expected a share of the film between 0 (substrate) and 1 (sphere), got {level!r}")
    with status_line("solving") as show:
        solved = one_contact(physical, solution=solution, beta=beta, cavitation=cavitation, progress=show)
        show("drawing")
        figure, _ = picture(solved, level=level)
        write_whole({plot: image(figure, plot)})

    angle = np.linspace(0, np.pi / 2, 181)
    inflow = -2 * float(np.trapezoid(flux(solved, 1.0, angle)[0], angle))
    r, theta = np.meshgrid(np.linspace(0, 1.2, 481), np.linspace(0, np.pi, 181), indexing="ij")
    sphere, substrate = (float(np.max(np.abs(shear_stress(solved, r, theta, level=wall)[0]))) for wall in (1.0, 0.0))
    console = Console(highlight=False, soft_wrap=True)
    given: Mapping[str, object] = physical or {"beta": beta}
    if solution is not None:
        name = "beta_load" if solved.problem.load_controlled else "beta"
        given = {name: solved.problem.parameter} if solved.contact is None else solved.contact.inputs()
    console.print(echo(understood(given)), markup=False)
    console.print(f"β = {solved.problem.parameter:.5g}, in the frame of the sphere", markup=False)
    unit = "δ" if solved.problem.load_controlled else "|h0|"
    units = (f"v {unit} a", f"ηv/{unit}")
    if solved.contact is not None:
        contact, height = solved.contact, solved.contact.unit_height
        inflow *= contact.speed_sum * height * contact.unit_length
        scale = contact.viscosity * contact.speed_sum / height
        sphere, substrate, units = sphere * scale, substrate * scale, ("m³/s", "Pa")
    console.print(f"flux into the contact r ≤ a over its front half: {inflow:.4g} {units[0]}", markup=False)
    console.print(
        f"largest shear stress: {sphere:.4g} {units[1]} on the sphere, {substrate:.4g} on the substrate", markup=False
    )
    console.print(f"net flux out of r ≤ 0.9 a over the flux into it: {net_flux(solved, 0.9):.1e}", markup=False)
    console.print(f"Wrote {printable(plot)}", markup=False)
    return 0
