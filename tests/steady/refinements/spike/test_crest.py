"""What is read off close-ups, against profiles that are known."""

from types import SimpleNamespace

import numpy as np
import pytest

import softlube
import softlube.discretization.measure
import softlube.theory.limits
from softlube.model.liquids import BarusLaw, DowsonHigginsonLaw
from softlube.model.quantities import Quantity
from softlube.readout.friction import split
from softlube.solvers.budget import OutOfTime
from softlube.solvers.newton import newton
from softlube.steady.refinements.spike import closeup
from softlube.steady.refinements.spike import crest as crests
from softlube.steady.refinements.spike.closeup import CloseUp, ShiftedSystem, carried, grid_about
from softlube.steady.refinements.spike.crest import Reading, couette_within, crest, resolve_spike
from softlube.steady.regime import Regime
from softlube.theory.engineering import BETA_LOAD_OF_M, alpha_of_moes


def column(cell, alternation, alpha=10.0):
    """Pressures 1.5 − 2 x ln(1/x) up to a fall of 0.8 within a cell, alternating ahead of it."""
    r = 0.4 + cell * (np.arange(80) - 59.5)
    x = np.maximum(0.4 - r, cell / 2)
    pressure = np.where(r < 0.4, 1.5 + 2.0 * x * np.log(x), 0.7)
    ahead = np.arange(59, -1, -1)
    pressure[:60] += alternation * (-1.0) ** ahead * 2.0**-ahead
    return SimpleNamespace(r=r, pressure=pressure[:, None], liquid=BarusLaw(alpha))


@pytest.mark.parametrize("cell", [1e-3, 1e-4, 1e-5])
def test_a_crest_is_found_behind_nodes_that_alternate(cell):
    """The alternation, 0.4 at the last node, costs 2 %; the rise over the last cells costs nothing."""
    assert crest(column(cell, 0.0), 0, 59).pressure == pytest.approx(1.5, abs=20 * cell)
    found = crest(column(cell, 0.4), 0, 59)
    assert found.pressure == pytest.approx(1.5, abs=0.02 + 20 * cell)
    assert 0 < found.residual < 0.02
    assert found.radius == pytest.approx(0.4, abs=cell)


def test_a_crest_that_the_cells_resolve_is_its_highest_node():
    gentle = column(1e-3, 0.0, alpha=1.0)  # ln η falls by 0.8 only
    found = crest(gentle, 0, 59)
    assert found.pressure == gentle.pressure[:60].max()
    assert found.residual == 0


def test_error_is_the_last_change_or_half_the_one_before_or_the_doubt():
    def error(*said):
        return crests._settled([Reading(*each) for each in said]).error

    assert error((1.0, 0.0), (1.1, 0.0), (1.4, 0.0)) == pytest.approx(0.3)
    assert error((1.0, 0.0), (2.0, 0.0), (2.1, 0.0)) == pytest.approx(0.5)
    assert error((1.0, 9.0), (1.0, 9.0), (1.0, 0.2)) == pytest.approx(0.2)


def test_couette_part_over_a_disc_about_the_contact_from_a_mesh_that_is_not():
    """A soft contact, whose friction `friction.split` integrates otherwise."""
    solution = softlube.solve(beta_load=100.0)
    shift = 0.3
    grid = grid_about(Regime.of(solution.problem), 39, shift, 0.6, 0.05)
    system = ShiftedSystem(solution.problem, grid, 1.0, shift)
    result = newton(system, np.append(carried(solution.fields, grid, shift).ravel(), solution.height))
    seen = CloseUp(shift, 0.6, system.fields(result.x), 0.0)
    for cutoff in (1.0, 2.0):
        assert couette_within(seen, seen.fields.pressure, cutoff) == pytest.approx(split(solution, cutoff).couette, rel=5e-3)


@pytest.fixture(scope="module")
def needle():
    """M = 20, L = 8: a spike that the contact's grids hardly resolve, and close-ups do in full."""
    alpha = float(alpha_of_moes(20, 8))
    lines = []
    solution = softlube.solve(
        beta_load=BETA_LOAD_OF_M * 20 ** (4 / 3),
        liquid=DowsonHigginsonLaw.of(BarusLaw(alpha), alpha / 20e-9),
        accuracy=1e-2,
        progress=lines.append,
    )
    return solution, lines


