"""Stribeck curves: film and friction of a rig against its speed, from the rigid to the Hertz regime."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from softlube.errors import InputError
from softlube.experiments.load_curve import LoadCurve, check_friction, load_curve
from softlube.model.quantities import header
from softlube.physical.inputs import declared
from softlube.physical.rig import Rig, hertz_force
from softlube.physical.roughness import lubrication
from softlube.physical.units import to_si
from softlube.solvers.progress import Listener

if TYPE_CHECKING:
    import pandas

WIDE = (1e-2, 1e6)
"""Range of β_load that a curve covers, as far as it can be solved, where no speeds are given."""
MOST_POINTS = 10_000


def stribeck_curve(
    rig: Rig,
    loads: object,
    *,
    slowest: object = None,
    fastest: object = None,
    points: int = 61,
    slide_to_roll: float = 2.0,
    roughness: object = None,
    force: str = "sphere",
    region: str | float = 2.0,
    accuracy: float = 3e-3,
    progress: Listener | None = None,
) -> pandas.DataFrame:
    """Film and friction against entrainment speed.

    Parameters
    ----------
    rig : Rig
        Bodies and liquid.
    loads : str, float, pint.Quantity or a sequence of them
        Normal loads.
    slowest, fastest : str, float or pint.Quantity, optional
        Ends of the range of entrainment speeds; as wide as can be solved where not given.
    points : int
        Speeds, equally far apart in logarithm.
    slide_to_roll : float
        (v₁ − v₂) over the mean of v₁ and v₂: 2 for a substrate at rest (the paper's case), 0 for pure rolling, −2 for a ball at
        rest.
    roughness : str, float or pint.Quantity, optional
        Root mean square roughness of both surfaces together, for λ.
    force : {"sphere", "total", "couette"}
        See `softlube.experiments.load_curve.LoadCurve.friction`.
    region : float or {"domain", "contact"}
        Where friction is counted, in units of the load's Hertz contact radius; see `softlube.experiments.load_curve.LoadCurve`.
    accuracy : float
        Of the solutions behind the curve.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each solution.

    Returns
    -------
    pandas.DataFrame
        A row for every load and speed: Hersey number ηUR/N, β of Eq. (30), film, friction and friction coefficient with errors
        in SI (units in the headers), and λ = film_min/roughness with the regime if a roughness is given.  nan where the contact
        is beyond what can be solved.

    Raises
    ------
    InputError
        If an input is not as described.
    NotConvergedError
        If no speed of the range can be solved.
    """
    import pandas as pd

    check_friction(force, region)
    if isinstance(slide_to_roll, (bool, str)) or not math.isfinite(slide_to_roll):
        raise InputError(f"slide_to_roll: expected a finite number such as 2, got {slide_to_roll!r}")
    if isinstance(points, bool) or not 2 <= points <= MOST_POINTS:
        raise InputError(f"points: expected a whole number from 2 to {MOST_POINTS}, got {points!r}")
    given = list(loads) if isinstance(loads, Sequence) and not isinstance(loads, str) else [loads]
    if not given:
        raise InputError("load: missing; expected a force such as '100 mN'")
    in_si = declared()["load"].read_all(given)
    ends = [None if speed is None else to_si("entrainment_speed", speed) for speed in (slowest, fastest)]
    if ends[0] is not None and ends[1] is not None and ends[0] >= ends[1]:
        raise InputError(f"slowest, fastest: expected a slower and a faster speed, got {ends[0]:g} and {ends[1]:g} m/s")
    height = None if roughness is None else to_si("roughness", roughness)

    at_unit_speed = [rig.contact(load=load, entrainment_speed=1.0).problem().parameter for load in in_si]
    wanted = [
        WIDE[0] if ends[1] is None else min(at_unit_speed) / ends[1],
        WIDE[1] if ends[0] is None else max(at_unit_speed) / ends[0],
    ]
    curve = load_curve(*wanted, region=region, cavitation=rig.cavitation, accuracy=accuracy, progress=progress)
    rows = []
    for load, beta in zip(in_si, at_unit_speed, strict=True):
        slow = beta / curve.high if ends[0] is None else ends[0]
        fast = beta / curve.low if ends[1] is None else ends[1]
        if slow >= fast:
            raise InputError(f"slowest, fastest: nothing can be solved between them at {load:g} N")
        # The quotients above may land a rounding error outside the curve.
        speeds = np.geomspace(slow, fast, points)
        betas = beta / speeds
        if ends[0] is None or ends[1] is None:
            betas = np.clip(betas, *(curve.low if ends[1] is None else 0.0, curve.high if ends[0] is None else math.inf))
        rows.append(_rows(rig, curve, load, speeds, betas, slide_to_roll, force, height))
    return pd.concat(rows, ignore_index=True)


def _rows(
    rig: Rig, curve: LoadCurve, load: float, speeds: Any, betas: Any, slide_to_roll: float, force: str, roughness: float | None
) -> pandas.DataFrame:
    import pandas as pd

    contact = rig.contact(load=load, entrainment_speed=1.0)
    friction = hertz_force(contact) * curve.friction(betas, force=force, slide_to_roll=slide_to_roll)
    # The Poiseuille part has about the error of the Couette part of pure sliding; S = 0 must not leave it without any.
    scale = hertz_force(contact) * np.abs(curve.friction(betas, force="couette"))
    error = scale * curve.relative_error("couette", betas) * max(abs(slide_to_roll) / 2, 0.1)
    data: dict[str, Any] = {
        "load [N]": np.full(speeds.size, load),
        "entrainment_speed [m/s]": speeds,
        "slide_to_roll": np.full(speeds.size, slide_to_roll),
        "hersey": rig.hersey(load, 1.0) * speeds,
        "beta_load": betas,
        "friction [N]": friction,
        "friction_error [N]": error,
        "friction_coefficient": friction / load,
        "friction_coefficient_error": error / load,
    }
    for name in ("film_center", "film_min"):
        film = contact.unit_height * getattr(curve, name)(betas)
        data[header(name, "m")] = film
        data[header(name, "m", error=True)] = film * curve.relative_error(name, betas)
    if roughness is not None:
        ratio = data["film_min [m]"] / roughness
        data["lambda_ratio"] = ratio
        data["lubrication"] = [lubrication(each) for each in ratio]
    return pd.DataFrame(data)
