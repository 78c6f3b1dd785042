"""A start of sliding, followed to a stated accuracy, and the film that results."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from softlube.discretization.measure import measure
from softlube.errors import InputError, NotConvergedError
from softlube.model.problem import Cavitation
from softlube.solvers.progress import Listener
from softlube.steady.regime import Regime
from softlube.transient.history import Transient, among_neighbours
from softlube.transient.motion import Motion
from softlube.transient.sliding.integrate import SlidingStart, deepest_problem, start_sliding

Array = NDArray[np.floating]

LADDER = (13, 19, 27, 39)
"""Angular intervals of the grids, coarse to fine."""
TOLERANCE = 0.3
"""Tolerance of a time step over the power 3/2 of the accuracy asked for: errors go with the power 2/3 of the tolerance."""
LOOSER = 4.0
"""Tolerance over that, of the run that tells the error of the time steps: the change is 1.5 times what it leaves."""
SAFETY = 1.15
"""Factor of the changes, for at least 95 % of the errors of each history to lie below them; without it 94 % of the films' do
(docs/verification.md)."""
FINEST_ACCURACY, COARSEST_ACCURACY = 1e-3, 0.1
"""Accuracies that may be asked for."""
JUDGED = ("film_center", "film_min")
"""Histories whose relative errors decide whether the grid is fine enough."""
HISTORIES = ("film_center", "film_min", "pressure_max", "height", "load", "friction_total", "friction_domain")
"""Quantities of a start of sliding that are functions of the time; see `softlube.model.quantities`.

Frictions are over r ≤ 2a.  Where the height is prescribed a = √(R × initial height); under a load a is the radius of the dry
contact on the substrate under the largest load."""


@dataclass(frozen=True, kw_only=True, repr=False)
class Slide(Transient):
    """A start of sliding: film, pressure and friction as functions of the time since a sphere began to slide.

    Its histories are those of `softlube.transient.sliding.result.HISTORIES`; `softlube.transient.history.Transient` has the
    other attributes.

    Attributes
    ----------
    run : SlidingStart
        The finest integration, normalised with the motion's unit of height.
    angles : tuple of int
        Number of angular intervals of each grid that was used, coarse to fine.
    """

    title: ClassVar[str] = "Start of sliding"
    start: ClassVar[str] = "start of the sliding"
    axes: ClassVar[tuple[str, ...]] = ("r", "theta")

    run: SlidingStart
    angles: tuple[int, ...]

    @property
    def theta(self) -> Array:
        """Angles of the grid's nodes from the inlet, 0 to π [rad]."""
        return self.run.theta

    @property
    def numerics(self) -> dict[str, Any]:
        """Angular intervals of the grids, and the number of time steps that were taken back."""
        return {"angles": list(self.angles), "rejected_steps": self.run.rejected}


def check_accuracy(accuracy: float) -> None:
    """Refuse an accuracy that is out of range.

    Raises
    ------
    InputError
        If it is not between `FINEST_ACCURACY` and `COARSEST_ACCURACY`.
    """
    if not FINEST_ACCURACY <= accuracy <= COARSEST_ACCURACY:
        raise InputError(
            f"accuracy: expected a number from {FINEST_ACCURACY:g} to {COARSEST_ACCURACY:g} with sliding, got {accuracy!r}"
        )


def measured(motion: Motion, *, beta: float, cavitation: Cavitation, **options: Any) -> tuple[SlidingStart, dict[str, Array]]:
    """One integration, and its histories.

    Parameters
    ----------
    motion, beta, cavitation, options
        As for `softlube.transient.sliding.integrate.start_sliding`.

    Returns
    -------
    run : SlidingStart
    histories : dict of str to ndarray, shape (k,)
        `HISTORIES` at the steps, normalised like the motion.
    """
    run = start_sliding(beta, motion, cavitation=cavitation, **options)
    edge = Regime.of(deepest_problem(beta, motion, cavitation)[0]).edge_radius if motion.control == "load" else 1.0
    values = [measure(fields, edge) for fields in run.fields]
    return run, {name: np.array([each[name] for each in values]) for name in HISTORIES}


def _change(time: Array, name: str, *runs: tuple[SlidingStart, dict[str, Array]]) -> Array:
    """How much two integrations differ in a history; where a film limit ended them at different times, up to the earlier."""
    until = np.minimum(time, min(run.time[-1] for run, _ in runs))
    one, other = (PchipInterpolator(run.time, histories[name])(until) for run, histories in runs)
    return np.abs(one - other)


def follow_sliding(
    motion: Motion,
    *,
    beta: float,
    pressed: float = 0.0,
    cavitation: Cavitation = "reynolds",
    film_limit: float = 0.0,
    accuracy: float = 2e-2,
    progress: Listener | None = None,
) -> Slide:
    """Follow a normalised start of sliding on ever finer grids until the films are as accurate as asked for.

    Parameters
    ----------
    motion, beta, pressed, cavitation, film_limit
        As for `softlube.transient.sliding.integrate.start_sliding`.
    accuracy : float
        Relative error of the films aimed at, at every time.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` after each time step.

    Raises
    ------
    InputError
        If an input is not as described.
    NotConvergedError
        If the accuracy is not reached.

    Notes
    -----
    The error is what the histories change by from the grid before, plus what four times the tolerance changes on the coarsest
    grid; the largest among neighbouring times, times `SAFETY`.
    """
    check_accuracy(accuracy)
    sliding: dict[str, Any] = {"beta": beta, "pressed": pressed, "cavitation": cavitation}

    tolerance = TOLERANCE * accuracy**1.5

    def run(n_theta: int, tolerance: float = tolerance) -> tuple[SlidingStart, dict[str, Array]]:
        return measured(motion, n_theta=n_theta, tolerance=tolerance, **sliding, film_limit=film_limit, progress=progress)

    coarsest = coarse = run(LADDER[0])
    loose = run(LADDER[0], LOOSER * tolerance)
    worst = np.inf
    for step, n_theta in enumerate(LADDER[1:], 2):
        fine, values = run(n_theta)
        pairs = ((fine, values), coarse), (coarsest, loose)
        errors = {
            name: SAFETY * among_neighbours(fine.time, np.sum([_change(fine.time, name, *pair) for pair in pairs], axis=0))
            for name in HISTORIES
        }
        worst = max(float(np.max(errors[name] / values[name])) for name in JUDGED)
        if worst <= accuracy:
            return Slide(
                motion=motion,
                sliding=sliding,
                run=fine,
                values=values,
                value_errors=errors,
                end_error=sum(float(abs(one[0].time[-1] - other[0].time[-1])) for one, other in pairs),
                angles=LADDER[:step],
                accuracy=accuracy,
            )
        coarse = fine, values
    raise NotConvergedError(f"the film is known to {worst:.1e} only, not to {accuracy:.1e}; ask for less")
