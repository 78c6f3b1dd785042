"""`softlube.squeeze` and `softlube.slide`: a sphere is moved through a film in time, with inputs and results in SI.

A history of the load or of the height may come from a file.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from softlube.errors import warn
from softlube.files.histories import read_history
from softlube.physical.inputs import BODIES, SLIDING_BODIES, Approach, StartOfSliding, check_names, documented
from softlube.physical.sliding import read_sliding
from softlube.physical.squeeze import WAYS, check_one_way, read_motion
from softlube.solvers.notebook import watched
from softlube.solvers.progress import Listener
from softlube.transient.sliding.result import Slide, follow_sliding
from softlube.transient.squeeze.result import Squeeze, follow


@documented(BODIES, Approach)
@watched
def squeeze(
    *,
    height: Callable[[float], float] | None = None,
    accuracy: float = 1e-3,
    progress: Listener | None = None,
    **given: Any,
) -> Squeeze:
    """Press a rigid sphere through a liquid film onto a soft substrate, or pull it away; no sliding.

    On a substrate that remembers, `softlube.Viscoelastic` or a series `prony`, the contact creeps while the film drains.

    Parts are given as objects, or by their inputs, as for `softlube.Contact`.  Quantities take text with a unit, a pint
    quantity, or a number in SI.  Give exactly one of `young_modulus` and `shear_modulus`, and exactly one of `load`,
    `approach_speed`, `height` and `history`.

    Parameters
    ----------
    height
        Function of the time [s] that gives the height of the sphere's lowest point over the undeformed surface [m].
    accuracy
        Relative error of the films aimed at, at every time.
    progress
        Called with a `softlube.solvers.progress.Progress` every 20 time steps, for instance ``print``.
    indenter, substrate, liquid, compressibility : Part, optional
        See `softlube.Contact`.  The density must be constant: other liquids are for steady sliding only.
    **given
        The parts, and the inputs that follow.  The load may be a function of the time [s] that gives it [N].  The history may
        be a `softlube.History`.  A history says itself how long it lasts, and one of the height where it starts: leave
        `duration` and `initial_height` out then.
    {inputs}

    Returns
    -------
    Squeeze

    Raises
    ------
    InputError
        If an input is missing, contradictory or impossible.
    NotConvergedError
        If the accuracy is not reached.

    Notes
    -----
    Negative pressures, which separation makes, are allowed; the liquid does not cavitate.

    Examples
    --------
    >>> import softlube
    >>> fall = softlube.squeeze(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", load="100 mN",
    ...                         initial_height="100 um", duration="10 s")
    >>> round(fall.final["film_center"] * 1e9), round(fall.final["film_min"] * 1e9)  # nm
    (397, 198)
    """
    check_names(given, BODIES, Approach)
    setup, motion = read_motion(_with_history(given | {"height": height}))
    limit = setup.film_limit / setup.unit_height
    result = replace(follow(motion, accuracy=accuracy, film_limit=limit, progress=progress), setup=setup)
    warn(result.warnings)
    return result


@documented(SLIDING_BODIES, Approach, StartOfSliding)
@watched
def slide(
    *,
    height: Callable[[float], float] | None = None,
    accuracy: float = 2e-2,
    progress: Listener | None = None,
    **given: Any,
) -> Slide:
    """Follow a sphere that is moved through a film as by `softlube.squeeze` and slides from time 0 on.

    Parts are given as objects, or by their inputs, as for `softlube.Contact`.  Quantities take text with a unit, a pint
    quantity, or a number in SI.  Times count from the start of the sliding.

    Parameters
    ----------
    height
        Function of the time [s] that gives the height of the sphere's lowest point over the undeformed surface [m].
    accuracy
        Relative error of the films aimed at, at every time.
    progress
        Called with a `softlube.solvers.progress.Progress` after each step, for instance ``print``.
    indenter, substrate, liquid, compressibility, motion : Part, optional
        See `softlube.Contact`.  The density must be constant: other liquids are for steady sliding only.
    **given
        The parts, and the inputs that follow; load and history as for `softlube.squeeze`.
    {inputs}

    Returns
    -------
    Slide

    Raises
    ------
    InputError
        If an input is missing, contradictory or impossible.
    NotConvergedError
        If the accuracy is not reached.

    Examples
    --------
    >>> import softlube
    >>> start = softlube.slide(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", load="100 mN", speed="10 mm/s",
    ...                        initial_height="100 um", duration="5 ms", accuracy=0.1)
    >>> round(start.final["film_center"] * 1e6, 1)  # µm
    18.3
    """
    check_names(given, SLIDING_BODIES, Approach, StartOfSliding)
    setup, motion = read_motion(_with_history(given | {"height": height}))
    sliding, normalised = read_sliding(setup, given)
    limit = setup.film_limit / setup.unit_height
    result = follow_sliding(motion, **normalised, film_limit=limit, accuracy=accuracy, progress=progress)
    result = replace(result, setup=setup, sliding=sliding)
    warn(result.warnings)
    return result


def _with_history(given: Mapping[str, Any]) -> dict[str, Any]:
    """The inputs, with what the file of a history says in place of its name."""
    if not isinstance(given.get("history"), (str, os.PathLike)):
        return dict(given)
    check_one_way(given, WAYS)
    return dict(given) | {"history": read_history(given["history"])}
