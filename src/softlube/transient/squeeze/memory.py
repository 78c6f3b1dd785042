"""What a viscoelastic substrate remembers of the pressure of a squeeze film: internal variables in time, a set for each term.

Of the creep compliance J₀ + ΣJᵢ (1 − e^(−t/τᵢ)) each term remembers pᵢ with τᵢ dpᵢ/dt = p − pᵢ, and the displacement is that of
the pressure J₀ p + ΣJᵢ pᵢ.  Under a load each remembers that, too: so the height is known without a sum over all rings, and
what one ring remembers changes its neighbours' films only, which keeps the Jacobian sparse.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_array, csc_array, eye_array, kron

from softlube.transient.squeeze.rings import SqueezeFilm

Array = NDArray[np.floating]


@dataclass(frozen=True)
class Memory:
    """The internal variables of a squeeze film: w numbers for each of m terms, none on an elastic substrate.

    The w numbers are the pressure on the n rings and, under a load, the load.

    Attributes
    ----------
    film : SqueezeFilm
        The discrete equations.  Their state is the lift on n rings, and then ΣJᵢ times what each term remembers.
    """

    film: SqueezeFilm

    @cached_property
    def shares(self) -> Array:
        """Compliances Jᵢ over the relaxed one, shape (m,)."""
        return np.array([term.weight for term in self.film.creep.terms])

    @cached_property
    def rates(self) -> Array:
        """Inverse times 1/τᵢ, shape (m, 1)."""
        return np.array([1 / term.time for term in self.film.creep.terms])[:, None]

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers m and w."""
        return self.shares.size, self.film.pressure_by_state.shape[1] - self.film.n

    @cached_property
    def _acting(self) -> tuple[Array, Array]:
        """Pressure and load that act now, by the state, (w, k), and by the drive, (w,)."""
        n, (_, width) = self.film.n, self.shape
        by_state, by_drive = np.zeros((width, n + width)), np.ones(width)
        by_state[:n], by_drive[:n] = self.film.pressure_by_state[: min(n, width)], self.film.pressure_by_drive[: min(n, width)]
        return by_state, by_drive

    def at_first(self, pressures: Array) -> Array:
        """Internal variables, (m w,), of terms that remember the pressures of the shape (m, N) on all rings."""
        own = pressures[:, : self.film.n]
        return np.column_stack([own, own @ self.film.ring_weights])[:, : self.shape[1]].ravel()

    def round_off(self, lift: Array) -> Array:
        """Round-off of the pressure and load that act now, where the lift is kept as large as given, shape (m w,)."""
        by_state, _ = self._acting
        own = np.finfo(float).eps * np.abs(by_state[:, : self.film.n]) @ np.abs(lift)
        return np.tile(own, self.shape[0])

    @cached_property
    def elastic(self) -> bool:
        """Whether there are none."""
        return not self.film.creep.terms

    def state(self, lift: Array, remembered: Array) -> Array:
        """State of the film, (..., k), from lifts on n rings, (..., n), and internal variables, (..., m w)."""
        if self.elastic:
            return lift
        return np.concatenate([lift, self.shares @ remembered.reshape(*lift.shape[:-1], *self.shape)], axis=-1)

    def rate(self, flow: Array, remembered: Array, state: Array, drive: float) -> Array:
        """Change of all unknowns in time: that of film and inflow, shape (n + 1,), and that of the internal variables."""
        if self.elastic:
            return flow
        by_state, by_drive = self._acting
        change = self.rates * (by_state @ state + drive * by_drive - remembered.reshape(self.shape))
        return np.concatenate([flow, change.ravel()])

    @cached_property
    def _rate_by_unknowns(self) -> tuple[csc_array, csc_array]:
        """Derivatives of the internal variables' change by the lift, (m w, n), and by the internal variables, (m w, m w)."""
        n, by_state = self.film.n, self._acting[0]
        own = kron(csc_array(np.diag(self.rates[:, 0])), eye_array(self.shape[1]))
        others = kron(csc_array(self.rates * self.shares), csc_array(by_state[:, n:]))
        return csc_array(kron(csc_array(self.rates), csc_array(by_state[:, :n]))), csc_array(others - own)

    def jacobian(self, film: Array, inflow: Array) -> Array | csc_array:
        """Derivative of `rate` by all unknowns: lift, inflow, internal variables.

        Parameters
        ----------
        film, inflow : ndarray, shape (n, k) and (k,)
            Derivatives of the film's change and of the inflow by the state.

        Returns
        -------
        ndarray or sparse array, shape (n + 1 + m w, n + 1 + m w)
            An ndarray on an elastic substrate.
        """
        n, (terms, width) = self.film.n, self.shape
        by_film = np.zeros((n + 1, n + 1))
        by_film[:n, :n], by_film[n, :n] = film[:, :n], inflow[:n]
        if self.elastic:
            return by_film
        by_lift, by_remembered = self._rate_by_unknowns
        flow = kron(csc_array(self.shares[None, :]), csc_array(np.vstack([film[:, n:], inflow[n:]])))
        by_lift = block_array([[by_lift, csc_array((terms * width, 1))]])  # the inflow moves nothing
        return csc_array(block_array([[csc_array(by_film), flow], [by_lift, by_remembered]]))
