"""How a sphere is moved up and down, in SI: inputs, the normalised motion, and warnings where the model is in doubt."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError
from softlube.model.dry import PARABOLOID
from softlube.model.liquids.incompressible import Incompressible
from softlube.model.parts import resolve
from softlube.model.substrates.layer import LayerKernel
from softlube.physical.inputs import BODIES, Approach
from softlube.physical.materials import LARGEST_FILM_REYNOLDS, LARGEST_SLOPE, Materials, dry_effect, layer_doubt
from softlube.transient.extremes import Extremes
from softlube.transient.motion import Motion, constant_load, constant_speed, history, points
from softlube.transient.squeeze.rings import Control

Array = NDArray[np.floating]

ATMOSPHERE = 101325.0
"""Absolute pressure around the contact [Pa], for a warning."""
WAYS = ("load", "approach_speed", "height", "history")
"""Inputs that say how the sphere is moved; `height` is a function of the time, which only Python takes."""
WRITTEN_WAYS = tuple(name for name in WAYS if name in Approach.inputs)
"""Those that can be written down, on the command line and in plans."""
STEPS_OF_A_FUNCTION = 400
"""Time steps at least through a history given as a function, whose features are not known."""


@dataclass(frozen=True)
class History:
    """A load or a height that is given at some times, in SI; between them it is interpolated without overshoot.

    Parameters
    ----------
    control : {"load", "height"}
        What is given: the normal load [N], or the height of the sphere's lowest point over the undeformed surface [m].
    time : array_like, shape (k,)
        Times from 0 on, increasing [s].
    values : array_like, shape (k,)
        The load or the height at these times.
    source : str
        Where it is from, such as the name of a file.

    Raises
    ------
    InputError
        If there are fewer than two points, the times do not increase from 0, or a number is not finite.

    Examples
    --------
    >>> import softlube
    >>> pressed = softlube.History("load", [0, 0.5, 10], [0, 0.1, 0.1])
    >>> fall = softlube.squeeze(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", history=pressed,
    ...                         initial_height="100 um")
    >>> round(fall.final["film_center"] * 1e9)  # nm
    395
    """

    control: Control
    time: Array
    values: Array
    source: str = ""

    def __post_init__(self) -> None:
        for name in ("time", "values"):
            object.__setattr__(self, name, np.asarray(getattr(self, name), dtype=float))
        if self.control not in ("load", "height"):
            raise InputError(f"history: expected a history of 'load' or 'height', got {self.control!r}")
        points(self.time, self.values)


@dataclass(frozen=True)
class Setup(Materials):
    """The physical input in SI, and the height that it is normalised with.

    Attributes
    ----------
    unit_height : float
        Height H that is 1 when normalised: the indentation of a half-space under the largest load, Eq. (29), or the initial
        height [m].
    control : {"load", "height"}
        What is prescribed.
    description : str
        How the sphere is moved: the input and its value.
    initial_height : float
        Height of the lowest point over the undeformed surface at first [m].
    duration : float
        Time to follow [s].
    film_limit : float
        Minimum film at which to stop, 0 for none [m].
    """

    unit_height: float
    control: str
    description: str
    initial_height: float
    duration: float
    film_limit: float

    @property
    def units(self) -> dict[str, tuple[float, str]]:
        """SI value and unit of each unit of the normalised problem; docs/how-to/squeeze.md."""
        return self.scales(self.unit_height)

    def doubts(self, extremes: Extremes) -> tuple[str, ...]:
        """Warnings where the model may not describe the experiment, whose extremes are given in SI."""
        doubts = []
        depth, suction = max(-extremes.least_height, 0.0), -extremes.least_pressure
        by_layer: list[str] = []
        radius = (self.reduced_radius * depth) ** 0.5
        substrate, shape = self.substrate_for(self.unit_height).elastic, self.shape_for(self.unit_height)
        layered, paraboloid = isinstance(substrate, LayerKernel), shape == PARABOLOID
        if depth > 0 and (layered or not paraboloid):
            deep = depth / self.unit_height
            dry, changes = dry_effect(substrate, by_load=self.control == "load", depth=deep, indenter=shape)
            radius = dry.radius * self.units["length"][0]
            if isinstance(substrate, LayerKernel):
                by_layer = layer_doubt(dry, substrate, changes)
        if (slope := self.steepness(radius)) > LARGEST_SLOPE:
            doubts.append(
                f"the contact radius reaches {slope:.2g} R: beyond {LARGEST_SLOPE} R linear elasticity "
                f"and the parabolic sphere are in doubt"
                if paraboloid
                else f"the indenter's slope reaches {slope:.2g} at the edge of the contact: beyond {LARGEST_SLOPE} linear "
                f"elasticity is in doubt"
            )
        if suction > ATMOSPHERE:
            doubts.append(
                f"the pressure falls {suction:.3g} Pa below the surroundings', more than the atmosphere's 1.01e5 Pa: the "
                f"liquid would cavitate, which is not modelled here"
            )
        reynolds = self.density * extremes.largest_speed * extremes.largest_film / self.viscosity
        if reynolds > LARGEST_FILM_REYNOLDS:
            doubts.append(
                f"the film's Reynolds number rho V u/eta reaches {reynolds:.2g}, not small: inertia is neglected here"
            )
        return (*doubts, *by_layer, *self.thickening_doubt(extremes.largest_pressure))


def check_one_way(given: Mapping[str, object], ways: Sequence[str]) -> None:
    """Refuse inputs that do not say in exactly one way how the sphere is moved.

    Parameters
    ----------
    given : mapping of str to object
        Inputs by their names.
    ways : sequence of str
        `WAYS`, or `WRITTEN_WAYS` where inputs are text.

    Raises
    ------
    InputError
        If none or several of the ways are given.
    """
    chosen = [name for name in ways if given.get(name) is not None]
    if len(chosen) != 1:
        verb = "given together" if chosen else "all missing"
        raise InputError(f"{', '.join(chosen or ways)}: {verb}; give exactly one of them")


def read_motion(given: Mapping[str, Any]) -> tuple[Setup, Motion]:
    """Read how a sphere is moved up and down, and what it is moved over.

    Parameters
    ----------
    given : mapping of str to object
        Parts and inputs as for `softlube.squeeze`; `history` is a `History`, not a file.

    Returns
    -------
    setup : Setup
        The physical input in SI.
    motion : Motion
        The normalised motion.

    Raises
    ------
    InputError
        If an input is missing, contradictory or impossible.
    """
    materials = Materials(**resolve(BODIES, given))
    if not isinstance(materials.compressibility, Incompressible):
        selector = materials.compressibility.selector
        raise InputError(f"{selector}: the density must be constant where the film changes with time; leave it out")
    check_one_way(given, WAYS)
    load, height, course = (given.get(name) for name in ("load", "height", "history"))
    if course is not None and not isinstance(course, History):
        raise InputError(f"history: expected a file or a softlube.History, got {course!r}")
    known = Approach.inputs
    limit = 0.0 if given.get("film_limit") is None else known["film_limit"].read(given["film_limit"])

    starts_itself = height is not None or (course is not None and course.control == "height")
    for name, unwanted in (("initial_height", starts_itself), ("duration", course is not None)):
        if unwanted and given.get(name) is not None:
            raise InputError(f"{name}: the history has its own; leave it out")
        if not unwanted and given.get(name) is None:
            raise InputError(f"{name}: missing; expected {known[name].expected}")
    end = float(course.time[-1]) if course is not None else known["duration"].read(given["duration"])
    if starts_itself:
        first = float(course.values[0]) if course is not None else float(height(0.0))  # type: ignore[misc]
        if not first > 0:
            raise InputError(f"height: expected a history that starts above the surface, got {first:.3g} m at time 0")
    else:
        first = known["initial_height"].read(given["initial_height"])

    speed = 0.0
    if given.get("approach_speed") is not None:
        speed = known["approach_speed"].read(given["approach_speed"])
        if speed == 0:
            raise InputError("approach_speed: zero; nothing moves the sphere")
    if course is not None:
        largest = float(np.max(course.values))
    elif callable(load):
        largest = max(float(load(t)) for t in np.linspace(0, end, 201))
    else:
        largest = known["load"].read(load) if load is not None else 0.0
    loaded = load is not None or (course is not None and course.control == "load")
    if loaded and not largest > 0:
        raise InputError("load: expected a history that presses at some time; got no positive load")

    setup = Setup(
        **vars(materials),
        unit_height=materials.hertz_indentation(largest) if loaded else first,
        control="load" if loaded else "height",
        description=_description(given),
        initial_height=first,
        duration=end,
        film_limit=limit,
    )
    return setup, _motion(setup, speed, largest, course, height or (load if callable(load) else None))


def _description(given: Mapping[str, Any]) -> str:
    """How the sphere is moved: the name of the input, and its value where that is a text or has a source."""
    name = next(name for name in WAYS if given.get(name) is not None)
    value = given[name]
    text = value.source if isinstance(value, History) else value
    return f"{name} {text}" if isinstance(text, str) and text else name


def _motion(
    setup: Setup,
    speed: float,
    load: float,
    course: History | None,
    function: Callable[[float], float] | None,
) -> Motion:
    """The normalised motion."""
    unit, time = setup.unit_height, setup.units["time"][0]
    scale = setup.units["load" if setup.control == "load" else "height"][0]
    start, end = setup.initial_height / unit, setup.duration / time
    if course is not None:
        motion = history(course.control, course.time / time, course.values / scale, start)
    elif function is not None:
        given = function
        motion = Motion(
            setup.control,  # type: ignore[arg-type]
            lambda t: float(given(t * time)) / scale,
            start,
            end,
            longest_step=end / STEPS_OF_A_FUNCTION,
        )
    elif setup.control == "load":
        motion = constant_load(load / scale, start, end)
    else:
        motion = constant_speed(speed * time / unit, start, end)
    return replace(motion, substrate=setup.substrate_for(unit), liquid=setup.liquid_for(unit), indenter=setup.shape_for(unit))
