"""softlube: lubricated sliding of a rigid sphere on a soft elastic substrate.

>>> import softlube
>>> contact = softlube.Contact(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", speed="0.1 mm/s", load="100 mN")
>>> solution = contact.solve()
>>> round(solution.dimensional["film_center"] * 1e9)  # nm
174
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from softlube.model.lazy import readers as _readers

if TYPE_CHECKING:
    from softlube.errors import InputError, NotConvergedError, SoftlubeError, ValidityWarning
    from softlube.experiments.approach import slide, squeeze
    from softlube.experiments.fit import Fit, fit
    from softlube.experiments.flow_curve import FlowCurve, read_flow_curve
    from softlube.experiments.measurements import Measurements, read_measurements
    from softlube.experiments.moduli import Moduli, read_moduli
    from softlube.experiments.rheometer import LiquidFit, fit_liquid
    from softlube.experiments.stribeck import StribeckCurve, stribeck_curve
    from softlube.experiments.substrate_fit import SubstrateFit, fit_substrate
    from softlube.files.histories import read_history
    from softlube.files.netcdf import load
    from softlube.model import dry, liquids, substrates
    from softlube.model.cylinders import Cylinder
    from softlube.model.indenters import PowerProfile, Profile, RoundedCone, RoundedPunch, Sphere
    from softlube.model.liquids import (
        Barus,
        Carreau,
        CarreauYasuda,
        Cross,
        DowsonHigginson,
        Eyring,
        Incompressible,
        LimitingStress,
        Newtonian,
        PowerLaw,
        Roelands,
    )
    from softlube.model.motions import Rolling, Sliding
    from softlube.model.problem import Problem
    from softlube.model.quantities import Quantity
    from softlube.model.substrates import HalfSpace, Layer, StandardLinearSolid, Viscoelastic
    from softlube.physical import line
    from softlube.physical.contact import Contact
    from softlube.physical.line import LineContact
    from softlube.physical.rig import Rig
    from softlube.physical.squeeze import History
    from softlube.readout import flow, free_boundary, friction
    from softlube.steady.dry_sliding import DrySliding, dry_sliding
    from softlube.steady.solution import Solution
    from softlube.steady.solve import solve
    from softlube.sweeps import Sweep, sweep
    from softlube.theory import engineering, inlet, limits, scaling, side
    from softlube.theory import master_curve as curve
    from softlube.transient.sliding.result import Slide
    from softlube.transient.squeeze.result import Squeeze

__version__ = "0.3.0"

# Names are imported when first used: the command line answers --help without NumPy.
_NAMES = {
    "Contact": "physical.contact",
    "DrySliding": "steady.dry_sliding",
    "dry_sliding": "steady.dry_sliding",
    "Fit": "experiments.fit",
    "FlowCurve": "experiments.flow_curve",
    "History": "physical.squeeze",
    "InputError": "errors",
    "LineContact": "physical.line",
    "LiquidFit": "experiments.rheometer",
    "Measurements": "experiments.measurements",
    "Moduli": "experiments.moduli",
    "NotConvergedError": "errors",
    "Problem": "model.problem",
    "Quantity": "model.quantities",
    "Rig": "physical.rig",
    "Slide": "transient.sliding.result",
    "SoftlubeError": "errors",
    "Solution": "steady.solution",
    "Squeeze": "transient.squeeze.result",
    "StribeckCurve": "experiments.stribeck",
    "SubstrateFit": "experiments.substrate_fit",
    "Sweep": "sweeps",
    "ValidityWarning": "errors",
    "fit": "experiments.fit",
    "fit_liquid": "experiments.rheometer",
    "fit_substrate": "experiments.substrate_fit",
    "load": "files.netcdf",
    "read_flow_curve": "experiments.flow_curve",
    "read_history": "files.histories",
    "read_measurements": "experiments.measurements",
    "read_moduli": "experiments.moduli",
    "slide": "experiments.approach",
    "solve": "steady.solve",
    "squeeze": "experiments.approach",
    "stribeck_curve": "experiments.stribeck",
    "sweep": "sweeps",
}
_MODULES = {
    "curve": "theory.master_curve",
    "dry": "model.dry",
    "engineering": "theory.engineering",
    "flow": "readout.flow",
    "free_boundary": "readout.free_boundary",
    "friction": "readout.friction",
    "inlet": "theory.inlet",
    "limits": "theory.limits",
    "line": "physical.line",
    "liquids": "model.liquids",
    "scaling": "theory.scaling",
    "side": "theory.side",
    "substrates": "model.substrates",
}

__all__ = [
    "Barus",
    "Carreau",
    "CarreauYasuda",
    "Contact",
    "Cross",
    "Cylinder",
    "DowsonHigginson",
    "DrySliding",
    "Eyring",
    "Fit",
    "FlowCurve",
    "HalfSpace",
    "History",
    "Incompressible",
    "InputError",
    "Layer",
    "LimitingStress",
    "LineContact",
    "LiquidFit",
    "Measurements",
    "Moduli",
    "Newtonian",
    "NotConvergedError",
    "PowerLaw",
    "PowerProfile",
    "Problem",
    "Profile",
    "Quantity",
    "Rig",
    "Roelands",
    "Rolling",
    "RoundedCone",
    "RoundedPunch",
    "Slide",
    "Sliding",
    "SoftlubeError",
    "Solution",
    "Sphere",
    "Squeeze",
    "StandardLinearSolid",
    "StribeckCurve",
    "SubstrateFit",
    "Sweep",
    "ValidityWarning",
    "Viscoelastic",
    "__version__",
    "curve",
    "dry",
    "dry_sliding",
    "engineering",
    "fit",
    "fit_liquid",
    "fit_substrate",
    "flow",
    "free_boundary",
    "friction",
    "inlet",
    "limits",
    "line",
    "liquids",
    "load",
    "read_flow_curve",
    "read_history",
    "read_measurements",
    "read_moduli",
    "scaling",
    "side",
    "slide",
    "solve",
    "squeeze",
    "stribeck_curve",
    "substrates",
    "sweep",
]


if not TYPE_CHECKING:  # a checker of types reads the imports above, and finds a name that is none of them

    def __getattr__(name: str) -> Any:
        if name in _MODULES:
            return import_module(f"{__name__}.{_MODULES[name]}")
        if name in _NAMES:
            return getattr(import_module(f"{__name__}.{_NAMES[name]}"), name)
        if name in (parts := _parts()):
            return parts[name]
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def _read_profile(path: str) -> Any:
    """Radii and heights of the CSV file of an indenter's profile."""
    return import_module(f"{__name__}.files.profiles").read_profile(path)


_readers["profile"] = _read_profile


def __dir__() -> list[str]:
    return sorted({*__all__, *_parts()})


def _parts() -> dict[str, Any]:
    """Parts of an experiment by the names of their classes: whatever stands in the rooms of `softlube.model`."""
    import_module(f"{__name__}.physical.inputs")
    part = import_module(f"{__name__}.model.parts").Part
    kinds = [kind for slots in (part.slots, part.additions) for kinds in slots.values() for kind in kinds.values()]
    return {kind.__name__: kind for kind in kinds if kind.__module__.startswith(f"{__name__}.")}
