"""What the calculator's page knows of softlube, as JSON: inputs, units, quantities, words, the master curve, profiles.

The page computes with these tables alone, so that a number or a word that changes in softlube changes in a page that is
written afterwards.
"""

from __future__ import annotations

import base64
from collections.abc import Callable
from inspect import signature
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray

from softlube.model import inputs as reading
from softlube.model import units
from softlube.model.exact import HERTZ_LOAD, HERTZ_PRESSURE
from softlube.model.inputs import Input
from softlube.model.prefixes import PREFIXES
from softlube.model.problem import Cavitation
from softlube.model.quantities import DERIVED, STEADY, Definition
from softlube.physical import contact, materials, roughness
from softlube.physical.inputs import SLIDING_BODIES, Loading, names_of
from softlube.theory import centre_line, master_curve
from softlube.theory.scaling import PAPER_RANGE

Array = NDArray[np.floating]

INPUTS = (
    "radius",
    "young_modulus",
    "shear_modulus",
    "poisson_ratio",
    "viscosity",
    "density",
    "speed",
    "load",
    "indentation",
    "roughness",
    "cavitation",
)
"""Inputs of a contact for which the master curve holds, in the order in which softlube reads them."""
SLIDERS = {
    "radius": ("10 um", "100 mm"),
    "young_modulus": ("1 kPa", "10 GPa"),
    "shear_modulus": ("1 kPa", "10 GPa"),
    "viscosity": ("0.1 mPa s", "1000 Pa s"),
    "speed": ("1 um/s", "10 m/s"),
    "load": ("1 uN", "100 N"),
    "indentation": ("10 nm", "10 mm"),
}
"""Ends of the sliders.  A field takes any value."""
FIRST = ("radius", "young_modulus", "viscosity", "speed", "load")
"""Inputs that are given at first: their examples."""
REGIMES = (
    (
        "isoviscous-rigid",
        "The liquid lifts the sphere: its lowest point stays above the undeformed surface, and the substrate yields less than "
        "the film is thick.",
    ),
    (
        "between rigid and elastic",
        "The sphere dips in, but the film is not yet thin beside the indentation: neither the rigid sphere's formulas nor "
        "Hertz's pressure hold.",
    ),
    (
        "isoviscous-elastic (soft EHL)",
        "The pressure is close to Hertz's in a dry contact; the film is thin beside the indentation, and the inlet sets it.",
    ),
)
"""Regimes of lubrication by the lowest point's height and by β_load, below and above `PAPER_RANGE`'s first β."""
WORTH_SAYING = 1.1
"""Rise of an oil's viscosity at the maximum pressure from which on the page says that its liquid does not thicken."""


def exported() -> dict[str, Any]:
    """Everything that the page computes with, ready for JSON."""
    from importlib.metadata import version

    declared = names_of(SLIDING_BODIES, Loading)
    thickening = declared["pressure_viscosity"]
    return {
        "version": version("softlube"),
        "inputs": {name: _input(declared[name]) for name in INPUTS},
        "first": {name: declared[name].example for name in FIRST},
        "units": {
            "names": units.names(),
            "prefixes": [*units.PREFIXES, *units.MICRO],
            "longest": units.LONGEST,
            "least": units.LEAST,
            "greatest": units.GREATEST,
        },
        "prefixes": PREFIXES,
        "quantities": [_quantity(row) for row in STEADY.values()],
        "derived": [_quantity(row) for row in DERIVED.values()],
        "bounds": {
            "least": reading.LEAST,
            "greatest": reading.GREATEST,
            "slope": materials.LARGEST_SLOPE,
            "film_reynolds": materials.LARGEST_FILM_REYNOLDS,
            "traction": materials.LARGEST_TRACTION,
            "newtonian_stress": materials.NEWTONIAN_STRESS,
            "hertz_load": HERTZ_LOAD,
            "hertz_pressure": HERTZ_PRESSURE,
        },
        "lambda": {"full": roughness.FULL_FILM, "mixed": roughness.MIXED, "words": roughness.REGIMES},
        "words": {
            "no_gaps": master_curve.NO_GAPS,
            "too_wide": contact.TOO_WIDE,
            "wide": contact.WIDE,
            "rough": contact.ROUGH,
            "inertia": contact.INERTIA,
            "limiting_stress": contact.LIMITING_STRESS,
        },
        "regimes": {"words": REGIMES, "elastic": PAPER_RANGE[0]},
        "thickening": {
            "coefficient": thickening.read(thickening.example),
            "example": thickening.example,
            "worth": WORTH_SAYING,
        },
        "curve": {
            "correction": master_curve.CORRECTION,
            "families": {
                f"{cavitation} {normalisation}": _family(cavitation, normalisation)
                for cavitation in get_args(Cavitation)
                for normalisation in ("load", "indentation")
            },
        },
        "lines": _lines(),
    }


