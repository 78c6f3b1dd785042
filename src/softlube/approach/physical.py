"""`softlube.squeeze`: approach and separation in SI units."""

from __future__ import annotations

import csv
import math
import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from softlube.approach.motion import Motion, constant_load, constant_speed, history
from softlube.approach.result import Squeeze, follow, interpreted
from softlube.contact import KINDS, LARGEST_FILM_REYNOLDS, LARGEST_SLOPE, to_si
from softlube.errors import InputError

Array = NDArray[np.floating]

LIKE = {"approach_speed": "speed", "initial_height": "thickness", "film_limit": "roughness"}
"""Inputs of this module and the contact's input that is read the same way."""
ATMOSPHERE = 101325.0
"""Absolute pressure around the contact [Pa], for a warning."""
COLUMNS = {"load": "N", "height": "m"}
STEPS_OF_A_FUNCTION = 400
"""Time steps at least through a history given as a function, whose features are not known."""


def si(name: str, value: object) -> float:
    """A physical input in SI; messages name it as it was given."""
    kind = LIKE.get(name, name)
    try:
        return to_si(kind, value)
    except InputError as error:
        raise InputError(name + str(error).removeprefix(kind)) from None


def in_unit(name: str, value: object, unit: str, example: str) -> float:
    """A finite quantity of any sign in a unit; text, pint quantity, or a number already in it."""
    import pint

    try:
        if isinstance(value, str):
            quantity: Any = pint.get_application_registry().Quantity(value.strip())
            number = float(quantity.to(unit).magnitude)
        elif hasattr(value, "to") and hasattr(value, "magnitude"):
            number = float(value.to(unit).magnitude)  # type: ignore[union-attr]
        else:
            number = float(value)  # type: ignore[arg-type]
    except Exception:  # pint's parser raises whatever the text provokes
        raise InputError(f"{name}: cannot read {value!r}; expected {example}") from None
    if not math.isfinite(number):
        raise InputError(f"{name}: expected a finite quantity, {example}; got {value!s}")
    return number


def read_history(path: str | os.PathLike[str]) -> tuple[str, Array, Array]:
    """A history from a CSV file with a header "time, load" or "time, height", units in brackets if not SI: "time [ms]".

    Returns
    -------
    control : {"load", "height"}
    time, values : ndarray
        In SI.

    Raises
    ------
    InputError
        If the file is missing or is not such a table.
    """
    path = os.fspath(path)
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            rows = [row for row in csv.reader(file) if row and not row[0].lstrip().startswith("#")]
    except FileNotFoundError:
        raise InputError(f"history: {path!r} does not exist") from None
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"history: cannot read {path!r} ({error})") from None
    expected = 'expected two columns headed "time, load" or "time, height", with units in brackets if not SI'
    heads = [re.fullmatch(r"\s*(\w+)\s*(?:\[(.+)\]\s*)?", cell) for cell in rows[0]] if rows else []
    if len(heads) != 2 or not (heads[0] and heads[1]) or heads[0][1] != "time" or heads[1][1] not in COLUMNS:
        raise InputError(f"history: {path!r}: {expected}")
    control = heads[1][1]
    scale = [
        in_unit("history", f"1 {head[2] or unit}", unit, f"a unit like {unit} in the header")
        for head, unit in ((heads[0], "s"), (heads[1], COLUMNS[control]))
    ]
    try:
        table = np.array([[float(cell) for cell in row] for row in rows[1:]])
        time, values = table.T
    except ValueError:
        raise InputError(f"history: {path!r}: {expected}, and numbers below") from None
    return control, time * scale[0], values * scale[1]


