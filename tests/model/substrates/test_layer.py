"""Layers against elasticity itself, quadrature, and the limits of thick and thin."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import j0, jv

import softlube
from softlube.discretization.elasticity import elastic_operator
from softlube.discretization.grid import PolarGrid
from softlube.model.problem import Problem
from softlube.model.substrates import HalfSpaceKernel, Layer, LayerKernel, from_plain, to_plain
from softlube.model.substrates.layer import compliance_defect
from softlube.steady.level import solve_level
from softlube.steady.mesh import grid_for
from softlube.steady.regime import Regime


def compliance_by_elasticity(kappa, nu, base):
    """C from Navier's equations in plane strain, p = cos kx on a layer of unit thickness and G = 1.

    Papkovich-Neuber-like solutions u = U(z) sin kx, w = W(z) cos kx with four unknown constants; z from the base upwards.
    """
    k, a = kappa, 3 - 4 * nu

    def columns(z):
        """U, W, σ_zz and τ_xz of the four solutions at height z; solutions e^{±kz} and z e^{±kz} of Navier's equations."""
        result = []
        for sign in (1, -1):
            e = np.exp(sign * k * z)
            # curl-free and divergence-free: U = −k e, W = sign k e
            result.append((-k * e, sign * k * e, 2 * k**2 * e, -2 * sign * k**2 * e))
            # U = −sign k z e, W = (k z − sign a) e, by substitution
            u, w = -sign * k * z * e, (k * z - sign * a) * e
            du, dw = -sign * k * e - k**2 * z * e, k * e + sign * k * (k * z - sign * a) * e
            dilatation = k * u + dw
            result.append((u, w, 2 * nu / (1 - 2 * nu) * dilatation + 2 * dw, du - k * w))
        return np.array(result).T

    bottom, top = columns(0.0), columns(1.0)
    held = bottom[0] if base == "bonded" else bottom[3]
    constants = np.linalg.solve(np.array([held, bottom[1], top[2], top[3]]), [0, 0, -1.0, 0])
    return -(top[1] @ constants) * k / (1 - nu)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.49])
@pytest.mark.parametrize("base", ["bonded", "frictionless"])
def test_compliance_against_elasticity(nu, base):
    for kappa in (0.1, 0.7, 2.0, 6.0):
        expected = compliance_by_elasticity(kappa, nu, base)
        assert 1 + compliance_defect(np.array(kappa), nu, base) == pytest.approx(expected, rel=1e-9)


def test_long_waves():
    """A thin layer is a Winkler foundation, or if it is bonded and incompressible the lubrication flow under a skin."""
    kappa = np.array(1e-3)
    for nu in (0.0, 0.3):
        assert 1 + compliance_defect(kappa, nu) == pytest.approx(kappa * (1 - 2 * nu) / (2 * (1 - nu) ** 2), rel=1e-5)
    assert 1 + compliance_defect(np.array(1e-2)) == pytest.approx(2e-6 / 3, rel=1e-3)
    assert 1 + compliance_defect(kappa, 0.5, "frictionless") == pytest.approx(kappa / 2, rel=1e-5)


@pytest.mark.parametrize(("r", "source"), [(1.0, 1.01), (0.3, 0.5), (2.0, 0.02), (6.0, 5.0)])
@pytest.mark.parametrize("layer", [LayerKernel(1.0), LayerKernel(0.2, 0.3), LayerKernel(3.0, 0.5, "frictionless")])
def test_kernel_against_the_hankel_transform(layer, r, source):
    r, source = np.array(r), np.array(source)
    remainder = layer.ring_remainder(np.arange(12), r, source)
    k, weight = layer.spectrum(float(r + source))
    for m in (0, 1, 2, 7, 11):
        expected = 2 * np.pi * np.sum(weight * jv(m, k * r) * jv(m, k * source))
        assert remainder[m] == pytest.approx(expected, abs=2e-8 / layer.thickness)


