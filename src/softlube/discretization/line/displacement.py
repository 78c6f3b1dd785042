"""Displacement of the surface under a line contact, as matrices on the pressure or on its gradient."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.special import hyperu

from softlube.discretization.line.memory import remembered
from softlube.discretization.line.panels import Panels
from softlube.discretization.line.potential import log_potential
from softlube.discretization.line.remainder import remainder_potential
from softlube.model.substrates import Substrate

Array = NDArray[np.floating]


@dataclass(frozen=True, eq=False)
class Displacement:
    """Displacement w at the nodes of a mesh and at its downstream end.

    Parameters
    ----------
    panels : Panels
        The mesh.
    by_pressure : ndarray, shape (size + 1, number, points + 1)
        From Legendre coefficients of the pressure on the panels to w, the downstream end last.
    """

    panels: Panels
    by_pressure: Array

    @cached_property
    def places(self) -> Array:
        """Places s of the rows, shape (size + 1,)."""
        return rows_of(self.panels)

    @cached_property
    def matrix(self) -> Array:
        """From p′ at the nodes to w, if the pressure vanishes at both ends, shape (size + 1, size)."""
        return self.panels.through_integration(self.by_pressure)

    @cached_property
    def of_ends(self) -> Array:
        """From the pressures at the two ends to w, shape (size + 1, 2)."""
        return self.panels.of_ends(self.by_pressure)

    @cached_property
    def _load(self) -> Array:
        rows = np.zeros((1, self.panels.number, self.panels.points + 1))
        rows[0, :, 0] = 2 * self.panels.half
        return rows

    @cached_property
    def load(self) -> Array:
        """From p′ at the nodes to ∫ p ds, if the pressure vanishes at both ends, shape (size,)."""
        return self.panels.through_integration(self._load)[0]

    @cached_property
    def load_of_ends(self) -> Array:
        """From the pressures at the two ends to ∫ p ds, shape (2,)."""
        return self.panels.of_ends(self._load)[0]

    def of(self, gradient: Array, ends: Array) -> Array:
        """W of a pressure with some gradient at the nodes and some values at the two ends."""
        return self.matrix @ gradient + self.of_ends @ ends


def rows_of(panels: Panels) -> Array:
    """Places s at which displacements are given: the nodes, then the downstream end."""
    return np.append(panels.nodes, panels.edges[0])


def displacement(substrate: Substrate, panels: Panels) -> Displacement:
    """Displacement of a substrate on the mesh that has the pressure."""
    return Displacement(panels, surface(substrate, panels, panels))


def surface(substrate: Substrate, loaded: Panels, targets: Panels) -> Array:
    """Displacement of a substrate's surface on a mesh that may reach further downstream than the pressure.

    The half-plane's is 2∫ p(s′) ln|s − s′| ds′, up to a constant that depends on the unit of length alone.  A substrate that
    remembers has J₀ times it, and Jᵢ times what `softlube.discretization.line.memory` makes of it.

    Parameters
    ----------
    substrate : Substrate
        Normalised with b²/R.
    loaded : Panels
        The mesh of the pressure.
    targets : Panels
        Where the displacement is wanted; with the same upstream end.

    Returns
    -------
    ndarray, shape (targets.size + 1, loaded.number, loaded.points + 1)
        From Legendre coefficients of the pressure to w at `rows_of` the targets.
    """
    places = np.append(rows_of(targets), loaded.edges[-1])
    elastic = 2 * log_potential(loaded, places, loaded.points)
    if substrate.remainder is not None:
        elastic -= remainder_potential(substrate, loaded, places, loaded.points)
    memory = substrate.memory
    if memory is None:
        return elastic[:-1]
    shape = (targets.size + 1, loaded.number, loaded.points + 1)
    convolution, result = np.zeros((targets.size + 1, targets.size)), memory.instantaneous * elastic[:-1]
    for share, length in zip(memory.shares, memory.lengths, strict=True):
        if length == 0:
            result += share * elastic[:-1]
            continue
        matrix, left = remembered(targets, length)
        convolution += share * matrix
        # Upstream of the mesh the elastic displacement rises by 2 ln of the distance, times the load.
        ahead = elastic[-1].copy()
        ahead[:, 0] += 4 * loaded.half * hyperu(1, 1, loaded.edges[-1] / length)
        result += share * left[:, None, None] * ahead
    return result + (convolution @ elastic[: targets.size].reshape(targets.size, -1)).reshape(shape)
