"""The start of sliding in SI units: `softlube squeeze --speed`."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from typing import Any, get_args

from softlube.errors import InputError
from softlube.model.problem import Cavitation
from softlube.physical.squeeze import Setup, read_motion
from softlube.physical.units import KINDS, in_unit, to_si
from softlube.solvers.progress import Listener
from softlube.transient.sliding.result import DESCRIPTION, Slide, follow_sliding

__all__ = ["DESCRIPTION", "Slide", "read_sliding", "slide"]


def slide(
    *,
    radius: object = None,
    young_modulus: object = None,
    shear_modulus: object = None,
    viscosity: object = None,
    speed: object = None,
    load: object = None,
    approach_speed: object = None,
    height: Callable[[float], float] | None = None,
    history: str | os.PathLike[str] | None = None,
    initial_height: object = None,
    duration: object = None,
    film_limit: object = None,
    pressed: object = None,
    cavitation: str = "reynolds",
    density: object = 1000.0,
    thickness: object = None,
    poisson_ratio: object = 0.5,
    base: str = "bonded",
    pressure_viscosity: object = None,
    viscosity_law: str = "barus",
    density_law: str = "constant",
    accuracy: float = 2e-2,
    progress: Listener | None = None,
) -> Slide:
    """Follow a sphere that is moved through a film as by `softlube.squeeze` and slides from time 0 on.

    Quantities take text with a unit, a pint quantity, or a number in SI.

    Parameters
    ----------
    radius, young_modulus, shear_modulus, viscosity, density, thickness, poisson_ratio, base
        As for `softlube.squeeze`.
    pressure_viscosity, viscosity_law, density_law
        Likewise.
    load, approach_speed, height, history, initial_height, duration, film_limit
        Likewise; times count from the start of the sliding.
    speed
        Of the sliding.
    pressed
        How long the sphere is pressed by the load of time 0, without sliding, before.
    cavitation
        "reynolds" (no negative pressure) or "none".
    accuracy
        Relative error of the films aimed at, at every time.
    progress
        Called with a `softlube.solvers.progress.Progress` after each time step, for instance ``print``.

    Raises
    ------
    InputError
        If an input is missing, contradictory or impossible.
    NotConvergedError
        If the accuracy is not reached.
    """
    own = ("speed", "pressed", "cavitation", "accuracy", "progress")
    setup, motion = read_motion({name: value for name, value in locals().items() if name not in own})
    sliding, normalised = read_sliding(setup, speed=speed, pressed=pressed, cavitation=cavitation)
    limit = setup.film_limit / setup.unit_height
    result = follow_sliding(motion, **normalised, film_limit=limit, accuracy=accuracy, progress=progress)
    return replace(result, setup=setup, sliding=sliding)


def read_sliding(
    setup: Setup, *, speed: object = None, pressed: object = None, cavitation: object = "reynolds"
) -> tuple[dict[str, Any], dict[str, Any]]:
    """What `slide` is told of the sliding, in SI, and the normalised arguments of `follow_sliding`.

    Raises
    ------
    InputError
        If an input is missing or impossible.
    """
    if speed is None:
        raise InputError(f"speed: missing; expected {KINDS['speed'][1]}")
    if cavitation not in get_args(Cavitation):
        raise InputError(f"cavitation: expected 'reynolds' or 'none', got {cavitation!r}")
    waited = 0.0 if pressed is None else in_unit("pressed", pressed, "s", "a time such as '10 s'")
    if waited < 0:
        raise InputError(f"pressed: expected a positive time, got {pressed!s}")
    velocity = to_si("speed", speed)
    sliding = {"speed": velocity, "pressed": waited, "cavitation": cavitation}
    beta = setup.beta(setup.unit_height, velocity)
    return sliding, {"beta": beta, "pressed": waited / setup.units["time"][0], "cavitation": cavitation}
