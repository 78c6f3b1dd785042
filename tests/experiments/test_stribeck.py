"""Stribeck curves against separate solutions, and the limits of motion and load."""

import numpy as np
import pytest

import softlube
from softlube import Rig, stribeck_curve

RIG = Rig(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s")
RANGE = {"slowest": "50 um/s", "fastest": "5 mm/s"}


@pytest.fixture(scope="module")
def sliding():
    return stribeck_curve(RIG, ["50 mN", "100 mN"], **RANGE, points=9, roughness="50 nm", region="domain")


@pytest.mark.parametrize("row", [2, 13])
def test_ratio_two_with_the_substrate_at_rest_is_the_paper_s_case(sliding, row):
    """Against a contact solved by itself, at a β that is no node of the curve."""
    values = sliding.iloc[row]
    solution = softlube.Contact(
        radius="2 mm",
        young_modulus="3 MPa",
        viscosity="2 Pa s",
        speed=2 * values["entrainment_speed [m/s]"],
        load=values["load [N]"],
    ).solve()
    for column, name in (("friction [N]", "friction_total"), ("film_center [m]", "film_center"), ("film_min [m]", "film_min")):
        exact = solution.dimensional[name]
        error = values[column.replace(" [", "_error [")]
        assert abs(values[column] - exact) <= error + exact.error, name
        assert values[column] == pytest.approx(exact, rel=5e-3 if name == "film_min" else 1e-3)
        assert error < 0.02 * exact
    assert values["friction_coefficient"] == pytest.approx(values["friction [N]"] / values["load [N]"])
    assert values["lambda_ratio"] == pytest.approx(values["film_min [m]"] / 50e-9)


def test_the_film_does_not_depend_on_which_surface_moves_and_the_couette_part_goes_with_the_ratio():
    columns = ["film_center [m]", "film_min [m]", "beta_load"]
    tables = {
        s: stribeck_curve(RIG, "100 mN", **RANGE, points=5, slide_to_roll=s, force="couette") for s in (2.0, 0.5, 0.0, -2.0)
    }
    for s, table in tables.items():
        np.testing.assert_array_equal(table[columns], tables[2.0][columns])
        np.testing.assert_allclose(table["friction [N]"], s / 2 * tables[2.0]["friction [N]"], rtol=1e-12)


def test_pure_rolling_has_no_couette_friction():
    rolling = {
        f: stribeck_curve(RIG, "100 mN", **RANGE, points=5, slide_to_roll=0.0, force=f) for f in ("couette", "sphere", "total")
    }
    assert (rolling["couette"]["friction [N]"] == 0).all()
    # What is left is the rolling part, equal and opposite on the two surfaces.
    np.testing.assert_allclose(rolling["sphere"]["friction [N]"], -rolling["total"]["friction [N]"], rtol=1e-12)
    assert (rolling["total"]["friction [N]"] > 0).all()


def test_regimes_by_roughness(sliding):
    ratio = sliding["lambda_ratio"]
    assert set(sliding["lubrication"]) == {"mixed", "full film"}
    assert (ratio[sliding["lubrication"] == "full film"] >= 3).all()
    assert (ratio[sliding["lubrication"] == "mixed"] < 3).all()


def test_slopes_in_the_hertz_regime():
    """Between the limits of section 5 of the model and the paper's fits: film U^0.58…0.6, friction U^0.40…0.44."""
    sphere = stribeck_curve(RIG, "100 mN", **RANGE, points=9, force="sphere")
    rows = sphere[sphere["beta_load"] > 1000]
    speed = np.log(rows["entrainment_speed [m/s]"])
    film = np.polyfit(speed, np.log(rows["film_center [m]"]), 1)[0]
    friction = np.polyfit(speed, np.log(rows["friction [N]"]), 1)[0]
    assert 0.575 < film < 0.6
    assert 0.39 < friction < 0.45


def test_loads_collapse_on_beta(sliding):
    """Friction over (2π/3) G δ² depends on β alone: the two loads give one curve."""
    normalised = sliding["friction [N]"] / sliding["load [N]"] ** (4 / 3)
    first, second = (sliding["load [N]"] == load for load in (0.05, 0.1))
    at = np.log(sliding["beta_load"][second])
    low = at < np.log(sliding["beta_load"][first]).max()
    interpolated = np.interp(at[low], np.log(sliding["beta_load"][first])[::-1], np.log(normalised[first])[::-1])
    np.testing.assert_allclose(interpolated, np.log(normalised[second][low]), atol=0.01)


def test_what_cannot_be_solved_is_nan():
    table = stribeck_curve(RIG, "100 mN", slowest="1 mm/s", fastest="10 m/s", points=5)
    assert np.isfinite(table["friction [N]"].iloc[0])
    beyond = table["beta_load"] < 1e-4 if table["film_min [m]"].notna().all() else table["film_min [m]"].isna()
    assert table["friction [N]"].isna().equals(beyond)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"loads": []}, "load: missing"),
        ({"loads": "100 m"}, "load: 100 m has the wrong dimension"),
        ({"slowest": "5 mm"}, "entrainment_speed: 5 mm has the wrong dimension"),
        ({"slowest": "1 m/s", "fastest": "1 mm/s"}, "slowest, fastest: expected a slower and a faster"),
        ({"points": 1}, "points: expected"),
        ({"slide_to_roll": float("nan")}, "slide_to_roll: expected"),
        ({"force": "drag"}, "force: expected one of"),
        ({"region": "everywhere"}, "region: expected"),
        ({"region": -1.0}, "region: expected"),
        ({"roughness": "0 nm"}, "roughness: expected"),
    ],
)
def test_bad_input(options, message):
    with pytest.raises(softlube.InputError, match=message):
        stribeck_curve(RIG, **{"loads": "100 mN"} | options)


