import numpy as np
import pytest

from softlube.paper.method.mesh import PaperMesh
from softlube.paper.method.polar import PolarScheme
from softlube.paper.method.stencil import centre_pressure, reynolds_stencil
from softlube.paper.method.sweep import Wavefront


@pytest.mark.parametrize("floor", [0.0, -0.1, -np.inf])
@pytest.mark.parametrize("shape", [(7, 4), (4, 7), (1, 5)])
def test_fronts_give_the_node_by_node_substitution(shape, floor):
    rng = np.random.default_rng(5)
    front = Wavefront(shape)
    for _ in range(2):
        g, a, b = rng.normal(size=shape), rng.normal(size=shape), rng.normal(size=shape)
        x = np.zeros(shape)
        for j in range(shape[0]):
            for i in range(shape[1]):
                before = a[j, i] * x[j, i - 1] if i else 0.0
                below = b[j, i] * x[j - 1, i] if j else 0.0
                x[j, i] = max(g[j, i] - (before + below), floor)
        np.testing.assert_allclose(front.solve(g, a, b, floor=floor), x, rtol=1e-13)


def sweep_as_written(scheme, pressure, film, beta, factor):
    """Eq. (19) node by node: values at i − 1 and j − 1 new, at i + 1 and j + 1 old, mirror angles (17a) old."""
    mesh, at, old, new = scheme.mesh, reynolds_stencil(film, scheme.mesh, beta), pressure, pressure.copy()
    p0 = old[0, 0] + factor * (centre_pressure(old, film, mesh, beta) - old[0, 0])
    new[0] = max(p0, 0.0)
    m = mesh.n_theta
    for j in range(1, mesh.n_r):
        for i in range(m + 1):
            before = new[j, i - 1] if i > 0 else old[j, 1]
            after = old[j, i + 1] if i < m else old[j, m - 1]
            q = j - 1
            bracket = at.F[q, i] - at.A[q, i] * before - at.B[q, i] * new[j - 1, i] - at.C[q, i] * old[j, i]
            bracket += -at.D[q, i] * old[j + 1, i] - at.E[q, i] * after
            new[j, i] = max(old[j, i] + factor * bracket / at.C[q, i], 0.0)
    return new


@pytest.mark.parametrize("factor", [1.4, 0.1])
def test_the_polar_sweep_is_eq_19(factor):
    scheme = PolarScheme(PaperMesh(20, 6))
    rng = np.random.default_rng(2)
    pressure = scheme.guess() * (1 + 0.3 * rng.random(scheme.mesh.shape))
    pressure[0], pressure[-1] = pressure[0, 0], 0.0
    film = scheme.film(pressure)
    assert film.min() > 0
    expected = sweep_as_written(scheme, pressure, film, 10.0, factor)
    assert (expected[1:-1] == 0).any()
    np.testing.assert_allclose(scheme.sweep(pressure, film, 10.0, factor, floor=0.0), expected, rtol=1e-11, atol=1e-15)
