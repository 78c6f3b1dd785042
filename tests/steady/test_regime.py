"""The kind of a contact: half-space, layer, gap, oil."""

import numpy as np
import pytest

import softlube
from softlube.model.indenters import PowerShape, RoundedConeShape
from softlube.model.liquids import BarusLaw, CarreauYasudaLaw, NewtonianLaw, OstwaldLaw
from softlube.model.problem import Problem
from softlube.model.substrates import LayerKernel
from softlube.steady.error_estimate import GRIDS
from softlube.steady.level import solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime
from softlube.steady.solve import solve_problem


def test_a_half_space_is_its_own_yardstick():
    """β′ is the problem's β, and a contact has the radius that Hertz gives it."""
    for problem in (Problem(beta=300.0), Problem(beta_load=300.0)):
        regime = Regime.of(problem)
        assert regime.beta == pytest.approx(300.0)
        assert regime.dry.radius == pytest.approx(1.0)
        assert (regime.steepness, regime.over_gap, regime.front, regime.thick, regime.deep) == (0, False, False, False, False)


def test_a_thin_layer_is_steep_and_may_have_a_front():
    layers = [Regime.of(Problem(beta=1e3, substrate=LayerKernel(thickness))) for thickness in (1e3, 1.0, 0.3, 0.2)]
    steepness = [each.steepness for each in layers]
    assert steepness == sorted(steepness)
    assert steepness[0] < 1e-6
    assert 0.7 < steepness[2] < 1
    assert [each.front for each in layers] == [False, False, False, True]
    assert layers[-1].beta > 1e3 * layers[-1].dry.radius ** 4


@pytest.mark.parametrize(
    ("problem", "over_gap"),
    [
        (Problem(beta=10.0, height=1), True),
        (Problem(beta=10.0, height=0), True),
        (Problem(beta=1e-3), False),
        (Problem(beta_load=1.0), True),
        (Problem(beta_load=100.0), False),
        (Problem(beta_load=10.0, substrate=LayerKernel(0.05)), False),  # hardly indented, and yet a contact
    ],
)
def test_a_sphere_over_a_gap(problem, over_gap):
    assert bool(Regime.of(problem).over_gap) is over_gap


def test_thickening_is_taken_at_the_largest_dry_pressure():
    """Ln η/η₀ = αp of a Barus liquid, and Hertz's largest pressure is 2/π² in the problem's unit."""
    assert Regime.of(Problem(beta_load=1e3, liquid=BarusLaw(20.0))).thickening == pytest.approx(20 * 2 / np.pi**2)


def test_the_thinning_is_the_power_with_which_the_viscosity_falls_at_the_inlet():
    rest = NewtonianLaw()
    laws = [rest, OstwaldLaw(rest, 1.0, 0.4), CarreauYasudaLaw(rest, 1e-9, 0.4), CarreauYasudaLaw(rest, 1e9, 0.4)]
    found = [Regime.of(Problem(beta=1e3, liquid=law)).thinning for law in laws]
    assert found == pytest.approx([0.0, 0.6, 0.0, 0.6], abs=1e-9)


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
@pytest.mark.parametrize(("beta_load", "within"), [(1e-4, 0.01), (0.1, 0.06), (1e4, 0.05)])
def test_the_first_height_is_near(beta_load, within, cavitation):
    problem = Problem(beta_load=beta_load, cavitation=cavitation)
    values = solve_level(Regime.of(problem), grid_for(Regime.of(problem), 12)).level.values
    assert Regime.of(problem).first_height == pytest.approx(
        values["height"], abs=within * max(abs(values["height"]), values["film_center"], 1)
    )


def test_a_cone_that_floats_high_is_the_paraboloid_beyond_its_base():
    """There f = kr²/2 but for a constant, and a rigid paraboloid's film under a load goes like 1/(β²k³)."""
    cone, beta_load = RoundedConeShape(0.01, 1.0, 0.05, 0.3), 0.1
    curvature = float(cone.slope(1e3)) / 1e3
    ball = solve_problem(Problem(beta_load=beta_load * curvature**1.5))
    film = solve_problem(Problem(beta_load=beta_load, indenter=cone)).film_center
    assert film == pytest.approx(float(ball.film_center), rel=2e-3)


def test_a_light_load_on_a_power_law_is_borne_far_out():
    """The film is seventy times as thick as that of a liquid with the same viscosity everywhere."""
    light = Problem(beta_load=1.0, liquid=OstwaldLaw(NewtonianLaw(), 0.58, 0.7))
    film = solve_problem(light, accuracy=0.02).film_center
    assert film == pytest.approx(Regime.of(light).first_height, rel=0.5)
    with pytest.raises(softlube.NotConvergedError, match="outside the range"):
        solve_problem(Problem(beta_load=1.0, liquid=OstwaldLaw(NewtonianLaw(), 0.58, 0.42)))


@pytest.mark.parametrize("given", [{"beta_load": 0.03}, {"beta": 0.03}, {"beta": 1e3, "height": 1}])
def test_a_light_contact_of_a_blunt_indenter_takes_three_grids(given):
    """The mesh follows the width of the pressure, which is that of the gap."""
    assert len(solve_problem(Problem(**given, indenter=PowerShape(0.1, 1.0, 4.0))).levels) == GRIDS
