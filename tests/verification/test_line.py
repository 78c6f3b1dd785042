"""The line contact against limits, an independent solution, the conservation of energy, and a published formula."""

import numpy as np
import pytest

from softlube import Cylinder, DowsonHigginson, HalfSpace, LineContact, Roelands, Rolling, line
from softlube.discretization.line.displacement import surface
from softlube.discretization.line.flow import mean_stress
from softlube.discretization.line.memory import remembered
from softlube.discretization.line.panels import Panels
from softlube.model.dry_line import dry_line
from softlube.model.liquids import CarreauYasudaLaw, EyringLaw, LimitingStressLaw, NewtonianLaw, OstwaldLaw
from softlube.model.substrates import HalfSpaceKernel, LayerKernel, ViscoelasticKernel
from softlube.theory.inlet import inlet, outlet
from softlube.theory.power_law import PowerLawFlow

EDGE_PRESSURE = np.sqrt(2) / (2 * np.pi)
"""A in p = A√s at the edge of a cylinder's Hertz contact, p = √(1 − x²)/(2π)."""


def extrapolated(beta, values):
    """The limit β → ∞ of values whose next term goes with β^(−2/5)."""
    factor = (beta[1] / beta[0]) ** 0.4
    return (factor * values[1] - values[0]) / (factor - 1)


@pytest.mark.parametrize("cavitation", ["reynolds", "none"])
def test_the_hertz_limit_has_the_similarity_problems_of_the_sphere(cavitation):
    """Six digits of the inlet's film and steepest pressure, and of the outlet's constriction."""
    beta = (1e7, 1e8)
    solved = [line.solve(each, cavitation=cavitation) for each in beta]
    inside = inlet().film_inside
    film = extrapolated(beta, [s.film_carried * s.beta_load**0.6 for s in solved])
    assert film == pytest.approx(EDGE_PRESSURE**-0.8 * inside, rel=1e-6)
    gradient = extrapolated(beta, [s.pressure_gradient_inlet * s.beta_load**-0.2 for s in solved])
    assert gradient == pytest.approx(EDGE_PRESSURE**1.6 * inlet().gradient_max, rel=3e-6)
    constriction = extrapolated(beta, [s.film_min / s.film_carried for s in solved])
    assert constriction == pytest.approx(outlet(cavitation).film_min / inside, rel=1e-6)


def test_the_pressure_becomes_hertz():
    x = np.array([-0.9, -0.3, 0.0, 0.6, 0.95])
    errors = [np.abs(line.solve(beta).fields.pressure_at(x) * 2 * np.pi - np.sqrt(1 - x**2)).max() for beta in (1e4, 1e6, 1e8)]
    assert errors[-1] < 1e-4
    assert np.all(np.array(errors[:-1]) / errors[1:] > 10)  # about like the film, β^(−3/5)


@pytest.mark.parametrize("length", [0.1, 0.3, 1.0, 3.0, 10.0])
def test_hunters_dry_contact_is_the_limit_of_thin_films(length):
    """C_relaxed/C_instant = 10: friction within 2·10⁻⁵, and what is left falls like the film."""
    substrate = ViscoelasticKernel((0.9,), (length,))
    dry = dry_line(substrate)
    errors = []
    for beta in (1e6, 1e8):
        solution = line.solve(beta, substrate=substrate)
        errors.append(abs(solution.friction_hysteresis / dry.friction_hysteresis - 1))
        assert solution.friction_total == pytest.approx(solution.friction_hysteresis + solution.friction_viscous, rel=1e-12)
    assert errors[1] < 4e-5
    assert errors[0] / errors[1] > 100**0.6
    x = dry.middle + dry.half_width * np.linspace(-0.9, 0.9, 9)
    assert solution.fields.pressure_at(x) == pytest.approx(dry.pressure(x), abs=1e-3 * dry.pressure(x).max())


