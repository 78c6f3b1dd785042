"""The paper's iteration, section 2.5 and Fig. 4: forward relaxation (19), marched in β, with its control of the factor.

Knows nothing of meshes: a `Scheme` gives the film and makes the sweep.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from softlube.errors import NotConvergedError
from softlube.model.exact import HERTZ_PRESSURE
from softlube.solvers.progress import Listener, Progress

Array = NDArray[np.float64]

FIRST_BETA = 10.0
"""β₀, where the march starts."""
BETA_STEP = 3.2
"""Largest ratio of successive β in the march."""
FIRST_FACTOR = 1.4
"""Relaxation factor at β₀."""
CUT = 0.4
"""What remains of the factor after a cut "by 60 %"."""
SMALLEST_FACTOR = 1e-3
"""Below this factor the march gives up; the paper stays above 0.1, on a mesh it does not print."""
GROWTH = 10.0
"""The relative change counts as growing at this multiple of its smallest value so far."""
PATIENCE = 40
"""Sweeps times factor, at least 300 sweeps, in which the mean change has to fall by a tenth, or else it has stalled."""
WINDOW = 50
"""Sweeps over which the rate of convergence is measured."""
REYNOLDS_FLOORS = (0.0,)
"""Smallest pressure allowed under the Reynolds condition."""
SOMMERFELD_FLOORS = (0.0, -HERTZ_PRESSURE / 8, -HERTZ_PRESSURE / 4, -HERTZ_PRESSURE / 2, -math.inf)
"""Smallest pressures allowed, step by step, on the way to none: suction let loose at once pulls the surfaces together."""
GUESS_RADIUS = 1.8
"""Where the first guess ends.  The Hertz load spread to here holds the sphere off everywhere: u = 0.14 or more."""

Outcome = Literal["converged", "grew", "touched", "stalled", "stopped"]


class Scheme(Protocol):
    """A discretisation of the contact, polar or Cartesian."""

    def film(self, pressure: Array) -> Array:
        """Film thickness u = h − w on the nodes; Eqs. (6b), (6c)."""
        ...

    def sweep(self, pressure: Array, film: Array, beta: float, factor: float, *, floor: float) -> Array:
        """New pressure after one sweep (19) with a frozen film, cut off at the floor: 0 for the Reynolds condition."""
        ...


@dataclass(frozen=True)
class Sweeps:
    """One run of sweeps at one β with one relaxation factor.

    Attributes
    ----------
    beta, factor, floor : float
        β, relaxation factor, smallest pressure allowed.
    changes : tuple of float
        Relative change Σ|p_new − p_old| / Σ|p_old| of each sweep.
    outcome : str
        "converged"; or why the run ended otherwise: the change "grew", the surfaces "touched" (u ≤ 0), the change "stalled"
        (no longer fell), or the sweeps ran out ("stopped").
    """

    beta: float
    factor: float
    floor: float
    changes: tuple[float, ...]
    outcome: Outcome

    @property
    def count(self) -> int:
        """Number of sweeps."""
        return len(self.changes)

    def summary(self) -> dict[str, float | int | str | None]:
        """The run in a few plain values: without the changes but the last, and with null for no floor."""
        return {
            "beta": self.beta,
            "factor": self.factor,
            "floor": self.floor if math.isfinite(self.floor) else None,
            "sweeps": self.count,
            "last_change": self.changes[-1] if self.changes else None,
            "outcome": self.outcome,
        }

    def __str__(self) -> str:
        last = f"{self.changes[-1]:.1e}" if self.changes else "none"
        condition = f", p >= {self.floor:.2g}" if self.floor < 0 else ""
        how = f"beta {self.beta:.4g}, factor {self.factor:.3g}{condition}"
        return f"{how}: {self.count} sweeps, last change {last}, {self.outcome}"


class RelaxationError(NotConvergedError):
    """The relaxation did not converge.

    Attributes
    ----------
    history : tuple of Sweeps
        Every run of sweeps up to the failure.
    """

    def __init__(self, message: str, history: tuple[Sweeps, ...]) -> None:
        super().__init__(message)
        self.history = history


def first_guess(r: Array) -> Array:
    """Hertz pressure made smooth: p̄_H(0) times the polynomial of fifth degree 1 − 10t³ + 15t⁴ − 6t⁵, t = r/GUESS_RADIUS.

    Continuously differentiable, as the paper asks of its (unprinted) polynomial, at the centre and where it ends.
    """
    t = np.minimum(r / GUESS_RADIUS, 1)
    return HERTZ_PRESSURE * (1 - t**3 * (10 - 15 * t + 6 * t**2))


def remaining_error(changes: list[float]) -> float:
    """Relative error left in p, the tail of the geometric series that the last sweeps' changes suggest; ∞ if unknown.

    A small factor makes small changes whether or not the end is near, so that the change alone cannot say when to stop.
    """
    if len(changes) < 2 * WINDOW:
        return math.inf
    recent, before = sum(changes[-WINDOW:]), sum(changes[-2 * WINDOW : -WINDOW])
    if recent >= before:
        return math.inf
    return recent / WINDOW / (1 - (recent / before) ** (1 / WINDOW))


def _flat(changes: list[float], window: int) -> bool:
    """Whether the mean change over the last window is about that over the one before."""
    return sum(changes[-window:]) > 0.9 * sum(changes[-2 * window : -window])


def relax(
    scheme: Scheme, start: Array, beta: float, factor: float, *, floor: float, tolerance: float, max_sweeps: int
) -> tuple[Array, Sweeps]:
    """Sweep at one β with one factor until the end is clear.

    Parameters
    ----------
    scheme : Scheme
        The discretisation.
    start : ndarray
        Pressure to start from; not changed.
    beta, factor : float
        β and the relaxation factor λ of (19).
    floor : float
        Smallest pressure allowed; 0 is the Reynolds condition.
    tolerance : float
        `remaining_error` at which the run has converged.
    max_sweeps : int
        Most sweeps to make.

    Returns
    -------
    pressure : ndarray
        The last one; a solution only if the outcome is "converged".
    sweeps : Sweeps
    """
    pressure, changes = start, []
    smallest = math.inf
    patience = max(300, round(PATIENCE / factor))

    def ended(outcome: Outcome) -> tuple[Array, Sweeps]:
        return pressure, Sweeps(beta, factor, floor, tuple(changes), outcome)

    for n in range(max_sweeps):
        film = scheme.film(pressure)
        if not film.min() > 0:
            return ended("touched")
        new = scheme.sweep(pressure, film, beta, factor, floor=floor)
        change = float(np.abs(new - pressure).sum() / np.abs(pressure).sum())
        changes.append(change)
        if not change <= GROWTH * smallest:
            return ended("grew")
        pressure = new
        smallest = min(smallest, change)
        if n % patience == 0 and n >= 2 * patience and _flat(changes, patience):
            return ended("stalled")
        if change < tolerance and remaining_error(changes) < tolerance:
            return ended("converged")
    return ended("stopped")


def approach(beta: float) -> list[float]:
    """The march's β: from β₀ to `beta` in equal ratios of at most BETA_STEP."""
    steps = math.ceil(math.log(beta / FIRST_BETA) / math.log(BETA_STEP) - 1e-9)
    return [float(stage) for stage in np.geomspace(FIRST_BETA, beta, steps + 1)] if steps > 0 else [beta]