@pytest.mark.parametrize(
    "layer", [LayerKernel(0.7), LayerKernel(0.4, 0.3), LayerKernel(0.5, 0.0, "frictionless"), LayerKernel(0.3, share=0.6)]
)
def test_displacement_under_a_gaussian(layer):
    """Against w = −2π∫ [share C + (1 − share)] p̃ J₀(kr) dk with p̃ = e^(−k²/4)/2."""
    grid = PolarGrid(54, 8, edge_width=0.3)
    pressure = np.exp(-(np.repeat(grid.r, 9) ** 2))
    ours = elastic_operator(grid, "none", layer.remainder).deflection(pressure).reshape(grid.shape)[:, 0]
    for i in range(0, 40, 5):

        def wave(k, r=grid.r[i]):
            defect = compliance_defect(np.array(k * layer.thickness), layer.poisson_ratio, layer.base)
            return np.pi * (1 + layer.share * defect) * np.exp(-(k**2) / 4) * j0(k * r)

        assert ours[i] == pytest.approx(quad(wave, 1e-9, 15, limit=400)[0], abs=3e-5)


def test_an_incompressible_layer_keeps_its_volume():
    """C ~ k³: a load far from the edge neither sinks nor lifts the layer as a whole, ∫ w dA = 0."""
    grid = PolarGrid(60, 8, edge_width=0.3)
    pressure = np.exp(-(np.repeat(grid.r, 9) ** 2))
    operator = elastic_operator(grid, "none", LayerKernel(0.5).remainder)
    sunk = operator.deflection(pressure)
    assert abs(operator.load_weights @ sunk) < 2e-4 * operator.load_weights @ np.abs(sunk)


def test_a_very_thick_layer_is_the_half_space():
    problem, thickness = Problem(beta=200.0), 1e5
    grid = grid_for(Regime.of(problem), 18)
    half_space = solve_level(Regime.of(problem), grid).level.values
    layer = solve_level(Regime.of(Problem(beta=200.0, substrate=LayerKernel(thickness))), grid).level.values
    for name, value in half_space.items():
        # a/t of the first order, and no more
        assert layer[name] == pytest.approx(value, rel=3e-4 if name == "shear_rate_max" else 1e-4, abs=1e-5), name


@pytest.mark.parametrize("substrate", [LayerKernel(0.5), LayerKernel(1.0, 0.3), LayerKernel(3.0, 0.5, "frictionless")])
def test_errors_cover_the_change_on_a_finer_grid(substrate):
    coarse = softlube.solve(beta=100, substrate=substrate, accuracy=1e-2)
    fine = softlube.solve(beta=100, substrate=substrate, accuracy=3e-4)
    assert fine.levels[-1].n_theta > coarse.levels[-1].n_theta
    missed = [
        name
        for name, value in coarse.quantities.items()
        if abs(value - fine.quantities[name]) > value.error + fine.quantities[name].error
    ]
    assert len(missed) <= 1, missed  # the promise is 95 %


def test_compliances_of_two_bodies_add_in_wavenumber_space():
    """The layer's remainder times its share, in the spectrum and on rings; nothing but that."""
    alone, shared = LayerKernel(0.7, 0.4), LayerKernel(0.7, 0.4, share=0.3)
    (k, whole), (_, part) = alone.spectrum(4.0), shared.spectrum(4.0)
    assert part == pytest.approx(0.3 * whole, rel=1e-14)
    assert 1 + part / whole * compliance_defect(k * 0.7, 0.4) == pytest.approx(
        0.3 * (1 + compliance_defect(k * 0.7, 0.4)) + 0.7, rel=1e-14
    )
    places = np.arange(3), np.array([0.4]), np.array([1.1])
    assert shared.ring_remainder(*places) == pytest.approx(0.3 * alone.ring_remainder(*places), rel=1e-14)
    assert from_plain(to_plain(shared)) == shared
    assert from_plain({"kind": "layer", "thickness": 0.7, "poisson_ratio": 0.4, "base": "bonded"}) == alone
    with pytest.raises(softlube.InputError, match="share: expected a number above 0"):
        LayerKernel(0.7, share=0.0)