@dataclass(frozen=True)
class Setup:
    """The physical input in SI, and the scales of the normalisation.

    Attributes
    ----------
    radius, shear_modulus, viscosity, density : float
        R, G, η, ρ.
    unit_height : float
        Height H that is 1 when normalised: the Hertz indentation of the largest load, or the initial height.
    control : {"load", "height"}
    description : str
        How the sphere is moved.
    initial_height, duration : float
    film_limit : float
        0 if not given.
    """

    radius: float
    shear_modulus: float
    viscosity: float
    density: float
    unit_height: float
    control: str
    description: str
    initial_height: float
    duration: float
    film_limit: float

    @property
    def scales(self) -> dict[str, tuple[float, str]]:
        """SI value and unit of each unit of the normalised problem; docs/squeeze.md."""
        height, length = self.unit_height, math.sqrt(self.radius * self.unit_height)
        pressure = 4 * math.pi * self.shear_modulus * math.sqrt(height / self.radius)
        return {
            "height": (height, "m"),
            "length": (length, "m"),
            "pressure": (pressure, "Pa"),
            "load": (pressure * length**2, "N"),
            "time": (12 * self.viscosity * self.radius / (height * pressure), "s"),
            "volume": (length**2 * height, "m^3"),
        }

    def doubts(self, result: Squeeze) -> tuple[str, ...]:
        """Warnings where the model may not describe the experiment."""
        doubts = []
        radius = math.sqrt(self.radius * max(-float(result.history("height").min()), 0.0))
        if radius > LARGEST_SLOPE * self.radius:
            doubts.append(
                f"the contact radius reaches {radius / self.radius:.2g} R: beyond {LARGEST_SLOPE} R linear elasticity and the "
                f"parabolic sphere are in doubt"
            )
        suction = -float(result.history("pressure_min").min())
        if suction > ATMOSPHERE:
            doubts.append(
                f"the pressure falls {suction:.3g} Pa below the surroundings', more than the atmosphere's 1.01e5 Pa: the "
                f"liquid would cavitate, which is not modelled here"
            )
        height, time = result.history("height"), result.time
        speed = float(np.max(np.abs(np.diff(height) / np.diff(time))))
        film = float(result.history("film_center").max())
        reynolds = self.density * speed * film / self.viscosity
        if reynolds > LARGEST_FILM_REYNOLDS:
            doubts.append(
                f"the film's Reynolds number rho V u/eta reaches {reynolds:.2g}, not small: inertia is neglected here"
            )
        return tuple(doubts)