def march(
    scheme: Scheme,
    guess: Array,
    betas: Sequence[float],
    *,
    floors: Sequence[float] = REYNOLDS_FLOORS,
    tolerance: float = 1e-4,
    max_sweeps: int = 250_000,
    progress: Listener | None = None,
) -> Iterator[tuple[Array, tuple[Sweeps, ...]]]:
    """March through increasing β, each solution starting the next; cut the factor and restart where the change grows.

    Parameters
    ----------
    scheme : Scheme
        The discretisation.
    guess : ndarray
        Pressure to start from at the first β.
    betas : sequence of float
        See `approach`.  A single large β is a cold start.
    floors : sequence of float
        Floors of the pressure, gone through at every β: REYNOLDS_FLOORS or SOMMERFELD_FLOORS.  The solution on the first one
        starts the next β.
    tolerance : float
        Relative error of the pressure left by the iteration, `remaining_error`.
    max_sweeps : int
        For the whole march.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each run of sweeps.

    Yields
    ------
    pressure : ndarray
        The solution at the next β.
    history : tuple of Sweeps
        Every run of sweeps since the last solution.

    Raises
    ------
    RelaxationError
        If the sweeps run out, or the factor has been cut below SMALLEST_FACTOR.
    """
    history: list[Sweeps] = []
    pressure, start, factor = guess, guess, FIRST_FACTOR
    for beta in betas:
        told = len(history)
        for floor in floors:
            while True:
                left = max_sweeps - sum(run.count for run in history)
                new, run = relax(scheme, pressure, beta, factor, floor=floor, tolerance=tolerance, max_sweeps=left)
                history.append(run)
                if progress is not None:
                    progress(Progress(str(run), len(history)))
                if run.outcome == "converged":
                    break
                if run.outcome == "stopped" or factor * CUT < SMALLEST_FACTOR:
                    raise RelaxationError(_failure(beta, history), tuple(history))
                factor *= CUT
            pressure = new
            if floor == floors[0]:
                # The next β starts from here: suction that fits one β can make the surfaces touch at the next.
                start = new
        yield pressure, tuple(history[told:])
        pressure = start


def _failure(beta: float, history: list[Sweeps]) -> str:
    sweeps = sum(run.count for run in history)
    reached = [run.beta for run in history if run.outcome == "converged"]
    restarts = sum(run.outcome != "converged" for run in history[:-1])
    done = f"the march reached beta = {max(reached):.4g}" if reached else "no beta converged"
    return (
        f"the paper's relaxation did not converge at beta = {beta:.4g}: {done} after {sweeps} sweeps and "
        f"{restarts} restarts. Last run: {history[-1]}. It is known to work for 10 <= beta <= 1e4 on about 50 x 30 nodes; "
        "the default method reaches further."
    )
