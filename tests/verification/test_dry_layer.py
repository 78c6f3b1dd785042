"""Dry contacts on layers against finite elements, and against the series of Dimitriadis et al. within its accuracy.

The finite elements know nothing of kernels or integral equations: the layer's elasticity itself, displacements and mean stress
(Q2-Q1), axisymmetric, and contact node by node.
"""

import numpy as np
import pytest
import skfem as fem
from scipy.sparse import bmat
from skfem.helpers import grad

from softlube.model.dry import PARABOLOID, dry_contact_at
from softlube.model.exact import HERTZ_LOAD
from softlube.model.indenters import PowerShape, RoundedConeShape, RoundedPunchShape, SphereShape
from softlube.model.substrates import LayerKernel

FINITE_ELEMENT_ERROR = 2e-4
"""Of the load on the mesh below: where the contact's edge lies between two nodes, it cannot tell."""


@fem.BilinearForm
def stiffness(u, v, w):
    """2G ε(u):ε(v), with G = 1; dA = r dr dz."""
    du, dv = grad(u), grad(v)
    strains = sum((du[i, j] + du[j, i]) * (dv[i, j] + dv[j, i]) / 4 for i in range(2) for j in range(2))
    return 2 * (strains + u[0] * v[0] / w.x[0] ** 2) * w.x[0]


@fem.BilinearForm
def dilation(u, q, w):
    du = grad(u)
    return -(du[0, 0] + du[1, 1] + u[0] / w.x[0]) * q * w.x[0]


@fem.BilinearForm
def mass(p, q, w):
    return p * q * w.x[0]


@fem.BilinearForm
def rim(u, v, w):
    """Further out the layer moves aside like 1/r, if at all: it is held with −2G u/r."""
    return 2 * u[0] * v[0]


def finite_element_load(chi, poisson_ratio=0.5, base="bonded", cells=16, outline=PARABOLOID, radius=1.0):
    """Load over Hertz's at the same indentation, of a sphere on a layer of thickness 1, χ = √(Rδ)/t, by finite elements.

    Another indenter has its outline in units of δ, as a function of the distance over √(Rδ), and about a contact radius.
    """
    wide = 1.5 * chi * radius
    r = np.concatenate((np.linspace(0, wide, 3 * cells + 1), wide + np.expm1(np.linspace(0, np.log(9), 2 * cells + 1))[1:]))
    z = np.sin(np.pi / 2 * np.linspace(0, 1, cells + 1)) - 1
    u = fem.Basis(fem.MeshQuad.init_tensor(r, z), fem.ElementVector(fem.ElementQuad2()), intorder=5)
    p = u.with_element(fem.ElementQuad1())
    divergence = dilation.assemble(u, p)
    compressibility = (1 - 2 * poisson_ratio) / (2 * poisson_ratio)
    elasticity = stiffness.assemble(u) + rim.assemble(u.boundary(lambda x: np.isclose(x[0], r[-1])))
    matrix = bmat([[elasticity, divergence.T], [divergence, -compressibility * mass.assemble(p)]], format="csr")

    bottom = u.get_dofs(lambda x: np.isclose(x[1], -1))
    axis = u.get_dofs(lambda x: np.isclose(x[0], 0)).all("u^1")
    held = np.union1d(bottom.all() if base == "bonded" else bottom.all("u^2"), axis)
    top = u.get_dofs(lambda x: np.isclose(x[1], 0)).all("u^2")
    distance = u.doflocs[0, top]
    depth = 1 - outline.height(distance / chi)  # in units of δ
    touching = distance < chi * radius
    for _ in range(20):
        x = np.zeros(matrix.shape[0])
        x[top[touching]] = -depth[touching]
        x = fem.solve(*fem.condense(matrix, np.zeros_like(x), x=x, D=np.union1d(held, top[touching])))
        force = -(matrix @ x)[top]
        # A node leaves that is pulled and joins where the layer pokes into the sphere; the axis has no area of its own.
        now = np.where(touching, force > 0, -x[top] < depth) | (distance == 0)
        if np.array_equal(now, touching):
            return 2 * np.pi * force[touching].sum() / (8 * chi / (3 * (1 - poisson_ratio)))
        touching = now
    raise AssertionError("the contact's nodes do not settle")


def dry_load(chi, *layer):
    return dry_contact_at(LayerKernel(1 / chi, *layer), indentation=1.0).load / HERTZ_LOAD


@pytest.mark.parametrize("chi", [0.1, 0.2, 1 / 3, 0.5, 0.7, 1.0])
def test_within_the_accuracy_of_dimitriadis_series(chi):
    """Dimitriadis et al., Biophys. J. 82 (2002) 2798, Eq. (12): how accurate the series is, finite elements say."""
    series = 1 + 1.133 * chi + 1.283 * chi**2 + 0.769 * chi**3 + 0.0975 * chi**4
    load = finite_element_load(chi)
    accuracy = abs(series / load - 1)
    ours = dry_load(chi)
    assert ours == pytest.approx(load, rel=FINITE_ELEMENT_ERROR)
    assert abs(series / ours - 1) <= accuracy + FINITE_ELEMENT_ERROR


@pytest.mark.parametrize("layer", [(0.3, "bonded"), (0.45, "bonded"), (0.3, "frictionless"), (0.5, "frictionless")])
@pytest.mark.parametrize("chi", [0.5, 2.0])
def test_any_layer_is_that_of_finite_elements(chi, layer):
    assert dry_load(chi, *layer) == pytest.approx(finite_element_load(chi, *layer), rel=FINITE_ELEMENT_ERROR)


SHAPES = [
    SphereShape(0.25, 1.0),
    PowerShape(3.0, 1.0, 4.0),
    RoundedPunchShape(1.0, 1.0, 0.5, 0.0),
    RoundedPunchShape(1.0, 1.0, 0.5, 0.2),
    RoundedConeShape(1.0, 1.0, 0.6, 5.0),
]


@pytest.mark.parametrize("chi", [0.5, 1.5])
@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_any_indenter_is_that_of_finite_elements(chi, shape):
    dry = dry_contact_at(LayerKernel(1 / chi), indentation=1.0, indenter=shape)
    load = finite_element_load(chi, outline=shape, radius=dry.radius)
    assert dry.load / HERTZ_LOAD == pytest.approx(load, rel=1e-3)


def test_finite_elements_converge():
    """The error falls with the cells; it is erratic, as the contact's edge lies anywhere between two nodes."""
    coarse, fine = (abs(finite_element_load(1.0, cells=cells) / dry_load(1.0) - 1) for cells in (4, 16))
    assert fine < coarse / 10
