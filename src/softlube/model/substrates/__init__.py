"""Substrates: what the sphere slides over is the kernel that turns pressure into displacement, a module each.

Everything here is normalised: lengths in the plane with √(R × unit of height), so that the half-space of effective modulus
E* = 2G/(1 − ν) has the kernel 1/ρ, in Fourier space 2π/k, Eq. (6b) with 4G → E*.  Another substrate has 2πC(k)/k, and

    ∫₀^∞ C(k) J₀(kρ) dk = 1/ρ + ∫₀^∞ (C(k) − 1) J₀(kρ) dk,

a half-space and a smooth remainder.
"""

from softlube.model.substrates.base import Kernel, Orders, Remainder, Substrate, from_plain, to_plain
from softlube.model.substrates.half_space import HalfSpaceKernel
from softlube.model.substrates.layer import LayerKernel

__all__ = ["HalfSpaceKernel", "Kernel", "LayerKernel", "Orders", "Remainder", "Substrate", "from_plain", "to_plain"]
