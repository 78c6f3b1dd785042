"""The start of sliding in SI units: `softlube squeeze --speed`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from softlube.errors import InputError
from softlube.model.inputs import read
from softlube.model.motions import Sliding
from softlube.model.parts import resolve
from softlube.physical.inputs import SLIDING_BODIES, Approach, StartOfSliding, check_names, documented
from softlube.physical.squeeze import Setup, read_motion
from softlube.solvers.progress import Listener
from softlube.transient.sliding.result import Slide, follow_sliding

__all__ = ["Slide", "read_sliding", "slide"]


@documented(SLIDING_BODIES, Approach, StartOfSliding)
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
        See `softlube.Contact`.
    **given
        The parts, and the inputs that follow.
    {inputs}

    Raises
    ------
    InputError
        If an input is missing, contradictory or impossible.
    NotConvergedError
        If the accuracy is not reached.
    """
    check_names(given, SLIDING_BODIES, Approach, StartOfSliding)
    setup, motion = read_motion(given | {"height": height})
    sliding, normalised = read_sliding(setup, given)
    limit = setup.film_limit / setup.unit_height
    result = follow_sliding(motion, **normalised, film_limit=limit, accuracy=accuracy, progress=progress)
    return replace(result, setup=setup, sliding=sliding)


def read_sliding(setup: Setup, given: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """What `slide` is told of the sliding, in SI, and the normalised arguments of `follow_sliding`.

    Raises
    ------
    InputError
        If an input is missing or impossible.
    """
    motion = resolve([Sliding.slot], given)[Sliding.slot]
    own = read(StartOfSliding.inputs, given)
    pressed = own["pressed"] or 0.0
    if pressed < 0:
        raise InputError(f"pressed: expected a positive time, got {given['pressed']!s}")
    sliding = {"speed": motion.speed, "pressed": pressed, "cavitation": own["cavitation"]}
    beta = setup.beta(setup.unit_height, motion.speed)
    return sliding, {"beta": beta, "pressed": pressed / setup.units["time"][0], "cavitation": own["cavitation"]}