def _input(declared: Input) -> dict[str, Any]:
    ends = SLIDERS.get(declared.name)
    return {
        "words": declared.words,
        "unit": declared.unit,
        "example": declared.example,
        "expected": declared.expected,
        "required": declared.required,
        "default": None if declared.required else declared.default,
        "signed": declared.signed,
        "between": declared.between,
        "choices": declared.choices,
        "slider": ends and [declared.read(end) for end in ends],
    }


def _quantity(row: Definition) -> dict[str, Any]:
    return {
        "name": row.name,
        "words": row.words,
        "symbol": row.symbol,
        "dimension": row.dimension,
        "si": row.unit.si,
        "place": row.place,
        "offset": row.offset,
        "limit": row.limit,
        "exponent": row.exponent,
    }


def _family(cavitation: str, normalisation: str) -> dict[str, Any]:
    """The splines of all quantities: knots ln β, then values, slopes, and those of the error, as the bytes of doubles."""
    names = master_curve.available(normalisation)
    curves = [master_curve.curve(name, normalisation, cavitation) for name in names]
    knots = curves[0].spline.x
    rows = [knots]
    for curve in curves:
        for spline in (curve.spline, curve.error):
            rows += [spline(knots), spline(knots, 1)]
    numbers = base64.b64encode(np.concatenate(rows).astype("<f8").tobytes()).decode("ascii")
    # A quantity with a limit is continued to that, not by its law.
    laws = {curve.name: power_terms(curve.law) for curve in curves if curve.law and STEADY[curve.name].limit is None}
    return {"knots": len(knots), "names": names, "laws": laws, "numbers": numbers}


def power_terms(law: Callable[..., Array]) -> list[tuple[float, float]]:
    """A law of the Hertz limit as a sum of powers of β.

    Parameters
    ----------
    law : callable
        Of β and, if it has more than one, of the number of its terms, see `softlube.theory.limits`.

    Returns
    -------
    list of tuple of float
        Factor and power of each term.
    """
    parts = [partial_sum(law, count) for count in (1, 2)] if "terms" in signature(law).parameters else [law]
    found: list[tuple[float, float]] = []
    for part in parts:
        left = [float(part(beta)) - sum(factor * beta**power for factor, power in found) for beta in (1.0, 10.0)]
        found.append((left[0], round(float(np.log10(left[1] / left[0])), 9)))
    return found


def partial_sum(law: Callable[..., Array], count: int) -> Callable[[float], Array]:
    """The sum of a law's first terms."""
    return lambda beta: law(beta, terms=count)


def _lines() -> dict[str, Any]:
    """The table of the profiles along the centre line, and where its places are."""
    tables = {}
    nodes: Array = np.empty(0)
    for cavitation in get_args(Cavitation):
        nodes, film, pressure = centre_line.table(cavitation)
        tables[cavitation] = {"film": film.astype(int).tolist(), "pressure": pressure.astype(int).tolist()}
    return {
        "nodes": nodes.tolist(),
        "step": centre_line.STEP,
        "intervals": centre_line.INTERVALS,
        "layer": centre_line.LAYER,
        "wider": centre_line.WIDER,
        "reach": centre_line.REACH,
        "film_error": centre_line.FILM_ERROR,
        "pressure_error": centre_line.PRESSURE_ERROR,
        "tables": tables,
    }
