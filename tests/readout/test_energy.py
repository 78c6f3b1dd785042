"""The balance of energy: friction × speed = dissipation in the film + loss in the substrate."""

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

import softlube
from softlube.errors import InputError
from softlube.model.liquids import BarusLaw, CarreauYasudaLaw, NewtonianLaw
from softlube.model.substrates import ViscoelasticKernel
from softlube.readout.energy import energy_balance, film_dissipation, surface_work


def remembering(beta, length, share=0.5):
    return softlube.solve(beta=beta, substrate=ViscoelasticKernel((share,), (length,)))


@pytest.mark.parametrize("beta", [30.0, 100.0, 300.0, 1000.0])
@pytest.mark.parametrize("length", [0.2, 0.7, 1.9])
def test_it_is_closed(beta, length):
    """Both losses by integrals that the friction has not: of |∇p|², and of the internal variables."""
    balance = energy_balance(remembering(beta, length))
    assert balance.imbalance == pytest.approx(0, abs=1e-4)
    assert balance.viscous + balance.edge_work == pytest.approx(balance.film, rel=1e-4)
    assert balance.substrate == pytest.approx(balance.hysteresis, rel=1e-3)


def test_an_elastic_substrate_loses_nothing():
    balance = energy_balance(softlube.solve(beta=100.0), 3.0)
    assert (balance.substrate, balance.hysteresis) == (0.0, 0.0)
    assert balance.imbalance == pytest.approx(0, abs=1e-4)


def test_several_times_lose_each_their_part():
    kernel = ViscoelasticKernel((0.3, 0.2), (0.5, 1.5))
    balance = energy_balance(softlube.solve(beta=100.0, substrate=kernel))
    assert balance.imbalance == pytest.approx(0, abs=1e-4)


def test_what_has_no_balance_is_refused():
    with pytest.raises(InputError, match="a liquid of constant viscosity"):
        energy_balance(softlube.solve(beta=100.0, liquid=BarusLaw(1.0)))
    with pytest.raises(InputError, match="remembers over 50 units of length"):
        energy_balance(remembering(100.0, 50.0))
    with pytest.raises(InputError, match="has no energy balance"):
        energy_balance(softlube.solve(beta=100.0, method="relaxation"))


def over_disc(density, cutoff):
    """∫ density dA by Gauss's quadrature on rings that are narrow at the contact's edge."""
    x, weight = leggauss(8)

    def points(edges):
        half = np.diff(edges)[:, None] / 2
        return (edges[:-1, None] + half * (x + 1)).ravel(), (half * weight).ravel()

    within, outside = np.linspace(0, 1.2, 150), np.geomspace(1.2, cutoff, 60)
    r, across = points(np.append(within, outside[1:]))
    theta, along = points(np.linspace(0, np.pi, 100))
    return 2 * (across * r) @ density(*np.meshgrid(r, theta, indexing="ij")) @ along


@pytest.mark.parametrize(
    ("share", "length", "beta"),
    [
        (0.5, 1.0, 300.0),
        pytest.param(0.9, 0.3, 100.0, marks=pytest.mark.slow),
        pytest.param(0.5, 50.0, 1000.0, marks=pytest.mark.slow),
    ],
)
def test_maps_sum_up_to_the_frictions(share, length, beta):
    solution = remembering(beta, length, share)
    rim = float(solution.fields.r[-1]) * (1 - 1e-9)
    work = over_disc(lambda r, theta: surface_work(solution, r, theta), rim)
    assert work == pytest.approx(solution.friction_hysteresis, rel=1e-4)
    lost = over_disc(lambda r, theta: film_dissipation(solution, r, theta), 2.0)
    if length < 2:
        assert lost == pytest.approx(energy_balance(solution).film, rel=1e-4)


@pytest.mark.slow
def test_a_liquid_that_thins_loses_what_its_walls_and_its_pressure_put_in():
    """The shear on the substrate, and what the pressure drives in through the edge, in the frame of the sphere."""
    solution, cutoff = softlube.solve(beta=300.0, liquid=CarreauYasudaLaw(NewtonianLaw(), 3.0, 0.6, 0.1)), 6.0
    lost = over_disc(lambda r, theta: film_dissipation(solution, r, theta), cutoff)
    theta = (np.arange(400) + 0.5) * np.pi / 400
    outwards = solution.fields.pressure_at(cutoff, theta) * softlube.flow.flux(solution, cutoff, theta)[0]
    edge = -12 * cutoff * np.mean(outwards) * np.pi
    assert lost == pytest.approx(softlube.friction.split(solution, cutoff).substrate + edge, rel=5e-4)


def test_an_elastic_surface_has_no_map():
    with pytest.raises(InputError, match="its substrate is elastic and remembers nothing"):
        surface_work(softlube.solve(beta=100.0), 0.5, 0.0)
