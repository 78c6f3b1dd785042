"""Meshes that suit a contact."""

import numpy as np
import pytest

from softlube.discretization.grid import WIDE
from softlube.model.indenters import PowerShape, RoundedConeShape, RoundedPunchShape, SphereShape
from softlube.model.problem import Problem
from softlube.model.substrates import HalfSpaceKernel, LayerKernel
from softlube.steady.mesh import angles_for, grid_for
from softlube.steady.regime import Regime


def test_a_mesh_follows_the_steepness_of_the_edge():
    half_space, thick, thin = (
        Regime.of(Problem(beta=1e3, substrate=each)) for each in (HalfSpaceKernel(), LayerKernel(1e3), LayerKernel(0.3))
    )
    assert (half_space.steepness, angles_for(half_space, 26)) == (0, 27)
    assert angles_for(thick, 26) == 27 < angles_for(thin, 26)
    assert grid_for(half_space, 26).edge == 1
    assert 0 <= thick.steepness < 1e-6
    assert grid_for(thick, 26).shape == grid_for(half_space, 26).shape
    assert 0.7 < thin.steepness < 1
    # Under a light load the layers at the edge are wide, and the half-space's mesh does better.
    light = Regime.of(Problem(beta_load=100.0, substrate=LayerKernel(0.3)))
    assert light.beta < 300
    assert (light.steepness, angles_for(light, 27)) == (0, 27)
    assert 1 < grid_for(thin, 26).edge < 1 + thin.beta**-0.4
    assert grid_for(thin, 26).n_r < grid_for(half_space, 26).n_r


@pytest.mark.parametrize("beta", [10.0, 1e3, 1e5])
def test_neighbouring_contacts_share_a_grid(beta):
    first, second, far = (grid_for(Regime.of(Problem(beta=factor * beta)), 18) for factor in (1.0, 1.02, 30.0))
    assert first == second != far
    assert far.xi_of(far.reach) > first.xi_of(first.reach)  # narrower zones take more rings


def test_an_adjustment_comes_before_the_rings_are_counted():
    regime = Regime.of(Problem(beta=1e3))
    plain = grid_for(regime, 18)
    further = grid_for(regime, 18, [lambda grid: type(grid)(**vars(grid) | {"reach": 2 * grid.reach})])
    assert further.reach == 2 * plain.reach
    assert further.n_r > plain.n_r


def grid_under(shape, beta=1e3):
    return grid_for(Regime.of(Problem(beta=beta, indenter=shape)), 18)


def test_the_centre_is_refined_as_fine_as_the_pressure_bends_there():
    assert grid_under(SphereShape(0.09, 1.0)).core == grid_under(PowerShape(0.1, 1.0, 4.0)).core == WIDE
    assert grid_under(RoundedPunchShape(0.1, 1.0, 0.15, 0.06)).core < 0.5
    blunt, sharp = (grid_under(RoundedConeShape(1.0, 1.0, tip, 20.0)).core for tip in (0.3, 0.1))
    assert sharp < 0.5 * blunt


def test_the_rim_is_where_an_indenter_is_as_high_as_the_paraboloid_beside_its_displacement():
    paraboloid, same = grid_for(Regime.of(Problem(beta=1e3)), 18), grid_under(PowerShape(0.1, 1.0, 2.0))
    assert same == paraboloid
    fourth = grid_under(PowerShape(0.1, 1.0, 4.0))
    assert fourth.reach == pytest.approx(20**0.6, rel=0.2)  # where ρ ρ⁴ = 20³
    # The far field's load diverges under a cone: the rim is beyond its base.
    cone = RoundedConeShape(1.0, 1.0, 0.3, 200.0)
    assert grid_under(cone).reach * np.sqrt(Regime.of(Problem(beta=1e3, indenter=cone)).unit) > cone.edge