def test_a_layer_is_thinner_than_the_ball_it_lies_on():
    assert Layer(3e6, thickness="1 mm", radius="5 mm").curvature == pytest.approx(200)
    assert Layer(3e6, thickness="9 mm", radius="-5 mm").curvature == pytest.approx(-200)
    with pytest.raises(softlube.InputError, match=r"thickness, substrate_radius: the layer, 0\.005 m thick, fills the ball"):
        Layer(3e6, thickness="5 mm", radius="5 mm")


FINE = {  # at 64 angles, on meshes that were graded otherwise
    (100, 3.0): {"load": 0.791539, "film_center": 0.0569452, "film_min": 0.0389002, "film_outlet_min": 0.0435787},
    (100, 1.0): {"load": 2.40967, "film_center": 0.0361103, "film_min": 0.0238365, "film_outlet_min": 0.0278461},
    (100, 0.3): {"load": 26.5496, "film_center": 0.0125676, "film_min": 0.00700518, "film_outlet_min": 0.0096937},
    (1000, 3.0): {"load": 0.705359, "film_center": 0.0148842, "film_min": 0.00854401, "film_outlet_min": 0.0115095},
    (1000, 1.0): {"load": 2.22691, "film_center": 0.00977008, "film_min": 0.00480077, "film_outlet_min": 0.00756406},
    (1000, 0.3): {"load": 25.781, "film_center": 0.00357094, "film_min": 0.00114138, "film_outlet_min": 0.00274252},
}
SHEAR = {(100, 3.0): 37.4246, (100, 1.0): 57.3884, (100, 0.3): 155.448}
SHEAR |= {(1000, 3.0): 144.871, (1000, 1.0): 220.662, (1000, 0.3): 883.873}
FRICTION = {(100, 3.0): 0.970696, (100, 1.0): 1.9531, (100, 0.3): 6.71937}
FRICTION |= {(1000, 3.0): 0.326493, (1000, 1.0): 0.694816, (1000, 0.3): 2.48662}


@pytest.mark.parametrize(("beta", "thickness"), FINE)
def test_layers_take_the_grids_of_a_half_space(beta, thickness):
    solution = softlube.solve(beta=beta, substrate=LayerKernel(thickness))
    fine = FINE[beta, thickness] | {"shear_rate_max": SHEAR[beta, thickness]}
    assert solution.friction_within(2.0) == pytest.approx(FRICTION[beta, thickness], rel=1e-3)
    for name, value in fine.items():
        allowed = 3e-3 if name in ("film_min", "shear_rate_max") else 1e-3
        assert solution.quantities[name] == pytest.approx(value, rel=allowed), name
    third, half_space = solution.levels[2], softlube.solve(beta=beta).levels[2]
    # After three grids the minimum film of one (β′ = 7.5e5) and the film on the outlet axis of another are at 0.11 %.
    assert len(solution.levels) == 3 + ((beta, thickness) in [(1000, 0.3), (100, 3.0)])
    # A steep edge takes more angles; the fourth grid, which 14 of 30 contacts like these took with fewer, would be dearer.
    assert third.n_r * third.n_theta < (1.5 if thickness >= 1 else 1.9) * half_space.n_r * half_space.n_theta


