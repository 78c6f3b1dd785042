"""Cases of the figures, solved when first asked for and more coarsely than the command does; figures, drawn once."""

import pytest

import softlube
from softlube.paper.figures import FIGURES
from softlube.paper.figures.base import BALL_ON_RUBBER


class Solved(dict):
    """Solutions by case."""

    def __missing__(self, case):
        if case.physical:
            self[case] = softlube.Contact(**BALL_ON_RUBBER).solve(accuracy=0.01)
        else:
            self[case] = softlube.solve(case.beta, cavitation=case.cavitation, accuracy=0.02)
        return self[case]


@pytest.fixture(scope="session")
def solutions():
    return Solved()


@pytest.fixture(scope="session")
def drawn(solutions):
    pictures = {}

    def get(key):
        if key not in pictures:
            pictures[key] = FIGURES[key].draw({case: solutions[case] for case in FIGURES[key].cases})
        return pictures[key]

    return get