def test_what_close_ups_say_of_a_needle(needle):
    """Against meshes three times as fine along r: 1.7055 p_H, at most 1.757 p_H, friction 494.5."""
    solution, lines = needle
    assert sum("nodes about the spike solved in" in str(line) for line in lines) == 4
    assert not solution.warnings
    hertz = softlube.limits.HERTZ_PRESSURE
    for name, expected in (
        ("spike_pressure", 1.7055 * hertz),
        ("spike_radius", 0.7317),
        ("pressure_max", 1.757 * hertz),
        ("friction_contact", 494.5),
    ):
        quantity = solution.quantities[name]
        assert abs(quantity - expected) < quantity.error < 0.07 * expected, name
    # What the contact's own grids would have said is 18 % lower.
    assert solution.levels[-1].values["friction_contact"] < 0.85 * solution.friction_contact


def test_frictions_over_other_discs_hold_the_spike_too(needle):
    solution, _ = needle
    assert solution.friction_within(1.0) == pytest.approx(float(solution.friction_contact), rel=1e-6)
    assert split(solution, 2.0).sphere == pytest.approx(float(solution.friction_domain), rel=1e-6)
    inside = solution.friction_within(0.7)  # the spike stands at 0.73
    assert inside == softlube.discretization.measure.friction_within(solution.fields, 0.7)


def test_friction_of_a_needle_in_the_other_normalisation(needle):
    """The spike adds the same force in either, and the discs differ by little else."""
    solution, _ = needle
    unit = -solution.height
    other = solution.normalised("indentation")["friction_domain"]
    added = solution.friction_domain - solution.levels[-1].values["friction_domain"]
    grid = softlube.discretization.measure.measure(solution.fields.in_units(unit))["friction_domain"]
    assert other == pytest.approx(grid + added / unit**2, rel=1e-12)
    assert other.error == pytest.approx(solution.friction_domain.error / unit**2)


def test_no_number_where_the_meshes_do_not_see_the_same_contact(needle, monkeypatch):
    solution, _ = needle
    monkeypatch.setattr(crests, "SAME_FILM", 1e-9)
    monkeypatch.setattr(crests, "WIDTHS", (1e-2,))
    monkeypatch.setattr(crests, "close_ups", lambda regime, fields: closeup.close_ups(regime, fields, (1e-2,), 26))
    assert resolve_spike(Regime.of(solution.problem), solution.fields) == {}


def test_the_friction_of_a_close_up_gets_the_hysteresis_of_a_substrate_that_remembers(monkeypatch):
    monkeypatch.setattr(crests, "tracked", lambda grids: {})
    monkeypatch.setattr(crests, "wants_close_up", lambda fields, known: True)
    monkeypatch.setattr(crests, "resolve_spike", lambda *_: {"friction_total": Quantity(5.0, 0.1)})
    unknown = {"friction_total": Quantity(np.nan, np.inf), "friction_viscous": Quantity(np.nan, np.inf)}
    elastic = crests.spike_quantities(None, [None], {"friction_total": unknown["friction_total"]})
    remembers = crests.spike_quantities(None, [None], unknown | {"friction_hysteresis": Quantity(2.0, 0.05)})
    assert {name: float(each) for name, each in elastic.items()} == {"friction_total": 5.0}
    assert {name: float(each) for name, each in remembers.items()} == {"friction_total": 7.0, "friction_viscous": 5.0}
    assert remembers["friction_total"].error == pytest.approx(0.15)


def test_a_budget_that_is_spent_on_close_ups_leaves_the_contact_solved(monkeypatch):
    def spent(*_):
        raise OutOfTime

    monkeypatch.setattr(crests, "tracked", lambda grids: {"spike_radius": Quantity(0.9, 0.01)})
    monkeypatch.setattr(crests, "wants_close_up", lambda fields, known: True)
    monkeypatch.setattr(crests, "resolve_spike", spent)
    assert crests.spike_quantities(None, [None], {}) == {"spike_radius": Quantity(0.9, 0.01)}


@pytest.mark.parametrize(("on_grid", "kept"), [((155.3, 0.4), False), ((158.5, 0.4), True), ((158.5, 0.8), False)])
def test_grids_that_agree_by_chance_do_not_outweigh_close_ups(monkeypatch, on_grid, kept):
    """A friction of 158.7 ± 0.6 from close-ups, and another of a grid that misses a part of the spike and does not know it."""
    monkeypatch.setattr(crests, "tracked", lambda grids: {})
    monkeypatch.setattr(crests, "wants_close_up", lambda fields, known: True)
    monkeypatch.setattr(crests, "resolve_spike", lambda *_: {"friction_contact": Quantity(158.7, 0.6)})
    found = crests.spike_quantities(None, [None], {"friction_contact": Quantity(*on_grid)})
    assert ("friction_contact" not in found) is kept
