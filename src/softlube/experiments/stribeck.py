"""Stribeck curves: film and friction of a rig against its speed, from the rigid to the Hertz regime."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from softlube.errors import InputError, ValidityWarning
from softlube.experiments.load_curve import ACCURACY, FILMS, LoadCurve, check_friction, load_curves
from softlube.model.motions import FIXED_BALL, Sliding
from softlube.model.quantities import header
from softlube.physical.contact import Contact
from softlube.physical.inputs import declared
from softlube.physical.rig import Rig
from softlube.physical.roughness import lubrication
from softlube.physical.units import to_si
from softlube.solvers.progress import Listener

if TYPE_CHECKING:
    import pandas

WIDE = (1e-2, 1e6)
"""Range of β_load that a curve covers, as far as it can be solved, where no speeds are given."""
MOST_POINTS = 10_000


def stribeck_curve(
    contact: Contact | Rig,
    loads: object = None,
    *,
    slowest: object = None,
    fastest: object = None,
    points: int = 61,
    slide_to_roll: float | None = None,
    roughness: object = None,
    force: str = "total",
    region: str | float = 2.0,
    accuracy: float = ACCURACY,
    progress: Listener | None = None,
) -> pandas.DataFrame:
    """Film and friction against entrainment speed.

    Parameters
    ----------
    contact : Contact or Rig
        Bodies and liquid; the speed of a contact counts for nothing.
    loads : str, float, pint.Quantity or a sequence of them, optional
        Normal loads; the contact's own if not given.
    slowest, fastest : str, float or pint.Quantity, optional
        Ends of the range of entrainment speeds; as wide as can be solved where not given.
    points : int
        Speeds, equally far apart in logarithm.
    slide_to_roll : float, optional
        Difference of the surface speeds over their mean: 2 for a ball that does not turn (the paper's case), 0 for pure
        rolling; the contact's own if not given.
    roughness : str, float or pint.Quantity, optional
        Root mean square roughness of both surfaces together, for λ; the contact's own if not given.
    force : {"total", "sphere", "couette"}
        See `softlube.experiments.load_curve.LoadCurve.friction`.
    region : float or {"domain", "contact"}
        Where friction is counted, in radii of the dry contact; see `softlube.experiments.load_curve.LoadCurve`.
    accuracy : float
        Of the solutions behind the curve, and of what is interpolated between them.
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
    if slide_to_roll is None:
        slide_to_roll = contact.slide_to_roll if isinstance(contact, Contact) else FIXED_BALL
    if isinstance(slide_to_roll, (bool, str)) or not math.isfinite(slide_to_roll):
        raise InputError(f"slide_to_roll: expected a finite number such as 2, got {slide_to_roll!r}")
    if isinstance(points, bool) or not 2 <= points <= MOST_POINTS:
        raise InputError(f"points: expected a whole number from 2 to {MOST_POINTS}, got {points!r}")
    own = contact.load if isinstance(contact, Contact) else None
    given = own if loads is None else loads
    given = list(given) if isinstance(given, Sequence) and not isinstance(given, str) else [given]
    if not given or given == [None]:
        raise InputError("load: missing; expected a force such as '100 mN'")
    in_si = declared()["load"].read_all(given)
    ends = [None if speed is None else to_si("entrainment_speed", speed) for speed in (slowest, fastest)]
    if ends[0] is not None and ends[1] is not None and ends[0] >= ends[1]:
        raise InputError(f"slowest, fastest: expected a slower and a faster speed, got {ends[0]:g} and {ends[1]:g} m/s")
    height = contact.roughness if roughness is None and isinstance(contact, Contact) else roughness
    height = None if height is None else to_si("roughness", height)

    at_unit_speed = [_under(contact, load) for load in in_si]
    problems = [each.problem() for each in at_unit_speed]
    slow_beta = None if ends[0] is None else [problem.parameter / ends[0] for problem in problems]
    fast_beta = None if ends[1] is None else [problem.parameter / ends[1] for problem in problems]
    wanted = [
        (problem, WIDE[0] if fast_beta is None else fast_beta[i], WIDE[1] if slow_beta is None else slow_beta[i])
        for i, problem in enumerate(problems)
    ]
    # Where both ends are given the rows are known beforehand, and the solutions are placed at rows.
    slow, fast = ends
    known = None if slow is None or fast is None else np.geomspace(slow, fast, points)
    read = [] if known is None else [(problem.parameter / known).tolist() for problem in problems]
    curves = load_curves(wanted, rows=read, region=region, accuracy=accuracy, progress=progress)
    rows = []
    for load, each, curve in zip(in_si, at_unit_speed, curves, strict=True):
        beta = each.problem().parameter
        slow = beta / curve.high if ends[0] is None else ends[0]
        fast = beta / curve.low if ends[1] is None else ends[1]
        if slow >= fast:
            raise InputError(f"slowest, fastest: nothing can be solved between them at {load:g} N")
        speeds = np.geomspace(slow, fast, points)
        rows.append(_rows(each, curve, load, speeds, _inside(beta / speeds, curve), slide_to_roll, force, height))
    table = pd.concat(rows, ignore_index=True)
    for doubt in doubts(contact, table):
        warnings.warn(doubt, ValidityWarning, stacklevel=2)
    return table


def doubts(contact: Contact | Rig, table: pandas.DataFrame) -> tuple[str, ...]:
    """What is in doubt about a table of `stribeck_curve`: at each load, where the friction is greatest."""
    found = []
    for load, rows in table.groupby("load [N]", sort=False):
        solved = rows[rows["friction [N]"].notna()]
        if solved.empty:
            continue
        newtons = float(str(load))
        worst = int(solved["friction [N]"].abs().argmax())
        friction, speed = (float(solved[name].iloc[worst]) for name in ("friction [N]", "entrainment_speed [m/s]"))
        under = _under(contact, newtons)
        here = under.width_doubt(under.dry_radius)
        here += [f"at {speed:.3g} m/s {each}" for each in under.traction_doubt(friction, newtons, under.dry_radius)]
        found += [f"load {newtons:.4g} N: {each}" for each in here]
    return tuple(found)


def _under(contact: Contact | Rig, load: float) -> Contact:
    """The contact under another load, with an entrainment speed of 1 m/s."""
    if isinstance(contact, Rig):
        return contact.contact(load=load, entrainment_speed=1.0)
    return Contact(**vars(contact) | {"load": load, "indentation": None, "motion": Sliding(2.0)})


def _inside(beta: Any, curve: LoadCurve) -> Any:
    """β, which may lie a rounding error outside the curve where a speed is that of its end."""
    near = np.clip(beta, curve.low, curve.high)
    return np.where(np.isclose(near, beta, rtol=1e-12, atol=0), near, beta)


def _rows(
    contact: Contact,
    curve: LoadCurve,
    load: float,
    speeds: Any,
    betas: Any,
    slide_to_roll: float,
    force: str,
    roughness: float | None,
) -> pandas.DataFrame:
    import pandas as pd

    scales = contact.scales(contact.unit_height)
    friction, error = (scales["friction"][0] * each for each in curve.friction(betas, force=force, slide_to_roll=slide_to_roll))
    data: dict[str, Any] = {
        "load [N]": np.full(speeds.size, load),
        "entrainment_speed [m/s]": speeds,
        "slide_to_roll": np.full(speeds.size, slide_to_roll),
        "hersey": contact.viscosity * contact.reduced_radius / load * speeds,
        "beta_load": betas,
        "friction [N]": friction,
        "friction_error [N]": error,
        "friction_coefficient": friction / load,
        "friction_coefficient_error": error / load,
    }
    for name in FILMS:
        film, error = (scales["height"][0] * each for each in curve.film(name, betas))
        data[header(name, "m")] = film
        data[header(name, "m", error=True)] = error
    if roughness is not None:
        ratio = data["film_min [m]"] / roughness
        data["lambda_ratio"] = ratio
        data["lubrication"] = [lubrication(each) for each in ratio]
    return pd.DataFrame(data)