def substrate_loss(fields, share, length):
    """What the dashpots of one time lose, 6 J L∫ q (−K q) dx, q the slope of the retarded pressure, p_i − L p_i′ = p."""
    near = fields.panels.edges
    behind = Panels(np.concatenate([-length * np.array([45, 30, 20, 12, 8, 5, 3, 2, 1, 0.5, 0.2, 0.05]), near]), 10)
    s = behind.nodes
    p = np.where(s > 0, fields.pressure_at(fields.front + s), 0.0)
    slope = ((remembered(behind, length)[0] @ p)[:-1] - p) / length
    rows = surface(HalfSpaceKernel(), behind, behind)[:-1, :, :10]
    return -6 * share * length * (behind.weights * slope) @ np.einsum("xpk,pk->x", rows, behind.coefficients(slope))


@pytest.mark.parametrize("length", [0.05, 0.5, 5.0, 50.0])
@pytest.mark.parametrize("beta", [10.0, 1e3, 1e5])
def test_the_friction_is_what_film_and_substrate_lose(beta, length):
    share = 0.8
    solution = line.solve(beta, substrate=ViscoelasticKernel((share,), (length,)), accuracy=1e-6)
    fields = solution.fields
    panels, gradient = fields.panels, fields.state.gradient
    film = float(solution.friction_couette) + panels.weights @ (3 * beta * fields.film**3 * gradient**2)
    film += 6 / (beta * (fields.front + panels.edges[-1]))  # beyond the mesh
    lost = film + substrate_loss(fields, share, length)
    assert solution.friction_total == pytest.approx(lost, rel=1e-5)


@pytest.mark.parametrize(("index", "slide_to_roll"), [(0.8, 2.0), (0.8, 0.0), (0.6, 2.0), (0.4, 0.0)])
def test_the_inlet_of_a_power_law(index, slide_to_roll):
    """Five digits of the inlet's film, `softlube.theory.inlet` with the flux of a power law, in sliding and in pure rolling."""
    stress, beta, films = 1e-3, (1e6, 1e7), []
    for each in beta:
        liquid = OstwaldLaw(NewtonianLaw(), stress, index)
        solution = line.solve(each, liquid=liquid, slide_to_roll=slide_to_roll)
        formed = each * (each * stress) ** (index - 1)  # with the viscosity at the shear rate v/H
        films.append(solution.film_carried * formed ** (3 / (3 * index + 2)))
    factor = (beta[1] / beta[0]) ** (2 * index / (3 * index + 2))
    film = (factor * films[1] - films[0]) / (factor - 1)
    layer = inlet(flow=PowerLawFlow(index, slide_to_roll))
    entrainment = ((2 * index + 1) / index) ** index / 3
    law = EDGE_PRESSURE ** (-4 / (3 * index + 2)) * entrainment ** (3 / (3 * index + 2)) * layer.film_inside
    assert film == pytest.approx(law, rel=2e-5)


def test_liquids_that_hardly_thin_are_newtonian():
    plain = line.solve(1e3)
    for liquid in (
        CarreauYasudaLaw(NewtonianLaw(), time=1e-9, index=0.5),
        EyringLaw(NewtonianLaw(), 1e6),
        LimitingStressLaw(NewtonianLaw(), 1e6, 0.0),
        OstwaldLaw(NewtonianLaw(), 1.0, 1.0),
    ):
        found = line.solve(1e3, liquid=liquid)
        for name, value in plain.quantities.items():
            assert found.quantities[name] == pytest.approx(value, rel=1e-6, abs=1e-6), (liquid.kind, name)


