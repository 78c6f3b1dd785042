"""Stribeck curves: film and friction of a rig against its speed, from the rigid to the Hertz regime."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from softlube.errors import InputError, warn
from softlube.experiments.load_curve import ACCURACY, FILMS, LoadCurve, check_friction, load_curves
from softlube.model.motions import FIXED_BALL, Rolling
from softlube.model.quantities import header
from softlube.model.summary import MOST_ROWS, Row, Summary, spread
from softlube.physical.contact import Contact
from softlube.physical.inputs import declared
from softlube.physical.rig import Rig
from softlube.physical.roughness import lubrication
from softlube.physical.units import to_si
from softlube.solvers.notebook import watched
from softlube.solvers.progress import Listener

WIDE = (1e-2, 1e6)
"""Range of β_load that a curve covers, as far as it can be solved, where no speeds are given."""
MOST_POINTS = 10_000
SHOWN = {
    "speed mm/s": ("entrainment_speed [m/s]", 1e3, 4),
    "Hersey": ("hersey", 1.0, 3),
    "β": ("beta_load", 1.0, 4),
    "friction": ("friction_coefficient", 1.0, 4),
    "centre nm": ("film_center [m]", 1e9, 4),
    "least nm": ("film_min [m]", 1e9, 4),
    "λ": ("lambda_ratio", 1.0, 3),
}
"""Columns that are printed: the table's, the factor to the unit in the head, and the digits."""


class StribeckCurve(pd.DataFrame):
    """A table with a row for every load and speed, which a notebook shows in short; see `stribeck_curve`."""

    @property
    def headline(self) -> str:
        """How many loads and speeds there are, and their range."""
        loads, speeds = self["load [N]"], self["entrainment_speed [m/s]"]
        ends = f"{1e3 * speeds.min():.4g} to {1e3 * speeds.max():.4g} mm/s"
        return f"Stribeck curve: {len(self)} rows, {loads.nunique()} loads, {ends}"

    def summary(self) -> Summary:
        """Friction coefficient and films at some speeds of each load."""
        loads = self["load [N]"].unique()
        most = max(MOST_ROWS // len(loads), 2)
        head, rows = printed(self)
        in_mN = [f"{1e3 * load:.4g}" for load in self["load [N]"]]
        shown = [
            (in_mN[row], *rows[row])
            for load in loads[:MOST_ROWS]
            for rank in [np.flatnonzero(self["load [N]"] == load)]
            for row in rank[spread(rank.size, most)]
        ]
        notes = (f"{len(shown)} of {len(self)} rows",) if len(shown) < len(self) else ()
        return Summary(self.headline, ("load mN", *head), tuple(shown), notes)

    def to_dataframe(self) -> pd.DataFrame:
        """The table as a plain DataFrame."""
        return pd.DataFrame(self)

    def _repr_html_(self) -> str:
        return self.summary()._repr_html_()


def printed(table: pd.DataFrame) -> tuple[Row, list[Row]]:
    """Heads and rows of a table of `stribeck_curve` as texts, without errors; "-" where nothing could be solved."""
    columns = {head: column for head, column in SHOWN.items() if column[0] in table}
    cells = [
        ["-" if value != value else f"{factor * value:.{digits}g}" for value in table[name]]
        for name, factor, digits in columns.values()
    ]
    return tuple(columns), list(zip(*cells, strict=True))


@watched
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
) -> StribeckCurve:
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
    StribeckCurve
        A `pandas.DataFrame` with a row for every load and speed: Hersey number ηUR/N, β of Eq. (30), film, friction and
        friction coefficient with errors in SI (units in the headers), and λ = film_min/roughness with the regime if a
        roughness is given.  nan where the contact is beyond what can be solved.

    Raises
    ------
    InputError
        If an input is not as described.
    NotConvergedError
        If no speed of the range can be solved.
    """
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

    at_unit_speed = [_under(contact, load, slide_to_roll) for load in in_si]
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
    table = StribeckCurve(pd.concat(rows, ignore_index=True))
    warn(doubts(contact, table))
    return table


def doubts(contact: Contact | Rig, table: pd.DataFrame) -> tuple[str, ...]:
    """What is in doubt about a table of `stribeck_curve`: at each load, where the friction is greatest."""
    found = []
    for load, rows in table.groupby("load [N]", sort=False):
        solved = rows[rows["friction [N]"].notna()]
        if solved.empty:
            continue
        newtons = float(str(load))
        worst = int(solved["friction [N]"].abs().argmax())
        friction, speed = (float(solved[name].iloc[worst]) for name in ("friction [N]", "entrainment_speed [m/s]"))
        under = _under(contact, newtons, float(solved["slide_to_roll"].iloc[worst]))
        here = under.width_doubt(under.dry_radius)
        here += [f"at {speed:.3g} m/s {each}" for each in under.traction_doubt(friction, newtons, under.dry_radius)]
        found += [f"load {newtons:.4g} N: {each}" for each in here]
    return tuple(found)


def _under(contact: Contact | Rig, load: float, slide_to_roll: float) -> Contact:
    """The contact under another load, with an entrainment speed of 1 m/s."""
    motion = Rolling(1.0, slide_to_roll=slide_to_roll)
    if isinstance(contact, Rig):
        contact = contact.contact(load=load, entrainment_speed=1.0)
    return Contact(**vars(contact) | {"load": load, "indentation": None, "motion": motion})


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
) -> pd.DataFrame:
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
    if "viscous" in curve.functions and force == "total":
        whole, viscous = (curve.functions[name](betas)[0] * scales["friction"][0] for name in ("total", "viscous"))
        data["friction_hysteresis [N]"] = whole - viscous
        data["friction_viscous [N]"] = friction - (whole - viscous)
    for name in FILMS:
        film, error = (scales["height"][0] * each for each in curve.film(name, betas))
        data[header(name, "m")] = film
        data[header(name, "m", error=True)] = error
    if roughness is not None:
        ratio = data["film_min [m]"] / roughness
        data["lambda_ratio"] = ratio
        data["lubrication"] = [lubrication(each) for each in ratio]
    return pd.DataFrame(data)
