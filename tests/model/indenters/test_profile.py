"""Measured profiles: exact for a paraboloid, smooth through noise, two smoothings kept; what is refused."""

import numpy as np
import pytest

import softlube
from softlube.errors import InputError
from softlube.model.dry import dry_contact
from softlube.model.indenters import Profile, Sphere, SplineShape
from softlube.model.indenters.profile import smoothings
from softlube.model.parts import resolve
from softlube.model.substrates import HalfSpaceKernel

R = 2e-3


def written(path, r, z):
    path.write_text("r [mm], z [um]\n" + "\n".join(f"{a * 1e3:.9g}, {b * 1e6:.9g}" for a, b in zip(r, z, strict=True)))
    return str(path)


def test_a_paraboloid_is_found_exactly():
    r = np.linspace(0, 1e-3, 60)
    chosen, _ = smoothings(r, r**2 / (2 * R) + 3e-6, 1e-9)
    assert chosen.reference_radius == pytest.approx(R, rel=1e-9)
    x = np.linspace(0, 3, 7)
    shape = chosen.shape(0.01, 1.0)
    assert shape.height(x) == pytest.approx(x**2 / 2, rel=1e-8, abs=1e-12)
    assert shape.height(60.0) == pytest.approx(1800, rel=1e-7)  # far beyond the last place
    dry = dry_contact(HalfSpaceKernel(), 1.0, shape)
    assert (dry.indentation, dry.edge_rise) == (pytest.approx(1, rel=1e-7), pytest.approx(1, rel=1e-7))


def test_a_trace_of_a_true_sphere_with_noise():
    rng = np.random.default_rng(1)
    r = np.linspace(-1e-3, 1e-3, 801)
    noise = 10e-9
    chosen, coarser = smoothings(r, R - np.sqrt(R**2 - r**2) + rng.normal(0, noise, r.size), None)
    assert chosen.deviation == pytest.approx(noise, rel=0.15)
    assert len(coarser.coefficients) <= len(chosen.coefficients) <= 10
    own, true = chosen.shape(1e-2, 1.0), Sphere(chosen.reference_radius).shape(1e-2, 1.0)
    a = 3e-4 / chosen.reference_radius / 0.1
    ours, exact = dry_contact(HalfSpaceKernel(), a, own), 3e-4 / R
    depth = 3e-4 * np.arctanh(exact)
    assert ours.indentation * 1e-2 * chosen.reference_radius == pytest.approx(depth, rel=2e-3)
    assert true.height(1.0) == 0.5


def test_a_tolerance_chooses_the_fewest_pieces():
    r = np.linspace(0, 1e-3, 200)
    z = R - np.sqrt(R**2 - r**2)
    sizes = [len(smoothings(r, z, tolerance)[0].coefficients) for tolerance in (1e-8, 1e-11, 1e-13)]
    assert sizes == sorted(sizes)
    assert sizes[0] < sizes[-1]
    with pytest.raises(InputError, match=r"profile_tolerance: no smoothing comes nearer than .* expected a larger one"):
        smoothings(r, z + 1e-8 * np.cos(900 * r / r[-1]), 1e-12)


def test_a_part_keeps_its_smoothed_profile(tmp_path):
    r = np.linspace(0, 1e-3, 60)
    path = written(tmp_path / "ball.csv", r, r**2 / (2 * R))
    part = Profile(path, tolerance="1 nm")
    (tmp_path / "ball.csv").unlink()
    assert resolve(["indenter"], part.flat()) == {"indenter": part}
    assert hash(part) == hash(resolve(["indenter"], part.flat())["indenter"])
    shape = part.shape(1e-3, 0.9)
    assert isinstance(shape, SplineShape)
    kept = softlube.Problem(beta=100.0, indenter=shape).to_plain()
    assert softlube.Problem.from_plain(kept).indenter == shape
    with pytest.raises(InputError, match="profile_spline: no smoothed profile of softlube"):
        Profile(path, spline="[[1, 2]]")


def test_a_profile_that_is_a_paraboloid_is_solved_as_one(tmp_path):
    r = np.linspace(0, 1.5e-3, 60)
    path = written(tmp_path / "ball.csv", r, r**2 / (2 * R))
    rest = {"young_modulus": "3 MPa", "viscosity": "2 Pa s", "speed": "1 mm/s", "load": "20 mN"}
    contact = softlube.Contact(profile=path, profile_tolerance="1 nm", **rest)
    assert "profile_spline" not in repr(contact)  # kept in files, written by nobody
    ours = contact.solve()
    plain = softlube.Contact(radius=R, **rest).solve()
    for name, value in plain.dimensional.items():
        assert ours.dimensional[name] == pytest.approx(value, rel=1e-6), name


@pytest.mark.parametrize(
    ("r", "z", "message"),
    [
        (np.linspace(0, 1, 8), lambda r: r**2, "profile: expected at least 12 different radii, got 8"),
        (np.linspace(0.3, 1, 40), lambda r: r**2, "profile: the innermost radius is 0.3 m; expected one within 0.1"),
        (np.linspace(0, 1, 40), lambda r: -(r**2), "profile: the surface does not rise from the axis outwards"),
        (np.linspace(0, 1, 40), lambda r: r**2 * (1 - r**2), "profile: the surface does not rise from the axis outwards"),
        (np.linspace(0, 1, 40), lambda r: (r**2 - 0.2) ** 2, "profile: the lowest point is 0.04 m below the axis"),
    ],
)
def test_impossible_profiles(r, z, message):
    with pytest.raises(InputError, match=message):
        smoothings(r, z(r), None)
