"""The protocol of refinements: every kind answers all questions, and one that says nothing changes nothing."""

import softlube
from softlube.model.problem import Problem
from softlube.steady.ladder import Estimate, climb, solution_of
from softlube.steady.mesh import grid_for
from softlube.steady.refinements import KINDS, Refinement, refinements_for
from softlube.steady.regime import Regime


def test_a_feature_that_is_absent_changes_nothing():
    regime = Regime.of(Problem(beta=100.0))
    absent, grid = Refinement(regime), grid_for(regime, 12)
    assert absent.adjust(grid, None) is grid
    assert absent.determines(None, {}) == absent.amend([], {}, None) == {}
    assert absent.is_settled([], {})
    assert absent.doubts(None, {}, {}, 1e-3) == ()


def test_every_kind_has_words_for_its_feature():
    refinements = refinements_for(Regime.of(Problem(beta=100.0)))
    assert [type(each) for each in refinements] == list(KINDS)
    assert len({each.feature for each in refinements} | {Refinement.feature}) == len(KINDS) + 1


def test_the_ladder_knows_no_kind_by_name(monkeypatch):
    """A refinement that the package does not know is asked all its questions."""

    class Bump(Refinement):
        feature = "a bump"

        def adjust(self, grid, before):
            return type(grid)(**vars(grid) | {"reach": 1.1 * grid.reach})

        def amend(self, solved, quantities, progress):
            return {"film_min": softlube.Quantity(7.0, 0.5)}

        def doubts(self, finest, quantities, errors, accuracy):
            return (f"there is {self.feature}: {quantities['film_min']}",)

    monkeypatch.setattr("softlube.steady.refinements.KINDS", (*KINDS, Bump))
    solution = softlube.solve(beta=100.0, accuracy=1e-2)
    assert solution.film_min == 7.0
    assert solution.warnings == ("there is a bump: 7 ± 0.5",)
    assert solution.fields.chart.reach > 21


def test_a_solution_can_be_formed_from_grids_that_were_climbed_one_by_one():
    regime = Regime.of(Problem(beta=100.0))
    solved = list(zip(range(3), climb(regime), strict=False))
    grids = [grid for _, grid in solved]
    estimate = Estimate.from_grids(regime, grids)
    assert solution_of(regime, grids, 1e-3).quantities == estimate.quantities()
