"""The laws for β → ∞ against solved contacts."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import beta as euler_beta
from scipy.special import comb, gamma

import softlube
from softlube import limits

# --- β → ∞ -------------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def heavy():
    """Solutions of the full problem, accuracy 1e-3, at two β of the asymptotic range."""
    return {beta: softlube.solve(beta=beta) for beta in (1e4, 1e5)}


def test_constants_of_the_hertz_limit():
    """Digits that the docs and docstrings quote, recomputed (convergence: test_inlet.py)."""
    assert limits.film_constant() == pytest.approx(1.1070049254, abs=2e-10)
    assert limits.pressure_gradient_inlet_asymptote(1.0) == pytest.approx(0.120891877, abs=2e-9)
    assert limits.pressure_gradient_inlet_asymptote(1.0) / limits.HERTZ_PRESSURE == pytest.approx(0.59657750, abs=2e-8)
    assert limits.outlet_film_ratio("reynolds") == pytest.approx(0.796202056, abs=5e-10)
    assert limits.outlet_film_ratio("none") == pytest.approx(0.758010043, abs=2e-9)


@pytest.mark.parametrize(
    ("index", "slide_to_roll", "digits"),
    [(0.8, 0, 1.25723615), (0.8, 2, 1.09843385), (0.5, 0, 1.65918200), (0.5, 2, 1.03690804), (1.0, 1.0, 1.10700493)],
)
def test_constants_of_power_law_liquids(index, slide_to_roll, digits):
    """Digits of the docs; six are claimed (convergence: test_inlet.py)."""
    assert limits.film_constant(index, slide_to_roll) == pytest.approx(digits, rel=3e-7)
    assert limits.film_center_power_law(1e5, index, slide_to_roll) == pytest.approx(
        digits * 1e5 ** (-3 / (3 * index + 2)), rel=3e-7
    )


def test_edge_pressure_is_that_of_hertz():
    s = 1e-8
    assert limits.hertz_pressure(1 - s) == pytest.approx(limits.EDGE_PRESSURE * np.sqrt(s), rel=1e-7)


def check_remainder(heavy, name, asymptote, power, coefficient):
    """The remainder after two terms, over β^(−power), is moderate and changes slowly: no term of a lower order is missing."""
    left = {beta: (solution.quantities[name] / asymptote(beta) - 1) * beta**power for beta, solution in heavy.items()}
    assert left[1e5] == pytest.approx(coefficient, rel=0.15)
    assert left[1e4] == pytest.approx(left[1e5], rel=0.35)


def test_film_center_asymptote(heavy):
    check_remainder(heavy, "film_center", limits.film_center_asymptote, 0.4, 0.22)


def test_outlet_film_asymptote(heavy):
    check_remainder(heavy, "film_outlet_min", limits.film_outlet_min_asymptote, 0.4, 0.93)


def test_inlet_gradient_asymptote(heavy):
    check_remainder(heavy, "pressure_gradient_inlet", limits.pressure_gradient_inlet_asymptote, 0.4, -0.65)


def test_inlet_film_asymptote(heavy):
    check_remainder(heavy, "film_inlet", limits.film_inlet_asymptote, 0.4, -1.23)


def test_friction_asymptote(heavy):
    check_remainder(heavy, "friction_contact", limits.friction_contact_asymptote, 0.4, -0.60)


def test_load_asymptote(heavy):
    check_remainder(heavy, "load", limits.load_asymptote, 0.8, 3.2)


def test_growth_of_a_contact_lifted_by_a_film():
    """A film f inside raises the pressure at the edge, on the axis, by G/(π²√(1 − r²)).

    Copson: a part f_m(r) cos mθ gives G = d/dt t^(−m) ∫₀ᵗ r^(m+1) f_m/√(t² − r²) dr at t = 1.  For y^(2k) that is −1/(4k − 1),
    and the sum for (1 − y²)^(3/10) is in the second term of the inlet film.
    """
    weight = [gamma(0.5) * gamma(j + 1) / gamma(j + 0.5) for j in range(12)]  # of r^n cos mθ, j = (n + m)/2: 1 for a flat punch

    for k in range(6):
        by_parts = sum((-1) ** j * comb(2 * k, k - j) * weight[k + abs(j)] for j in range(-k, k + 1)) / 4**k
        assert by_parts == pytest.approx(-1 / (4 * k - 1), rel=1e-9)
    k = np.arange(200_000)
    coefficient = np.cumprod(np.append(1.0, (k - 0.3) / (k + 1)))[:-1]  # of (1 − y²)^(3/10)
    assert np.sum(-coefficient / (4 * k - 1)) == pytest.approx(-euler_beta(-0.25, 1.3) / 4, rel=1e-6)


def test_minimum_film_asymptote(heavy):
    check_remainder(heavy, "film_min", limits.film_min_asymptote, 0.5, -9.2)


def test_angle_of_the_minimum_film(heavy):
    for beta, solution in heavy.items():
        assert solution.film_min_angle_deg == pytest.approx(limits.film_min_angle_asymptote(beta), abs=120 * beta**-0.5)
    assert limits.film_min_angle_asymptote(1e8) == pytest.approx(90.774, abs=0.001)
    for law in (limits.film_min_asymptote, limits.film_min_angle_asymptote):
        with pytest.raises(ValueError, match="cavitation"):
            law(1e8, "half-sommerfeld")


def test_film_along_the_contact(heavy):
    """Two terms come within a few β^(−2/5) everywhere; one term does not even have the asymmetry."""
    beta, fields = 1e5, heavy[1e5].fields
    for x, y in [(0.5, 0.0), (-0.5, 0.0), (0.4, 0.6), (-0.4, 0.6), (0.0, 0.8)]:
        film = float(fields.film_at(np.hypot(x, y), np.arctan2(y, x)))
        assert limits.film_contact_asymptote(x, y, beta) == pytest.approx(film, rel=0.7 * beta**-0.4)
    assert limits.film_contact_asymptote(-0.5, 0.0, beta, terms=1) > 1.05 * fields.film_at(0.5, np.pi)
    assert limits.film_contact_asymptote(0.0, 0.0, beta) == pytest.approx(limits.film_center_asymptote(beta), rel=1e-12)


def test_second_term_of_the_film_conserves_mass():
    """∂/∂x (u₁ + β u₀³ p_x) + ∂/∂y (β u₀³ p_y) = 0, the differences of the closed form."""
    beta, d, x, y = 1e6, 1e-4, 0.3, 0.45

    def flux(x, y):
        first = limits.film_contact_asymptote(x, y, beta, terms=1)
        second = limits.film_contact_asymptote(x, y, beta, terms=2) - first
        slope = -limits.HERTZ_PRESSURE / np.sqrt(1 - x**2 - y**2)
        return second + beta * first**3 * slope * x, beta * first**3 * slope * y

    along = (flux(x + d, y)[0] - flux(x - d, y)[0]) / (2 * d)
    across = (flux(x, y + d)[1] - flux(x, y - d)[1]) / (2 * d)
    assert along == pytest.approx(-across, rel=1e-5)
    assert abs(along) > 1e-6


def test_friction_asymptote_is_the_integral_of_the_shear():
    """∫dA/(βu) with 1/u = 1/u₀ − u₁/u₀², by quadrature."""
    beta = 1e5

    def shear(x, y):
        first = limits.film_contact_asymptote(x, y, beta, terms=1)
        return (2 - limits.film_contact_asymptote(x, y, beta) / first) / (beta * first)

    # x = X sin φ, y = sin ψ remove the roots at the edge
    def over_chord(psi):
        y, half_chord = np.sin(psi), np.cos(psi)
        return quad(lambda phi: shear(half_chord * np.sin(phi), y) * half_chord**2 * np.cos(phi), -np.pi / 2, np.pi / 2)[0]

    friction = 2 * quad(over_chord, 0, np.pi / 2, limit=100)[0]
    assert limits.friction_contact_asymptote(beta) == pytest.approx(friction, rel=1e-5)


@pytest.mark.parametrize("law", [limits.film_center_asymptote, limits.load_asymptote, limits.friction_contact_asymptote])
def test_asymptotes_take_arrays_and_count_their_terms(law):
    beta = np.array([1e4, 1e8])
    assert law(beta).shape == (2,)
    assert law(beta, terms=2)[1] == pytest.approx(law(beta, terms=1)[1], rel=0.02)
    with pytest.raises(ValueError, match="terms"):
        law(beta, terms=3)
