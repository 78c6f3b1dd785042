"""The spike as a refinement: its zone in the mesh, and when its height has an error."""

from functools import partial
from types import SimpleNamespace

import pytest

import softlube
from softlube.discretization.measure import FRICTIONS
from softlube.model.liquids import BarusLaw, DowsonHigginsonLaw, RoelandsLaw
from softlube.model.problem import Problem
from softlube.steady.level import solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.refinements.spike.detection import outlet_crest
from softlube.steady.refinements.spike.refinement import DETERMINED, Spike, crest_of
from softlube.steady.regime import Regime
from softlube.theory.engineering import BETA_LOAD_OF_M, alpha_of_moes


def moes(m, material):
    """A contact in Moes' parameters."""
    return Problem(beta_load=BETA_LOAD_OF_M * m ** (4 / 3), liquid=BarusLaw(float(alpha_of_moes(m, material))))


def test_place_of_the_crest_and_the_mesh_there():
    regime = Regime.of(moes(20, 10))
    before = solve_level(regime, grid_for(regime, 18))
    assert outlet_crest(before.fields) == pytest.approx(0.67, abs=0.07)  # 0.67 on the finest
    crest = crest_of(regime, before.fields)
    adjusted = grid_for(regime, 26, [partial(Spike(regime).adjust, before=before)])
    assert adjusted.crest == crest == pytest.approx(outlet_crest(before.fields), abs=0.011)
    assert adjusted.n_r > grid_for(regime, 26).n_r
    assert Spike(regime).adjust(grid_for(regime, 26), None).crest == 0
    thin = Regime.of(moes(20, 1))
    assert Spike(thin).adjust(grid_for(thin, 26), before).crest == 0  # thin liquids keep the mesh that they had


def test_a_spike_that_one_grid_has_seen_has_no_error_yet():
    """αp_H = 4.2: the third grid is the first with a spike and accurate enough otherwise; the fourth gives the spike, too."""
    solution = softlube.solve(beta_load=1e3, liquid=DowsonHigginsonLaw(RoelandsLaw(40.0, 0.65, 0.3), 1.0), accuracy=1.1e-3)
    assert len(solution.levels) == 4
    assert solution.spike_pressure == pytest.approx(0.103224, abs=2e-5)
    assert solution.spike_radius == pytest.approx(0.903985, abs=2e-3)
    assert solution.spike_pressure.error < 0.01 * solution.spike_pressure


def test_a_smooth_pressure_is_no_spike():
    solution = softlube.solve(beta_load=100.0)
    spike = Spike(Regime.of(solution.problem))
    assert spike.determines(solution.fields, solution.quantities) == {}
    assert set(DETERMINED) - {"friction_viscous"} < set(solution.quantities)


def test_on_a_substrate_that_remembers_a_needle_determines_the_viscous_friction_too():
    spike, needle = Spike(Regime.of(moes(20, 10))), SimpleNamespace(is_sharp=True, steepest_fall=9.0)
    elastic = dict.fromkeys(("film_min", "pressure_max", "boundary_layer", *FRICTIONS), 1.0)
    assert spike.determines(needle, elastic).keys() == elastic.keys() - {"film_min"}
    remembers = elastic | {"friction_viscous": 1.0, "friction_hysteresis": 1.0}
    assert spike.determines(needle, remembers).keys() == remembers.keys() - {"film_min", "friction_hysteresis"}
