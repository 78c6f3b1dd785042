"""The second zone of the mesh stands where the contact ends at the outlet, on every grid."""

import numpy as np
import pytest

from softlube.model.problem import Problem
from softlube.model.substrates import ViscoelasticKernel
from softlube.steady.level import sketch
from softlube.steady.mesh import grid_for
from softlube.steady.refinements import refinements_for
from softlube.steady.refinements.trail import Trail
from softlube.steady.regime import Regime


def grid_of(n_theta, substrate=None, **more):
    models = {} if substrate is None else {"substrate": substrate}
    regime = Regime.of(Problem(beta_load=1000.0, **models, **more))
    return grid_for(regime, n_theta, [lambda grid: Trail(regime).adjust(grid, None)]), regime


def test_the_zone_is_where_the_pressure_ends():
    substrate = ViscoelasticKernel((0.9,), (1.0,))
    grid, regime = grid_of(29, substrate)
    fields = sketch(regime.problem).fields
    wet = fields.r[fields.pressure[:, -1] > 0][-1] / np.sqrt(regime.unit)
    assert 0 < grid.crest < 0.6
    assert grid.crest * grid.edge == pytest.approx(wet, abs=0.15)
    other, _ = grid_of(17, substrate)
    assert (other.edge, other.crest) == (grid.edge, grid.crest)
    assert grid.side_width < grid_for(regime, 29).side_width  # the contact's edge turns sharply there
    assert any(isinstance(each, Trail) for each in refinements_for(regime))


@pytest.mark.parametrize("substrate", [None, ViscoelasticKernel((0.1,), (1.0,)), ViscoelasticKernel((0.9,), (1e5,))])
def test_round_contacts_have_none(substrate):
    """Elastic ones, those that remember little, and those that pass so fast that they do not come back within the contact."""
    grid, regime = grid_of(17, substrate)
    assert grid.crest == 0
    assert grid == grid_for(regime, 17)
