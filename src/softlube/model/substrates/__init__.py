"""Substrates: what the sphere slides over is the kernel that turns pressure into displacement, a module each.

Everything here is normalised: lengths in the plane with √(R × unit of height), so that the half-space of effective modulus
E* = 2G/(1 − ν) has the kernel 1/ρ, in Fourier space 2π/k, Eq. (6b) with 4G → E*.  Another substrate has 2πC(k)/k, and

    ∫₀^∞ C(k) J₀(kρ) dk = 1/ρ + ∫₀^∞ (C(k) − 1) J₀(kρ) dk,

a half-space and a smooth remainder.

A new substrate is a module here: its kernel (a `Kernel`, what the solver calls), its part (a `SubstratePart`, that declares
what is given in SI), and a test beside it.  Every module of this folder is imported, so that the part is known to
`softlube.Contact`, the command line, plans of sweeps and files.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from softlube.model.named import to_plain
from softlube.model.parts import members
from softlube.model.substrates.base import Kernel, Memory, Orders, Remainder, Substrate, SubstratePart

if TYPE_CHECKING:
    from softlube.model.substrates.half_space import HalfSpace, HalfSpaceKernel
    from softlube.model.substrates.layer import Layer, LayerKernel
    from softlube.model.substrates.viscoelastic import (
        CreepingKernel,
        Remembering,
        RememberingKernel,
        StandardLinearSolid,
        Viscoelastic,
        ViscoelasticKernel,
    )

__all__ = [
    "CreepingKernel",
    "HalfSpace",
    "HalfSpaceKernel",
    "Kernel",
    "Layer",
    "LayerKernel",
    "Memory",
    "Orders",
    "Remainder",
    "Remembering",
    "RememberingKernel",
    "StandardLinearSolid",
    "Substrate",
    "SubstratePart",
    "Viscoelastic",
    "ViscoelasticKernel",
    "from_plain",
    "to_plain",
]

from_plain = Kernel.from_plain
globals().update(members(__name__, __path__, (Kernel, SubstratePart)))
