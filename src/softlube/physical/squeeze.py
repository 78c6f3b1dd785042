"""`softlube.squeeze`: approach and separation in SI units."""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError
from softlube.model.liquids.incompressible import Incompressible
from softlube.model.parts import resolve
from softlube.model.substrates.layer import LayerKernel
from softlube.physical.inputs import BODIES, Approach, check_names, documented
from softlube.physical.materials import LARGEST_FILM_REYNOLDS, LARGEST_SLOPE, Materials, dry_effect, layer_doubt
from softlube.physical.units import in_unit
from softlube.solvers.progress import Listener
from softlube.transient.extremes import Extremes
from softlube.transient.motion import Motion, constant_load, constant_speed, history
from softlube.transient.squeeze.result import Squeeze, follow, interpreted

Array = NDArray[np.floating]

ATMOSPHERE = 101325.0
"""Absolute pressure around the contact [Pa], for a warning."""
WAYS = ("load", "approach_speed", "height", "history")
"""Ways to say how the sphere is moved."""
COLUMNS = {"load": "N", "height": "m"}
STEPS_OF_A_FUNCTION = 400
"""Time steps at least through a history given as a function, whose features are not known."""
Table = tuple[str, Array, Array]
"""What is prescribed, "load" or "height"; times and values in SI."""


def read_history(path: str | os.PathLike[str]) -> Table:
    """A history from a CSV file with a header "time, load" or "time, height", units in brackets if not SI: "time [ms]".

    Returns
    -------
    control : {"load", "height"}
    time, values : ndarray
        In SI.

    Raises
    ------
    InputError
        If the file is missing or is not such a table; the message names the line.
    """
    path = os.fspath(path)
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            reader = csv.reader(file)
            numbered = [(reader.line_num, row) for row in reader if row and not row[0].lstrip().startswith("#")]
    except FileNotFoundError:
        raise InputError(f"history: {path!r} does not exist") from None
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"history: cannot read {path!r} ({error})") from None
    expected = 'expected two columns headed "time, load" or "time, height", with units in brackets if not SI'
    line, first = numbered[0] if numbered else (1, [])
    heads = [re.fullmatch(r"\s*(\w+)\s*(?:\[(.+)\]\s*)?", cell) for cell in first]
    if len(heads) != 2 or not (heads[0] and heads[1]) or heads[0][1] != "time" or heads[1][1] not in COLUMNS:
        raise InputError(f"history: {path!r}, line {line}: {expected}")
    control = heads[1][1]
    place = f"history: {path!r}, line {line}"
    scale = [
        in_unit(place, f"1 {head[2] or unit}", unit, f"a unit like {unit} in the header")
        for head, unit in ((heads[0], "s"), (heads[1], COLUMNS[control]))
    ]
    points: list[tuple[float, float]] = []
    for line, row in numbered[1:]:
        try:
            instant, value = map(float, row)
        except ValueError:
            raise InputError(f"history: {path!r}, line {line}: expected two numbers, got {', '.join(row)!r}") from None
        if not (np.isfinite(instant) and np.isfinite(value)):
            raise InputError(f"history: {path!r}, line {line}: expected finite numbers, got {', '.join(row)!r}")
        if instant <= points[-1][0] if points else instant != 0:
            raise InputError(f"history: {path!r}, line {line}: expected times that start at 0 and increase, got {instant:g}")
        points.append((instant, value))
    if len(points) < 2:
        raise InputError(f"history: {path!r}, line {line}: expected at least two points of time and {control}")
    time, values = np.array(points).T
    return control, time * scale[0], values * scale[1]