def test_a_liquid_that_thins_dissipates_what_the_friction_does():
    """C − P = β∫∫ uφψ(τ) τ² dζ dx over the film, τ = τm + 6ζup′."""
    beta, liquid = 1e3, CarreauYasudaLaw(NewtonianLaw(), time=50.0, index=0.5)
    solution = line.solve(beta, liquid=liquid)
    fields = solution.fields
    film, gradient, weights = fields.film, fields.state.gradient, fields.panels.weights
    mean = mean_stress(fields.equations.problem, film, gradient, fields.pressure)
    zeta, weight = np.polynomial.legendre.leggauss(60)
    stress = mean[:, None] + 3 * (film * gradient)[:, None] * zeta
    psi = np.exp(liquid.fluidity_at(np.maximum(np.abs(stress), 1e-150))[0])
    lost = beta * weights @ (film * ((psi * stress**2) @ weight) / 2)
    lost += sum(each.couette - each.poiseuille for each in fields.equations.outside)
    assert solution.friction_total == pytest.approx(lost, rel=1e-6)
    assert solution.friction_total < 0.9 * line.solve(beta).friction_total


def test_times_that_are_extreme_or_equal():
    elastic, stiff = line.solve(1e4), ViscoelasticKernel((0.75,), (1e9,))
    short = line.solve(1e4, substrate=ViscoelasticKernel((0.75,), (1e-9,)))
    assert short.film_min == pytest.approx(elastic.film_min, rel=1e-6)
    # The instantaneous half-space is four times as stiff: half the width b, a quarter of b²/R, β/4.
    long, twin = line.solve(1e4, substrate=stiff), line.solve(2500.0)
    assert long.film_min == pytest.approx(twin.film_min / 4, rel=1e-6)
    assert long.pressure_max == pytest.approx(twin.pressure_max * 2, rel=1e-6)
    one, split = (
        line.solve(1e4, substrate=ViscoelasticKernel(shares, (0.5,) * len(shares))) for shares in ((0.6,), (0.25, 0.35))
    )
    for name, value in one.quantities.items():
        assert split.quantities[name] == pytest.approx(value, rel=1e-9, abs=1e-12)


def test_a_thin_compressible_layer_is_a_row_of_springs():
    """β → ∞ on springs: p = (c² − x²)/(2K) with K = 2πt(1 − 2ν)/(2(1 − ν)²), and the load 2c³/(3K) = 1/4."""
    thickness, nu = 0.02, 0.1
    spring = 2 * np.pi * thickness * (1 - 2 * nu) / (2 * (1 - nu) ** 2)
    width = (3 * spring / 8) ** (1 / 3)
    solution = line.solve(1e7, substrate=LayerKernel(thickness, nu))
    assert solution.pressure_max == pytest.approx(width**2 / (2 * spring), rel=0.05)
    assert solution.free_boundary == pytest.approx(-width, rel=0.05)


@pytest.mark.parametrize(("load", "digits"), [("30 N/mm", 0.3194), ("100 N/mm", 0.2731), ("1 kN/mm", 0.2025)])
def test_steel_and_oil_beside_dowson_and_higginson(load, digits):
    """H_min = 2.65 U^0.7 G^0.54 W^(−0.13) (Dowson & Higginson 1966), 0.33 to 1.9 GPa: a comparison, not the truth."""
    contact = LineContact(
        cylinder=Cylinder("10 mm", young_modulus="210 GPa", poisson_ratio=0.3),
        substrate=HalfSpace("210 GPa", poisson_ratio=0.3),
        liquid=Roelands("40 mPa s", pressure_viscosity="20 GPa^-1"),
        compressibility=DowsonHigginson(),
        motion=Rolling("1 m/s", slide_to_roll=0),
        load_per_length=load,
    )
    modulus = 8 * contact.contact_modulus  # E′ = 2E*
    speed, weight, material = 0.04 * 1 / (modulus * 0.01), contact.load_per_length / (modulus * 0.01), 20e-9 * modulus
    published = 0.01 * 2.65 * speed**0.7 * material**0.54 * weight**-0.13
    assert published * 1e6 == pytest.approx(digits, abs=1e-4)
    assert contact.solve(accuracy=1e-4).dimensional["film_min"] == pytest.approx(published, rel=0.06)
