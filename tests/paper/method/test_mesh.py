import numpy as np
import pytest

from softlube.paper.method.mesh import FEWEST, PaperMesh, graded_spacings, growing_spacings


def growth(d):
    """The coefficient a/L of Eq. (12) with b = 0 that each pair of neighbouring spacings shows: (λ_j − 1)/d_{j−1}."""
    return (d[1:] / d[:-1] - 1) / d[:-1]


def test_a_growing_segment_follows_the_rule_and_fills_its_length():
    d = growing_spacings(8, 0.8, 0.05)
    assert d.sum() == pytest.approx(0.8, rel=1e-12)
    slope = growth(np.append(0.05, d))
    assert slope[0] > 0
    np.testing.assert_allclose(slope, slope[0], rtol=1e-9)


def test_a_graded_segment_follows_the_rule_and_fills_its_length():
    d = graded_spacings(14, 0.2, 0.057)
    assert d.sum() == pytest.approx(0.2, rel=1e-12)
    slope = growth(np.append(d, 0.057))
    assert slope[0] > 0
    np.testing.assert_allclose(slope, slope[0], rtol=1e-9)


@pytest.mark.parametrize("n_r", [FEWEST, 21, 23, 50, 101])
def test_the_mesh_has_its_nodes_and_is_dense_at_the_contact_edge(n_r):
    mesh = PaperMesh(n_r, 30)
    assert mesh.r.shape == (n_r + 1,)
    assert mesh.r[0] == 0
    assert mesh.r[-1] == 2
    assert np.all(mesh.d > 0)
    edge = int(np.flatnonzero(mesh.r == 1)[0])
    assert mesh.d[edge] == pytest.approx(mesh.d[edge - 1], rel=1e-9)
    assert mesh.d.argmin() in (edge - 1, edge)
    assert mesh.d.min() < 0.3 * 2 / n_r


def test_the_published_mesh():
    mesh = PaperMesh(50, 30)
    assert mesh.shape == (51, 31)
    assert mesh.theta[[0, 15, 30]] == pytest.approx([0, np.pi / 2, np.pi])
    assert mesh.d.min() < 0.007
    np.testing.assert_allclose(mesh.ratio, mesh.d[1:] / mesh.d[:-1])


def test_refinement_keeps_the_grading():
    coarse, fine = PaperMesh(50), PaperMesh(100)
    # λ − 1 is proportional to the spacing, which is what keeps (11b) second order.
    assert abs(fine.ratio - 1).max() == pytest.approx(abs(coarse.ratio - 1).max() / 2, rel=0.2)


def test_impossible_meshes_are_refused():
    with pytest.raises(ValueError, match="n_r"):
        PaperMesh(FEWEST - 1, 30)
    with pytest.raises(ValueError, match="4"):
        PaperMesh(50, 3)
    with pytest.raises(ValueError, match="at most"):
        growing_spacings(10, 0.5, 0.06)
    with pytest.raises(ValueError, match="at least"):
        graded_spacings(10, 0.5, 0.04)
