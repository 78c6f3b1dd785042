"""What a viscoelastic substrate remembers of a squeeze film's pressure: internal variables in time, one set for each term.

Of the creep compliance J₀ + ΣJᵢ (1 − e^(−t/τᵢ)) each term remembers pᵢ with τᵢ dpᵢ/dt = p − pᵢ, and the displacement is that of
the pressure J₀ p + ΣJᵢ pᵢ.  Under a load N each remembers ∫pᵢ dA, too, of which the height is known without a sum over all rings.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_array, csc_array, diags_array, kron

from softlube.transient.squeeze.rings import SqueezeFilm

Array = NDArray[np.floating]


@dataclass(frozen=True)
class Memory:
    """The internal variables of a squeeze film: m terms of w numbers each, none on an elastic substrate.

    Attributes
    ----------
    film : SqueezeFilm
        The discrete equations: its state is the lift and ΣJᵢ times what each term remembers.
    """

    film: SqueezeFilm

    @cached_property
    def shares(self) -> Array:
        """Compliances Jᵢ over the relaxed one, shape (m,)."""
        return np.array([term.weight for term in self.film.creep.terms])

    @cached_property
    def times(self) -> Array:
        """Times τᵢ in which they build up, shape (m, 1)."""
        return np.array([[term.time] for term in self.film.creep.terms]).reshape(-1, 1)

    @property
    def shape(self) -> tuple[int, int]:
        """m and w: the pressure on n rings, and under a load the load."""
        return self.shares.size, self.film.pressure_by_state.shape[1] - self.film.n

    @cached_property
    def _acting(self) -> tuple[Array, Array]:
        """Pressure and load that act, by the state, (w, k), and by the drive, (w,)."""
        n, (_, width) = self.film.n, self.shape
        by_load = width - n if width else 0
        by_state, by_drive = self.film.pressure_by_state[: min(n, width)], self.film.pressure_by_drive[: min(n, width)]
        return np.vstack([by_state, np.zeros((by_load, by_state.shape[1]))]), np.append(by_drive, np.ones(by_load))

    def at_first(self, pressures: Array) -> Array:
        """What is remembered where each term has a pressure of its own on all N rings, shape (m, N); shape (m, w)."""
        own = pressures[:, : self.film.n]
        return np.column_stack([own, own @ self.film.ring_weights])[:, : self.shape[1]]

    def state(self, lift: Array, remembered: Array) -> Array:
        """State of the film, (..., k), of lifts on n rings, (..., n), and of what is remembered, (..., m w)."""
        return np.concatenate([lift, self.shares @ remembered.reshape(*lift.shape[:-1], *self.shape)], axis=-1)

    def rate(self, remembered: Array, state: Array, drive: float) -> Array:
        """Its change in time, shape (m w,)."""
        by_state, by_drive = self._acting
        return ((by_state @ state + drive * by_drive - remembered.reshape(self.shape)) / self.times).ravel()

    @cached_property
    def _rate_by_unknowns(self) -> tuple[csc_array, csc_array]:
        """∂rate by the lift, (m w, n), and by what is remembered, (m w, m w)."""
        by_state, _ = self._acting
        n, (terms, width) = self.film.n, self.shape
        own = -kron(diags_array(1 / self.times[:, 0]), diags_array(np.ones(width)))
        others = kron(csc_array(self.shares / self.times), csc_array(by_state[:, n:]))
        return csc_array(kron(csc_array(1 / self.times), csc_array(by_state[:, :n]))), csc_array(own + others)

    def jacobian(self, flow_by_state: Array) -> Array | csc_array:
        """Jacobian of all unknowns: film and inflow, then what is remembered.

        Parameters
        ----------
        flow_by_state : ndarray, shape (n + 1, k)
            Derivative of the film's change and of the inflow by the state.

        Returns
        -------
        ndarray or sparse array, shape (n + 1 + m w, n + 1 + m w)
            Dense on an elastic substrate.
        """
        n, (terms, _) = self.film.n, self.shape
        by_film = np.column_stack([flow_by_state[:, :n], np.zeros(n + 1)])  # the inflow moves nothing
        if not terms:
            return by_film
        by_lift, by_remembered = self._rate_by_unknowns
        inflow = csc_array((by_lift.shape[0], 1))
        return csc_array(
            block_array(
                [
                    [csc_array(by_film), kron(csc_array(self.shares[None, :]), csc_array(flow_by_state[:, n:]))],
                    [block_array([[by_lift, inflow]]), by_remembered],
                ]
            )
        )
