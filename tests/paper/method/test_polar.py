"""The paper's polar scheme: film, load, one sweep, the discrete problem that it solves."""

import numpy as np
import pytest

from softlube.model.exact import HERTZ_LOAD, HERTZ_PRESSURE, hertz_pressure
from softlube.model.problem import Problem
from softlube.paper.method import march_relaxation, solve_relaxation
from softlube.paper.method.mesh import PaperMesh
from softlube.paper.method.polar import PolarScheme
from softlube.paper.method.stencil import reynolds_stencil


@pytest.fixture(scope="module")
def march():
    """The published mesh, β = 10 … 1000 in one march."""
    return {solution.beta: solution for solution in march_relaxation([10, 30, 100, 300, 1000])}


def test_the_solution_satisfies_the_discrete_complementarity_problem(march):
    """Independent of the iteration: (13) where p > 0, and a source where p was cut to zero."""
    mesh = PaperMesh(50, 30)
    at = solve_relaxation(Problem(beta=30), tolerance=1e-9).fields
    stencil = reynolds_stencil(at.film, mesh, 30.0)
    balance = stencil.residual(at.pressure) / stencil.C
    wet = at.pressure[1:-1] > 0
    assert 0.05 < 1 - wet.mean() < 0.9
    assert np.abs(balance[wet]).max() < 1e-8 * HERTZ_PRESSURE
    assert np.all(balance[~wet] <= 1e-12)
    scheme = PolarScheme(mesh)
    np.testing.assert_allclose(scheme.film(at.pressure), at.film, rtol=1e-12)


def test_without_pressure_the_film_is_the_sphere_s_gap():
    scheme = PolarScheme(PaperMesh(24, 12))
    film = scheme.film(np.zeros(scheme.mesh.shape))
    assert film == pytest.approx(np.broadcast_to(-1 + scheme.mesh.r[:, None] ** 2 / 2, film.shape))


def test_the_load_of_hertz_pressure():
    """(4/3π) of Eq. (5b), from the uniform pressures of the cells: second order in their size."""
    errors = []
    for n_r, n_theta in ((50, 30), (100, 60)):
        scheme = PolarScheme(PaperMesh(n_r, n_theta))
        pressure = np.repeat(hertz_pressure(scheme.mesh.r)[:, None], n_theta + 1, axis=1)
        errors.append(abs(scheme.load(pressure) / HERTZ_LOAD - 1))
    assert errors[0] < 0.004
    assert errors[1] < errors[0] / 3


def test_a_sweep_leaves_the_solution_where_it_is(march):
    """The end of the march is a fixed point of (19), to the tolerance of the iteration."""
    at = march[100].fields
    scheme = PolarScheme(PaperMesh())
    pressure = np.where(at.pressure > 0, at.pressure, 0.0)

    def changed_by_a_sweep(pressure):
        new = scheme.sweep(pressure, scheme.film(pressure), 100.0, 0.1, floor=0.0)
        assert np.all(new >= 0)
        assert np.all(new[-1] == 0)
        return np.abs(new - pressure).max()

    assert changed_by_a_sweep(pressure) < 0.02 * changed_by_a_sweep(1.1 * pressure)
