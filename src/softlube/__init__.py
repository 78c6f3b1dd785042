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

if TYPE_CHECKING:
    from softlube.approach.physical import squeeze
    from softlube.approach.result import Squeeze
    from softlube.contact import Contact
    from softlube.errors import InputError, NotConvergedError, SoftlubeError
    from softlube.experiments import fit
    from softlube.io import load
    from softlube.measurements import Measurements, read_measurements
    from softlube.problem import Problem
    from softlube.rig import Rig
    from softlube.solution import Quantity, Solution
    from softlube.solver import solve
    from softlube.stribeck import stribeck_curve
    from softlube.sweeps import sweep

__version__ = "0.2.0.dev0"

# Names are imported when first used: the command line answers --help without NumPy.
_HOME = {
    "Contact": "contact",
    "InputError": "errors",
    "Measurements": "measurements",
    "NotConvergedError": "errors",
    "Problem": "problem",
    "Quantity": "solution",
    "SoftlubeError": "errors",
    "Solution": "solution",
    "fit": "experiments",
    "Squeeze": "approach.result",
    "load": "io",
    "read_measurements": "measurements",
    "Rig": "rig",
    "solve": "solver",
    "stribeck_curve": "stribeck",
    "sweep": "sweeps",
    "squeeze": "approach.physical",
}

__all__ = [
    "Contact",
    "InputError",
    "Measurements",
    "NotConvergedError",
    "Problem",
    "Quantity",
    "Rig",
    "SoftlubeError",
    "Solution",
    "Squeeze",
    "__version__",
    "fit",
    "load",
    "read_measurements",
    "solve",
    "squeeze",
    "stribeck_curve",
    "sweep",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