def test_a_contact_brings_its_motion_and_roughness():
    bodies = {"radius": "2 mm", "young_modulus": "3 MPa", "viscosity": "2 Pa s", "load": "100 mN", "roughness": "50 nm"}
    rolling = softlube.Contact(**bodies, motion=softlube.Rolling("1 mm/s", slide_to_roll=0.5))
    table = stribeck_curve(rolling, **RANGE, points=3)
    assert (table["slide_to_roll"] == 0.5).all()
    assert table["lambda_ratio"].to_numpy() == pytest.approx(table["film_min [m]"].to_numpy() / 50e-9)
    same = stribeck_curve(RIG, "100 mN", **RANGE, points=3, slide_to_roll=0.5)
    assert table["friction [N]"].to_numpy() == pytest.approx(same["friction [N]"].to_numpy(), rel=1e-9)
    with pytest.raises(softlube.InputError, match="load: missing"):
        stribeck_curve(softlube.Contact(**bodies | {"load": None, "indentation": "1 um"}, speed=1.0), **RANGE)


def test_a_curve_shows_some_of_its_rows(sliding):
    assert len(sliding._repr_html_().encode()) < 4000
    summary = sliding.summary()
    assert summary.title == "Stribeck curve: 18 rows, 2 loads, 0.05 to 5 mm/s"
    assert [row[0] for row in summary.rows] == ["50"] * 6 + ["100"] * 6
    assert float(summary.rows[-1][1]) == 5
    assert type(sliding.to_dataframe()) is type(sliding[sliding["load [N]"] < 0.07])
    assert sliding.to_dataframe().equals(sliding)


@pytest.mark.parametrize("slide_to_roll", [2.0, 0.5])
def test_a_liquid_that_thins_with_shear(slide_to_roll):
    """Film and friction of the curve are those of contacts with its slide-to-roll ratio."""
    rig = {"radius": "2 mm", "young_modulus": "3 MPa", "load": "50 mN"}
    liquid = softlube.Carreau("0.5 Pa s", infinite_viscosity="10 mPa s", relaxation_time="1 ms", index=0.6)
    contact = softlube.Contact(**rig, liquid=liquid, motion=softlube.Rolling("1 mm/s", slide_to_roll=slide_to_roll))
    row = softlube.stribeck_curve(contact, slowest="0.5 mm/s", fastest="2 mm/s", points=3).iloc[1]
    assert row["entrainment_speed [m/s]"] == pytest.approx(1e-3)
    assert row["slide_to_roll"] == slide_to_roll
    solved = contact.solve().dimensional
    for column, name in (("film_center [m]", "film_center"), ("film_min [m]", "film_min"), ("friction [N]", "friction_total")):
        assert row[column] == pytest.approx(solved[name], rel=5e-3)


@pytest.mark.slow
def test_two_plateaus_over_four_decades_of_speed():
    """A Carreau liquid between its plateaus from 0.1 to 1000 mm/s: the curve against contacts, and between both plateaus'."""
    rig = {"radius": "9.5 mm", "young_modulus": "2.4 MPa"}
    liquid = softlube.Carreau("0.1 Pa s", infinite_viscosity="2 mPa s", relaxation_time="1 ms", index=0.4)
    contact = softlube.Contact(**rig, load="1 N", liquid=liquid, motion=softlube.Sliding("1 mm/s"))
    table = softlube.stribeck_curve(contact, slowest="0.1 mm/s", fastest="1 m/s", points=9)
    assert table["friction [N]"].notna().all()
    columns = {"film_center [m]": "film_center", "friction [N]": "friction_total"}
    for row in (0, 4, 8):
        speed = 2 * table["entrainment_speed [m/s]"][row]
        solved = softlube.Contact(**rig, load="1 N", liquid=liquid, motion=softlube.Sliding(speed)).solve().dimensional
        for column, name in columns.items():
            assert table[column][row] == pytest.approx(solved[name], rel=5e-3)
    for viscosity, sign in (("0.1 Pa s", -1), ("2 mPa s", 1)):
        plateau = softlube.stribeck_curve(
            softlube.Rig(**rig, viscosity=viscosity), "1 N", slowest="0.1 mm/s", fastest="1 m/s", points=9
        )
        for column in columns:
            assert np.all(sign * (table[column] - plateau[column]) > 0)


@pytest.mark.slow
@pytest.mark.parametrize("slide_to_roll", [2.0, 0.0])
def test_a_substrate_that_remembers_passes_as_fast_as_the_contact(slide_to_roll):
    """Each row is the contact solved at its speed, whose Deborah number is its own; the parts add."""
    contact = softlube.Contact(
        radius="2 mm",
        young_modulus="3 MPa",
        stiffening=2,
        substrate_relaxation_time="0.1 s",
        viscosity="2 Pa s",
        load="100 mN",
        entrainment_speed="1 mm/s",
        slide_to_roll=slide_to_roll,
    )
    table = stribeck_curve(contact, slowest="1 mm/s", fastest="4 mm/s", points=3, accuracy=1e-2)
    row = table.iloc[1]
    motion = softlube.Rolling(row["entrainment_speed [m/s]"], slide_to_roll=slide_to_roll)
    direct = softlube.Contact(**vars(contact) | {"motion": motion}).solve(accuracy=1e-2).dimensional
    for name in ("viscous", "hysteresis"):
        assert row[f"friction_{name} [N]"] == pytest.approx(direct[f"friction_{name}"], rel=1e-2)
    assert row["friction [N]"] == pytest.approx(row["friction_viscous [N]"] + row["friction_hysteresis [N]"])
    assert row["friction [N]"] == pytest.approx(direct["friction_total"], rel=1e-2)
