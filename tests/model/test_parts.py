"""Parts: their constructors, and how they are found from inputs alone."""

import copy
import pickle
from inspect import signature

import pytest

from softlube.errors import InputError
from softlube.model.liquids import Barus, Incompressible, Newtonian, Roelands
from softlube.model.parts import Part, resolve, vocabulary
from softlube.model.substrates import HalfSpace, Layer


def substrate(**given):
    return resolve(["substrate"], given)["substrate"]


def liquid(**given):
    return resolve(["liquid"], given)["liquid"]


def test_parts_are_values():
    part = Layer("3 MPa", thickness="2 mm")
    for twin in (Layer(shear_modulus=1e6, thickness=2e-3), copy.deepcopy(part), pickle.loads(pickle.dumps(part))):
        assert twin == part
        assert hash(twin) == hash(part)
    assert part != Layer("3 MPa", thickness="1 mm")
    assert repr(Newtonian("2 Pa s")) == "Newtonian(viscosity=2.0)"
    with pytest.raises(AttributeError, match="immutable"):
        part.thickness = 3.0


def test_the_signature_is_the_declaration():
    assert str(signature(Layer)) == (
        "(young_modulus=None, *, shear_modulus=None, poisson_ratio=0.5, radius=None, thickness, base='bonded')"
    )
    for arguments in ((1.0, 2.0), (1.0,)):
        with pytest.raises(TypeError, match="expected Newtonian"):
            Newtonian(*arguments, viscosity=1.0)
    with pytest.raises(TypeError, match="expected Newtonian"):
        Newtonian(colour=1.0)


def test_parts_follow_from_their_inputs():
    assert substrate(young_modulus="3 MPa") == HalfSpace("3 MPa")
    assert substrate(young_modulus="3 MPa", base="bonded") == HalfSpace("3 MPa")
    assert substrate(young_modulus=3e6, thickness="1 mm", base="frictionless") == Layer(
        3e6, thickness=1e-3, base="frictionless"
    )
    assert liquid(viscosity=2.0) == liquid(viscosity=2.0, viscosity_law="barus") == Newtonian(2.0)
    assert liquid(viscosity=2.0, pressure_viscosity=1e-8) == Barus(2.0, pressure_viscosity=1e-8)
    assert liquid(viscosity=2.0, pressure_viscosity=1e-8, viscosity_law="roelands") == Roelands(2.0, pressure_viscosity=1e-8)
    assert resolve(["compressibility"], {}) == {"compressibility": Incompressible()}


@pytest.mark.parametrize("part", [Layer(3e6, thickness=1e-3, poisson_ratio=0.3), Roelands(2.0, pressure_viscosity=1e-8)])
def test_a_part_is_found_again_from_its_own_inputs(part):
    assert resolve([part.slot], part.flat()) == {part.slot: part}


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (
            {"thickness": "1 mm", "substrate": HalfSpace(1.0)},
            r"substrate, thickness: HalfSpace.* says it already; give the part",
        ),
        ({"substrate": Newtonian(1.0)}, r"substrate: expected .*HalfSpace.* got Newtonian"),
        ({"substrate": "layer"}, r"substrate: expected .*Layer.* got 'layer'"),
        ({"young_modulus": 1.0, "base": "frictionless"}, "base, thickness: the first means nothing without the second"),
        (
            {"young_modulus": 1.0, "thickness": "1 mm", "base": "glued"},
            "base: expected 'bonded' or 'frictionless', got 'glued'",
        ),
    ],
)
def test_substrates_that_are_none(given, message):
    with pytest.raises(InputError, match=message):
        substrate(**given)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (
            {"viscosity_law": "newtonian", "pressure_viscosity": 1e-8},
            "viscosity_law, pressure_viscosity: 'newtonian' has no such",
        ),
        ({"viscosity_law": "roelands"}, "viscosity_law, pressure_viscosity: the first means nothing without the second"),
        ({"viscosity": None}, "viscosity: missing; expected a dynamic viscosity such as '2 Pa s'"),
    ],
)
def test_liquids_that_are_none(given, message):
    with pytest.raises(InputError, match=message):
        liquid(**{"viscosity": 1.0} | given)


def test_the_vocabulary_has_every_input_once():
    names = list(vocabulary(["substrate", "liquid"]))
    assert names[:5] == ["young_modulus", "shear_modulus", "poisson_ratio", "substrate_radius", "thickness"]
    assert len(names) == len(set(names))
    assert names[-1] == "viscosity_law"
    assert {kind.slot for kinds in Part.slots.values() for kind in kinds.values()} >= {
        "indenter",
        "substrate",
        "liquid",
        "motion",
    }
