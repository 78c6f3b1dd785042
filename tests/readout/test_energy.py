"""The balance of energy: friction × speed = dissipation in the film + loss in the substrate."""

import pytest

import softlube
from softlube.errors import InputError
from softlube.model.liquids import BarusLaw
from softlube.model.substrates import ViscoelasticKernel
from softlube.readout.energy import energy_balance


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
