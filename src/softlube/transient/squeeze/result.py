"""A motion without sliding, followed to a stated accuracy, and the squeeze film that results."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from softlube.errors import InputError, NotConvergedError
from softlube.solvers.progress import Listener
from softlube.transient.history import Transient
from softlube.transient.motion import Motion
from softlube.transient.squeeze.integrate import HISTORIES, Run, integrate

Array = NDArray[np.floating]

LADDER = (64, 91, 128, 181, 256)
"""Rings of the grids, coarse to fine."""
TOLERANCE = 1e-3
"""Tolerance of the integrator over the accuracy asked for: errors of several hundred steps add up."""
LEAST_ERROR = 10.0
"""Least relative error that is stated, over the tolerance of the integrator."""
FINEST_ACCURACY, COARSEST_ACCURACY = 1e-5, 0.1
"""Accuracies that may be asked for."""
RIGID = 100.0
"""Least deflection of the substrate over the film, over the tolerance: with less the film does not determine the pressure."""
DIMPLE_RADIUS = 0.05
"""Radius at which the film is thinnest, over the contact radius, above which there is a dimple."""
JUDGED = ("film_center", "film_min")
"""Histories whose relative errors decide whether the grid is fine enough."""


@dataclass(frozen=True, kw_only=True, repr=False)
class Squeeze(Transient):
    """A squeeze film: film, pressure and load as functions of the time while a sphere comes down or is pulled away.

    Its histories are those of `softlube.transient.squeeze.integrate.HISTORIES`; `softlube.transient.history.Transient` has the
    other attributes.

    Attributes
    ----------
    run : Run
        The finest integration, normalised (see `softlube.transient.squeeze.rings`).
    rings : tuple of int
        Number of rings of each grid that was used, coarse to fine.
    """

    title: ClassVar[str] = "Normal approach of a rigid sphere to a soft substrate through a film"
    start: ClassVar[str] = "start"
    axes: ClassVar[tuple[str, ...]] = ("r",)
    balance: ClassVar[tuple[str, ...]] = ("volume", "inflow")

    run: Run
    rings: tuple[int, ...]

    @property
    def dimple_time(self) -> float:
        """Time at which the minimum of the film leaves the axis for good; nan if it never does."""
        radius = self.values["film_min_radius"] / self.run.film.grid.edge
        if radius[-1] <= DIMPLE_RADIUS:
            return float("nan")
        on_axis = np.flatnonzero(radius <= DIMPLE_RADIUS)
        if not on_axis.size:
            return float(self.time[0])
        # The radius grows like the root of the time since then: a straight line through its squares at the first two steps.
        first = min(on_axis[-1] + 1, radius.size - 2)
        square, time = radius[first : first + 2] ** 2, self.time[first : first + 2]
        born = time[0] - square[0] * (time[1] - time[0]) / max(square[1] - square[0], 1e-300)
        return float(np.clip(born, self.time[max(on_axis[-1] - 1, 0)], self.time[on_axis[-1] + 1]))

    @property
    def numerics(self) -> dict[str, Any]:
        """Rings of the grids, and the defect of the balance of volume over the largest change of the volume."""
        return {"volume_error": self.run.volume_error, "rings": list(self.rings)}

    def to_dict(self) -> dict[str, Any]:
        """Final values, the dimple's time and what the computation took, ready for JSON."""
        return super().to_dict() | {"dimple_time": None if np.isnan(self.dimple_time) else self.dimple_time}


def follow(
    motion: Motion,
    *,
    accuracy: float = 1e-3,
    film_limit: float = 0.0,
    progress: Listener | None = None,
) -> Squeeze:
    """Follow a normalised motion without sliding on ever finer grids until the films are as accurate as asked for.

    Parameters
    ----------
    motion : Motion
        What moves the sphere, and over what.
    accuracy : float
        Relative error of the films aimed at, at every time.
    film_limit : float
        Minimum film at which to stop.
    progress : callable, optional
        Called with a `softlube.solvers.progress.Progress` every 20 time steps.

    Raises
    ------
    InputError
        If an input is not as described, or the substrate is as good as rigid.
    NotConvergedError
        If no grid reaches the accuracy, or the integration fails.

    Notes
    -----
    The error is what the films change by from the grid before, plus what four times the tolerance changes on that grid; both
    changes are several times the error that they leave.

    Examples
    --------
    A light sphere falls nearly by Taylor's law for a rigid one, load = πV/(2h₀), until the film limit:

    >>> from math import log, pi
    >>> from softlube.transient.motion import constant_load
    >>> fall = follow(constant_load(1e-3, initial_height=1.0, duration=4e3), film_limit=0.5)
    >>> bool(abs(fall.time[-1] * 1e-3 / (pi / 2 * log(2)) - 1) < 5e-3), fall.run.ended_by
    (True, 'film_limit')
    """
    if not FINEST_ACCURACY <= accuracy <= COARSEST_ACCURACY:
        raise InputError(f"accuracy: expected a number from {FINEST_ACCURACY:g} to {COARSEST_ACCURACY:g}, got {accuracy!r}")
    tolerance = TOLERANCE * accuracy

    def run(rings: int, tolerance: float) -> Run:
        return integrate(motion, rings=rings, tolerance=tolerance, film_limit=film_limit, progress=progress)

    yielding = motion.yielding()
    if yielding < RIGID * tolerance:
        raise InputError(
            f"shear_modulus: the substrate yields by {yielding:.1e} of the film at most, which is nothing at this accuracy; "
            f"Taylor's law for a rigid sphere holds, load = 6 pi eta R^2 V/h (constant viscosity)"
        )
    coarsest = coarse = run(LADDER[0], tolerance)
    loose = run(LADDER[0], 4 * tolerance)
    worst = np.inf
    for step, rings in enumerate(LADDER[1:], 2):
        fine = run(rings, tolerance)
        result = _compared(fine, coarse, (coarsest, loose), accuracy, LADDER[:step])
        worst = max(float(np.max(result.value_errors[name] / result.values[name])) for name in JUDGED)
        if worst <= accuracy:
            return result
        coarse = fine
    raise NotConvergedError(
        f"the film is known to {worst:.1e} only on {LADDER[-1]} rings, not to {accuracy:.1e}; ask for less, or end sooner"
    )


def _compared(fine: Run, coarse: Run, tolerances: tuple[Run, Run], accuracy: float, rings: tuple[int, ...]) -> Squeeze:
    """The finest run with errors from one on a coarser grid and from two with different tolerances."""
    others = (coarse, *tolerances)
    # Where the film limit ended the runs, they end at slightly different times.
    end = min(fine.time[-1], *(run.time[-1] for run in others))
    time = np.minimum(fine.time, end)
    own = fine.histories()
    same, by_grid, strict, loose = (
        own if end == fine.time[-1] else fine.histories(time),
        *(run.histories(time) for run in others),
    )
    errors = {name: np.abs(same[name] - by_grid[name]) + np.abs(strict[name] - loose[name]) for name in HISTORIES}
    for name in HISTORIES:
        if name != fine.motion.control:
            # Histories from two grids cross now and then, which makes neither of them exact.
            errors[name] = np.maximum(errors[name], LEAST_ERROR * fine.tolerance * np.abs(own[name]))
    return Squeeze(
        motion=fine.motion,
        run=fine,
        values=own,
        value_errors=errors,
        end_error=float(max(abs(fine.time[-1] - run.time[-1]) for run in others)),
        accuracy=accuracy,
        rings=rings,
    )