@pytest.mark.parametrize(
    ("control", "beta", "thickness", "grids"),
    [("beta_load", 1000, 1.0, 3), ("beta_load", 100, 0.174, 4), ("beta", 1000, 0.476, 3), ("beta_load", 30, 0.25, 3)],
)
def test_grids_by_load_and_at_other_thicknesses(control, beta, thickness, grids):
    """0.174 and 0.476 are 0.3 radii of the dry contact; under the lightest load the sphere is hardly below the surface."""
    arguments = {control: beta, "substrate": LayerKernel(thickness)}
    solution = softlube.solve(**arguments)
    assert len(solution.levels) == grids
    problem = Problem(**arguments)
    fine = solve_level(Regime.of(problem), grid_for(Regime.of(problem), 40)).level.values
    for name in ("film_center", "film_min", "film_outlet_min", "pressure_max", "friction_domain", "shear_rate_max"):
        allowed = 3e-3 if name in ("film_min", "shear_rate_max") else 1e-3
        assert solution.quantities[name] == pytest.approx(fine[name], rel=allowed), name


@pytest.mark.parametrize("control", ["beta", "beta_load"])
def test_the_boundary_layer_is_counted_from_the_dry_contact_on_the_layer(control):
    """At large β it is where the dry pressure is 5 % of its maximum, inside the edge, and a layer of β′^(−2/5) more."""
    problem = Problem(**{control: 1e4}, substrate=LayerKernel(0.5))
    dry = Regime.of(problem).dry
    y = np.linspace(0.5, 1, 5001)
    inside = y[np.flatnonzero(dry.pressure(dry.radius * y) > 0.05 * dry.pressure(0.0))[-1]]
    solution = softlube.solve(**{control: 1e4}, substrate=LayerKernel(0.5))
    assert -3e-4 < solution.boundary_layer / dry.radius - (inside - 1) < Regime.of(problem).beta ** -0.4
    unit = (solution.beta if control == "beta_load" else solution.beta_load) / problem.parameter
    other = softlube.solve(
        **{"beta" if control == "beta_load" else "beta_load": problem.parameter * float(unit)},
        substrate=LayerKernel(0.5).in_units(float(unit) ** 0.5),
    )
    assert solution.normalised("indentation" if control == "beta_load" else "load")["boundary_layer"] == pytest.approx(
        other.boundary_layer, abs=2e-4
    )


def test_load_and_indentation_control_agree():
    by_depth = softlube.solve(beta=100, substrate=LayerKernel(1.0))
    unit = float(by_depth.beta_load / by_depth.beta) ** 0.5
    by_load = softlube.solve(beta_load=by_depth.beta_load, substrate=LayerKernel(1.0).in_units(unit))
    assert by_load.height * unit == pytest.approx(-1, rel=1e-4)
    assert by_load.film_center * unit == pytest.approx(by_depth.film_center, rel=1e-3)


def test_units_scale_the_thickness():
    assert LayerKernel(2.0).in_units(4.0) == LayerKernel(1.0)
    assert HalfSpaceKernel().in_units(4.0) == HalfSpaceKernel()


def test_round_trip_in_plain_values():
    for substrate in (HalfSpaceKernel(), LayerKernel(0.3, 0.25, "frictionless")):
        assert from_plain(to_plain(substrate)) == substrate
    assert from_plain(None) == HalfSpaceKernel()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"thickness": 0.0}, "thickness: expected a positive"),
        ({"thickness": float("nan")}, "thickness: "),
        ({"thickness": 1.0, "poisson_ratio": 0.6}, "poisson_ratio: expected a number between 0 and 0.5"),
        ({"thickness": 1.0, "base": "glued"}, "base: expected 'bonded' or 'frictionless'"),
    ],
)
def test_bad_layers_are_refused(arguments, message):
    with pytest.raises(softlube.InputError, match=message):
        LayerKernel(**arguments)


def test_models_that_do_not_know_layers_refuse_them():
    from softlube import curve
    from softlube.steady.solve import solve_problem

    problem = Problem(beta=100.0, substrate=LayerKernel(1.0))
    with pytest.raises(softlube.InputError, match="the master curve is for a half-space"):
        curve.quantities(problem)
    with pytest.raises(softlube.InputError, match="the paper's methods know the half-space"):
        solve_problem(problem, method="relaxation")
