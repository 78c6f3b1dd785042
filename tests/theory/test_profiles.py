"""The laws of the Hertz limit for any profile: against solved contacts of n = 4, and the paraboloid's laws."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import softlube
from softlube.model.dry import dry_contact, dry_contact_at
from softlube.model.exact import HERTZ_PRESSURE
from softlube.model.indenters import Paraboloid, PowerShape, RoundedPunchShape, SphereShape
from softlube.model.substrates import HalfSpaceKernel, LayerKernel
from softlube.theory import limits, profiles

HERTZ = dry_contact(HalfSpaceKernel(), 1.0)
BLUNT = PowerShape(0.1, 1.0, 4.0)


@pytest.mark.parametrize("terms", [1, 2])
def test_the_paraboloid_has_its_own_laws(terms):
    beta = np.array([1e4, 1e7])
    assert profiles.film_center(HERTZ, beta, terms) == pytest.approx(limits.film_center_asymptote(beta, terms), rel=1e-7)
    assert profiles.film_min(HERTZ, beta, "none") == pytest.approx(limits.film_min_asymptote(beta, "none"))
    assert profiles.friction_contact(HERTZ, beta) == pytest.approx(limits.friction_contact_asymptote(beta, 1))
    inside = limits.film_contact_asymptote(0.0, 0.5, 1e6, 1)
    assert profiles.film_contact(HERTZ, 0.5, 1e6) == pytest.approx(inside)


def test_films_do_not_depend_on_the_unit_of_height():
    """In units of 2H films are half as large, and β is four times as large."""
    one = dry_contact_at(HalfSpaceKernel(), indentation=1.0, indenter=BLUNT)
    other = dry_contact_at(HalfSpaceKernel(), indentation=0.5, indenter=BLUNT.in_units(2.0))
    assert other.like_hertz(4e5) == pytest.approx(one.like_hertz(1e5), rel=1e-9)
    for law in (profiles.film_center, profiles.film_min):
        assert law(other, 4e5) == pytest.approx(law(one, 1e5) / 2, rel=1e-8)


def test_the_driven_part_in_closed_form():
    """∫ p′/r dr: of Hertz −(π/2) p_max/a; of n = 4, where p ~ (a² + 2r²) √(a² − r²), nothing."""
    assert profiles._driven(HERTZ) == pytest.approx(-np.pi / 2 * HERTZ_PRESSURE, rel=1e-8)
    blunt = dry_contact(HalfSpaceKernel(), 2.0, BLUNT)
    assert abs(profiles._driven(blunt)) < 1e-7 * float(blunt.pressure(0.0))


@pytest.mark.parametrize("substrate", [HalfSpaceKernel(), LayerKernel(0.7)])
@pytest.mark.parametrize("shape", [Paraboloid(), SphereShape(0.09, 1.0), RoundedPunchShape(0.1, 1.0, 0.3, 0.12)])
def test_what_the_dry_pressure_drives_is_its_transform_on_the_axis(substrate, shape):
    """∫₀^a p′/r dr by a spline through the pressure, against the closed form."""
    dry = dry_contact(substrate, 1.2, shape)
    t = np.linspace(0, np.pi / 2, 801)
    pressure = CubicSpline(t, dry.pressure(dry.radius * np.sin(t)), bc_type=((1, 0.0), "not-a-knot"))
    node, weight = np.polynomial.legendre.leggauss(4)
    place = (t[:-1, None] + np.diff(t)[:, None] * (node + 1) / 2).ravel()
    share = (np.diff(t)[:, None] * weight / 2).ravel()
    expected = share @ (pressure(place, 1) / np.sin(place)) / dry.radius
    assert profiles._driven(dry) == pytest.approx(expected, rel=1e-5)


def test_solved_films_tend_to_the_laws():
    """The film of n = 4 at the centre, extrapolated in β^(−1/5), and the least film: within 1 % of the laws."""
    dry = dry_contact_at(HalfSpaceKernel(), indentation=1.0, indenter=BLUNT)
    effective = np.array([1e5, 1e6, 1e7])
    beta = effective / dry.like_hertz(1.0)
    solved = [softlube.solve(beta=each, indenter=BLUNT) for each in beta]
    center = np.array([float(each.film_center) for each in solved]) / profiles.film_center(dry, beta, 1)
    assert np.polyfit(effective**-0.2, center, 2)[-1] == pytest.approx(1, abs=3e-3)
    friction = np.array([float(each.friction_contact) for each in solved]) / profiles.friction_contact(dry, beta)
    assert np.polyfit(effective**-0.2, friction, 2)[-1] == pytest.approx(1, abs=3e-3)
    least = np.array([float(each.film_min) for each in solved]) / profiles.film_min(dry, beta)
    assert np.polyfit(effective**-0.25, least, 2)[-1] == pytest.approx(1, abs=1e-2)
    assert least[-1] == pytest.approx(1, abs=0.01)


def test_a_true_sphere_differs_from_its_paraboloid_as_solved():
    """Differences by the laws lie within their stated error of the solved ones."""
    from softlube.physical.indenter_effect import LAW_ERROR

    beta, true = 1e4, SphereShape(0.09, 1.0)
    dry = dry_contact_at(HalfSpaceKernel(), indentation=1.0, indenter=true)
    solved, plain = softlube.solve(beta=beta, indenter=true), softlube.solve(beta=beta)
    for name in ("film_center", "film_min", "friction_contact"):
        law = getattr(profiles, name)
        terms = (1,) if name == "film_center" else ()
        told = float(law(dry, beta, *terms) / law(HERTZ, beta, *terms)) - 1
        is_so = solved.quantities[name] / plain.quantities[name] - 1
        noise = sum(each.quantities[name].error / each.quantities[name] for each in (solved, plain))
        assert abs(told - is_so) < LAW_ERROR * beta**-0.2 * abs(told) + noise