def squeeze(
    *,
    radius: object = None,
    young_modulus: object = None,
    shear_modulus: object = None,
    viscosity: object = None,
    load: object = None,
    approach_speed: object = None,
    height: Callable[[float], float] | None = None,
    history: str | os.PathLike[str] | None = None,
    initial_height: object = None,
    duration: object = None,
    film_limit: object = None,
    density: object = 1000.0,
    accuracy: float = 1e-3,
    progress: Callable[[str], None] | None = None,
) -> Squeeze:
    """Press a rigid sphere through a liquid film onto a soft half-space, or pull it away; no sliding.

    Quantities take text with a unit, a pint quantity, or a number in SI.  Give exactly one of `young_modulus` and
    `shear_modulus`, and exactly one of `load`, `approach_speed`, `height` and `history`.

    Parameters
    ----------
    radius, viscosity
        Radius of the sphere, dynamic viscosity of the liquid.
    young_modulus, shear_modulus
        E or G = E/3 of the substrate (ν = 1/2).
    load
        Constant load, or a function of the time [s] that gives it [N].
    approach_speed
        Constant speed of the sphere's far end towards the substrate; negative for separation.
    height
        Function of the time [s] that gives the height of the sphere's lowest point over the undeformed surface [m].
    history
        CSV file with the load or the height against time; see `read_history`.
    initial_height
        Height at the start; left out where `height` or the file says it.
    duration
        How long to follow; left out for a file, which ends by itself.
    film_limit
        Minimum film at which to stop, for instance the roughness.
    density
        Of the liquid, for a warning.
    accuracy
        Relative error of the films aimed at, at every time.
    progress
        Called with a line of text now and then.

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
    for name, value in (("radius", radius), ("viscosity", viscosity)):
        if value is None:
            raise InputError(f"{name}: missing; expected {KINDS[name][1]}")
    _exactly_one({"young_modulus": young_modulus, "shear_modulus": shear_modulus})
    ways = {"load": load, "approach_speed": approach_speed, "height": height, "history": history}
    _exactly_one(ways)
    big, eta, rho = si("radius", radius), si("viscosity", viscosity), si("density", density)
    modulus = si("shear_modulus", shear_modulus) if young_modulus is None else si("young_modulus", young_modulus) / 3
    limit = 0.0 if film_limit is None else si("film_limit", film_limit)

    table = read_history(history) if history is not None else None
    starts_itself = height is not None or (table is not None and table[0] == "height")
    for name, value, unwanted in (("initial_height", initial_height, starts_itself), ("duration", duration, table is not None)):
        if unwanted and value is not None:
            raise InputError(f"{name}: the history has its own; leave it out")
        if not unwanted and value is None:
            raise InputError(f"{name}: missing; expected {'a length' if name == 'initial_height' else 'a time'} with its unit")
    end = float(table[1][-1]) if table is not None else in_unit("duration", duration, "s", "a time such as '10 s'")
    if not end > 0:
        raise InputError(f"duration: expected a positive time, got {duration or end!s}")
    function = height if height is not None else load if callable(load) else None
    if starts_itself:
        first = float(height(0.0)) if height is not None else float(table[2][0])  # type: ignore[index]
        if not first > 0:
            raise InputError(f"height: expected a history that starts above the surface, got {first:.3g} m at time 0")
    else:
        first = si("initial_height", initial_height)

    speed = 0.0
    if approach_speed is not None:
        speed = in_unit("approach_speed", approach_speed, "m/s", "a speed such as '10 um/s', or '-10 um/s'")
        if speed == 0:
            raise InputError("approach_speed: zero; nothing moves the sphere")
    if table is not None:
        largest = float(np.max(table[2]))
    elif callable(load):
        largest = max(float(load(t)) for t in np.linspace(0, end, 201))
    else:
        largest = si("load", load) if load is not None else 0.0
    loaded = load is not None or (table is not None and table[0] == "load")
    if loaded and not largest > 0:
        raise InputError("load: expected a history that presses at some time; got no positive load")
    unit = (3 * largest / (16 * modulus * math.sqrt(big))) ** (2 / 3) if loaded else first  # Eq. (29)

    setup = Setup(
        radius=big,
        shear_modulus=modulus,
        viscosity=eta,
        density=rho,
        unit_height=unit,
        control="load" if loaded else "height",
        description=next(
            f"{name} {value}" if isinstance(value, str) else name for name, value in ways.items() if value is not None
        ),
        initial_height=first,
        duration=end,
        film_limit=limit,
    )
    motion = _motion(setup, speed, largest, table, function)
    result = follow(motion, accuracy=accuracy, film_limit=limit / unit, progress=progress)
    return interpreted(result, setup)


def _exactly_one(choices: dict[str, object]) -> None:
    chosen = [name for name, value in choices.items() if value is not None]
    if len(chosen) != 1:
        verb = "given together" if chosen else "all missing"
        raise InputError(f"{', '.join(chosen or choices)}: {verb}; give exactly one of {', '.join(choices)}")


def _motion(
    setup: Setup,
    speed: float,
    load: float,
    table: tuple[str, Array, Array] | None,
    function: Callable[[float], float] | None,
) -> Motion:
    """The normalised motion."""
    unit, time = setup.unit_height, setup.scales["time"][0]
    scale = setup.scales["load" if setup.control == "load" else "height"][0]
    start, end = setup.initial_height / unit, setup.duration / time
    if table is not None:
        return history(table[0], table[1] / time, table[2] / scale, start)  # type: ignore[arg-type]
    if function is not None:
        given = function
        return Motion(
            setup.control,  # type: ignore[arg-type]
            lambda t: float(given(t * time)) / scale,
            start,
            end,
            longest_step=end / STEPS_OF_A_FUNCTION,
        )
    return (
        constant_load(load / scale, start, end) if setup.control == "load" else constant_speed(speed * time / unit, start, end)
    )
