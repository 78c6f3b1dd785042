"""The start of sliding in SI: its own inputs, and what they are normalised."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from softlube.errors import InputError
from softlube.model.inputs import read
from softlube.model.motions import Sliding
from softlube.model.parts import resolve
from softlube.physical.inputs import StartOfSliding
from softlube.physical.squeeze import Setup
from softlube.transient.sliding.integrate import check_substrate


def read_sliding(setup: Setup, given: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Read how a sphere slides.

    Parameters
    ----------
    setup : Setup
        The physical input without the sliding, see `softlube.physical.squeeze.read_motion`.
    given : mapping of str to object
        Inputs as for `softlube.slide`.

    Returns
    -------
    sliding : dict of str to object
        Speed [m/s], time for which the sphere is pressed before [s], and cavitation condition.
    normalised : dict of str to object
        β, the normalised time and the cavitation condition: arguments of
        `softlube.transient.sliding.result.follow_sliding`.

    Raises
    ------
    InputError
        If an input is missing or impossible, the motion is no plain sliding, or the substrate remembers.
    """
    check_substrate(setup.substrate_for(setup.unit_height))
    motion = resolve([Sliding.slot], given)[Sliding.slot]
    if not isinstance(motion, Sliding):
        raise InputError("entrainment_speed: a start of rolling is not solved; give the speed of a ball that slides instead")
    own = read(StartOfSliding.inputs, given)
    pressed = own["pressed"] or 0.0
    if pressed < 0:
        raise InputError(f"pressed: expected a positive time, got {given['pressed']!s}")
    sliding = {"speed": motion.speed, "pressed": pressed, "cavitation": own["cavitation"]}
    beta = setup.beta(setup.unit_height, motion.speed)
    return sliding, {"beta": beta, "pressed": pressed / setup.units["time"][0], "cavitation": own["cavitation"]}
