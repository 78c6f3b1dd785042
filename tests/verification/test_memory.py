"""Substrates that remember, lubricated: limits, parts of the friction, both ways to prescribe."""

import numpy as np
import pytest

import softlube
from softlube.discretization.system import ContactSystem
from softlube.model.exact import HERTZ_LOAD
from softlube.model.problem import Problem
from softlube.model.substrates import LayerKernel, ViscoelasticKernel
from softlube.readout.energy import energy_balance
from softlube.solvers.newton import newton
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime

ACCURACY = 1e-3


def solved(shares, lengths, layer=None, **more):
    relaxed = {} if layer is None else {"relaxed": layer}
    return softlube.solve(substrate=ViscoelasticKernel(shares, lengths, **relaxed), accuracy=ACCURACY, **more)


@pytest.fixture(scope="module")
def middle():
    """One time, the modulus halved, a contact as long as the memory."""
    return solved((0.5,), (1.0,), beta=1000.0)


@pytest.mark.parametrize("prescribed", ["beta", "beta_load"])
def test_short_times_are_the_relaxed_half_space(prescribed):
    """Within the errors, which are some 10⁻⁵ of the quantities."""
    elastic = softlube.solve(**{prescribed: 300.0})
    ours = solved((0.5, 0.4), (1e-7, 1e-8), **{prescribed: 300.0})
    for name, value in elastic.quantities.items():
        near = ours.quantities[name]
        assert near == pytest.approx(value, abs=near.error + value.error + 1e-6 * abs(value)), name
    assert abs(ours.friction_hysteresis) < 1e-5 * ours.friction_total


@pytest.mark.parametrize("prescribed", ["beta", "beta_load"])
def test_long_times_are_the_instantaneous_half_space(prescribed):
    """Half as soft: in its own units β and the load are others."""
    compliance, beta = 0.5, 300.0
    ours = solved((0.5,), (1e9,), **{prescribed: beta})
    unit = compliance ** (2 / 3) if prescribed == "beta_load" else 1.0
    elastic = softlube.solve(**{prescribed: beta * unit**2 / compliance})
    for name, scale in (("film_center", unit), ("film_min", unit), ("height", unit), ("pressure_max", unit**0.5 / compliance)):
        near, there = ours.quantities[name], elastic.quantities[name].scaled(scale)
        assert near == pytest.approx(there, abs=near.error + there.error + 1e-6 * abs(there)), name
    assert ours.load == pytest.approx(unit**1.5 / compliance * elastic.load, rel=1e-5)
    assert abs(ours.friction_hysteresis) < 1e-5 * ours.friction_total


@pytest.mark.parametrize(("lengths", "beta"), [((1e-9, 1e-8), 300.0), ((1e12, 1e11), 300.0 / 0.4)])
def test_limits_on_one_grid(lengths, beta):
    """There the relaxed and the instantaneous state are those of the elastic half-space to the accuracy of Newton's method."""
    grid = grid_for(Regime.of(Problem(beta=300.0)), 17)
    problem = Problem(beta=300.0, substrate=ViscoelasticKernel((0.4, 0.2), lengths))
    ours, elastic = ContactSystem(problem, grid), ContactSystem(Problem(beta=beta), grid)
    stiffness = 1.0 if lengths[0] < 1 else 1 / 0.4
    expected = newton(elastic, elastic.start(), tolerance=1e-10).x
    found = newton(ours, stiffness * elastic.start(), tolerance=1e-10).x
    assert found == pytest.approx(stiffness * expected, abs=1e-8)
    assert ours.film(found) == pytest.approx(elastic.film(expected), rel=1e-7)


def test_equal_times_are_one(middle):
    split = solved((0.2, 0.3), (1.0, 1.0), beta=1000.0)
    for name, value in middle.quantities.items():
        assert split.quantities[name] == pytest.approx(value, rel=1e-8), name


def test_parts_of_the_friction(middle):
    assert middle.friction_total == pytest.approx(middle.friction_viscous + middle.friction_hysteresis)
    assert middle.friction_hysteresis > 0.4 * middle.friction_total


def test_the_substrate_s_friction_is_the_pressure_s_resultant(middle):
    """6∫p ∂w/∂x dA by the slope of the film, of which the elastic part has no resultant."""
    parts = softlube.friction.split(middle, 15.0)
    assert parts.substrate_pressure == pytest.approx(middle.friction_hysteresis, rel=3e-4)
    assert parts.imbalance == pytest.approx(0, abs=1e-3)


def test_the_contact_ends_earlier_at_the_outlet(middle):
    fields = middle.fields
    inlet, outlet = (float(np.trapezoid(fields.pressure[:, k], fields.r)) for k in (0, -1))
    assert inlet > 1.3 * outlet


def test_load_and_depth_are_one_contact(middle):
    """The same state from the load that the depth has."""
    delta = float(middle.load / HERTZ_LOAD) ** (2 / 3)
    by_load = solved((0.5,), (delta**-0.5,), beta_load=1000.0 * delta**2)
    assert by_load.height == pytest.approx(-1 / delta, rel=2e-4)
    assert by_load.friction_hysteresis == pytest.approx(middle.friction_hysteresis / delta**2, rel=1e-3)


@pytest.mark.parametrize("beta", [0.1, 5.0, 60.0])
def test_light_loads_and_no_condition(beta):
    for cavitation in ("reynolds", "none"):
        solution = solved((0.6,), (2.0,), beta_load=beta, cavitation=cavitation)
        assert solution.friction_hysteresis > 0


@pytest.mark.parametrize(("length", "share"), [(1e-7, 0.0), (1e9, 0.5)])
@pytest.mark.parametrize("layer", [LayerKernel(1.0, 0.45), LayerKernel(0.5, 0.5, "frictionless"), LayerKernel(0.3)])
def test_layers_have_the_limits_of_half_spaces(layer, length, share):
    """All times → 0 is the relaxed layer, all times → ∞ the instantaneous one, with what it is stiffer by in β and the load."""
    elastic = softlube.solve(beta=300.0 / (1 - share), substrate=layer, accuracy=3e-3)
    ours = softlube.solve(beta=300.0, substrate=ViscoelasticKernel((0.5,), (length,), layer), accuracy=3e-3)
    for name in ("film_center", "film_min", "film_outlet_min"):
        assert ours.quantities[name] == pytest.approx(elastic.quantities[name], rel=1e-6), name
    assert ours.load == pytest.approx(elastic.load / (1 - share), rel=1e-6)
    assert abs(ours.friction_hysteresis) < 1e-4 * ours.friction_total


def test_the_balance_of_energy_of_a_layer():
    """The loss by internal variables, which knows nothing of the slope by which the friction is taken."""
    kernel = ViscoelasticKernel((0.5,), (1.0,), LayerKernel(1.0, 0.45))
    balance = energy_balance(softlube.solve(beta=300.0, substrate=kernel))
    assert balance.imbalance == pytest.approx(0, abs=1e-4)
    assert balance.substrate == pytest.approx(balance.hysteresis, rel=1e-3)


def test_a_thicker_layer_comes_to_the_half_space(middle):
    """The friction of the substrate differs by the thickness's reciprocal, times some."""
    near, far = (solved((0.5,), (1.0,), LayerKernel(thickness), beta=1000.0) for thickness in (20.0, 40.0))
    off = [each.friction_hysteresis / middle.friction_hysteresis - 1 for each in (near, far)]
    assert abs(off[1]) < 0.05
    assert off[0] == pytest.approx(2 * off[1], rel=0.2)