@dataclass(frozen=True)
class Setup(Materials):
    """The physical input in SI, and the height that it is normalised with.

    Attributes
    ----------
    unit_height : float
        Height H that is 1 when normalised: the indentation of a half-space under the largest load, Eq. (29), or the initial
        height [m].
    control : {"load", "height"}
    description : str
        How the sphere is moved.
    initial_height, duration : float
        In m and s.
    film_limit : float
        0 if not given [m].
    """

    unit_height: float
    control: str
    description: str
    initial_height: float
    duration: float
    film_limit: float

    @property
    def units(self) -> dict[str, tuple[float, str]]:
        """SI value and unit of each unit of the normalised problem; docs/squeeze.md."""
        return self.scales(self.unit_height)

    def doubts(self, extremes: Extremes) -> tuple[str, ...]:
        """Warnings where the model may not describe the experiment, whose extremes are given in SI."""
        doubts = []
        depth, suction = max(-extremes.least_height, 0.0), -extremes.least_pressure
        layer: list[str] = []
        radius = (self.radius * depth) ** 0.5
        substrate = self.substrate_for(self.unit_height)
        if depth > 0 and isinstance(substrate, LayerKernel):
            dry, changes = dry_effect(substrate, by_load=self.control == "load", depth=depth / self.unit_height)
            radius = dry.radius * self.units["length"][0]
            layer = layer_doubt(dry, substrate, changes)
        if radius > LARGEST_SLOPE * self.radius:
            doubts.append(
                f"the contact radius reaches {radius / self.radius:.2g} R: beyond {LARGEST_SLOPE} R linear elasticity and the "
                f"parabolic sphere are in doubt"
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
        return (*doubts, *layer, *self.thickening_doubt(extremes.largest_pressure))


@documented(BODIES, Approach)
def squeeze(
    *,
    height: Callable[[float], float] | None = None,
    accuracy: float = 1e-3,
    progress: Listener | None = None,
    **given: Any,
) -> Squeeze:
    """Press a rigid sphere through a liquid film onto a soft substrate, or pull it away; no sliding.

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
        The parts, and the inputs that follow.  The load may be a function of the time [s] that gives it [N].  A history
        says itself how long it lasts, and one of the height where it starts: leave `duration` and `initial_height` out then.
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
    setup, motion = read_motion(given | {"height": height})
    limit = setup.film_limit / setup.unit_height
    return interpreted(follow(motion, accuracy=accuracy, film_limit=limit, progress=progress), setup)


def read_motion(given: Mapping[str, Any], table: Table | None = None) -> tuple[Setup, Motion]:
    """The physical input in SI, and the normalised motion.

    Parameters
    ----------
    given : mapping of str to object
        Arguments of `squeeze`.
    table : Table, optional
        What the history's file says, if it has been read.

    Raises
    ------
    InputError
        If an input is missing, contradictory or impossible.
    """
    materials = Materials(**resolve(BODIES, given))
    if not isinstance(materials.compressibility, Incompressible):
        selector = materials.compressibility.selector
        raise InputError(f"{selector}: the density must be constant where the film changes with time; leave it out")
    ways = {name: given.get(name) for name in WAYS}
    exactly_one(ways)
    load, height = ways["load"], ways["height"]
    known = Approach.inputs
    limit = 0.0 if given.get("film_limit") is None else known["film_limit"].read(given["film_limit"])

    if table is None and ways["history"] is not None:
        table = read_history(ways["history"])
    starts_itself = height is not None or (table is not None and table[0] == "height")
    for name, unwanted in (("initial_height", starts_itself), ("duration", table is not None)):
        if unwanted and given.get(name) is not None:
            raise InputError(f"{name}: the history has its own; leave it out")
        if not unwanted and given.get(name) is None:
            raise InputError(f"{name}: missing; expected {known[name].expected}")
    end = float(table[1][-1]) if table is not None else known["duration"].read(given["duration"])
    function = height if height is not None else load if callable(load) else None
    if starts_itself:
        first = float(height(0.0)) if height is not None else float(table[2][0])  # type: ignore[index]
        if not first > 0:
            raise InputError(f"height: expected a history that starts above the surface, got {first:.3g} m at time 0")
    else:
        first = known["initial_height"].read(given["initial_height"])

    speed = 0.0
    if ways["approach_speed"] is not None:
        speed = known["approach_speed"].read(ways["approach_speed"])
        if speed == 0:
            raise InputError("approach_speed: zero; nothing moves the sphere")
    if table is not None:
        largest = float(np.max(table[2]))
    elif callable(load):
        largest = max(float(load(t)) for t in np.linspace(0, end, 201))
    else:
        largest = known["load"].read(load) if load is not None else 0.0
    loaded = load is not None or (table is not None and table[0] == "load")
    if loaded and not largest > 0:
        raise InputError("load: expected a history that presses at some time; got no positive load")

    setup = Setup(
        **vars(materials),
        unit_height=materials.hertz_indentation(largest) if loaded else first,
        control="load" if loaded else "height",
        description=next(
            f"{name} {value}" if isinstance(value, str) else name for name, value in ways.items() if value is not None
        ),
        initial_height=first,
        duration=end,
        film_limit=limit,
    )
    return setup, _motion(setup, speed, largest, table, function)


def exactly_one(choices: dict[str, object]) -> None:
    """Refuse several ways of saying one thing if not exactly one is used."""
    chosen = [name for name, value in choices.items() if value is not None]
    if len(chosen) != 1:
        verb = "given together" if chosen else "all missing"
        raise InputError(f"{', '.join(chosen or choices)}: {verb}; give exactly one of {', '.join(choices)}")


def _motion(
    setup: Setup,
    speed: float,
    load: float,
    table: Table | None,
    function: Callable[[float], float] | None,
) -> Motion:
    """The normalised motion."""
    unit, time = setup.unit_height, setup.units["time"][0]
    scale = setup.units["load" if setup.control == "load" else "height"][0]
    start, end = setup.initial_height / unit, setup.duration / time
    if table is not None:
        motion = history(table[0], table[1] / time, table[2] / scale, start)  # type: ignore[arg-type]
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
    return replace(motion, substrate=setup.substrate_for(unit), liquid=setup.liquid_for(unit))
