"""A liquid that the package has never heard of: one class for its law, one for its part, and it is everywhere."""

import json
import subprocess
import sys
import textwrap
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest
import xarray as xr

import softlube
from softlube.cli.main import main
from softlube.model import inputs, parts
from softlube.model.inputs import INVERSE_PRESSURE, given
from softlube.model.liquids import Law, LiquidPart
from softlube.sweeps.plan import make_plan

BALL = {"radius": "2 mm", "young_modulus": "3 MPa", "speed": "0.1 mm/s", "load": "100 mN"}
OPTIONS = [word for name, value in BALL.items() for word in (f"--{name.replace('_', '-')}", value)]


@pytest.fixture
def syrup(monkeypatch):
    """Defines the liquid η = η₀ (1 + sp), and forgets it afterwards."""
    monkeypatch.setattr(Law, "kinds", dict(Law.kinds))
    monkeypatch.setattr(parts.Part, "slots", {slot: dict(kinds) for slot, kinds in parts.Part.slots.items()})
    monkeypatch.setattr(inputs, "_DECLARED", dict(inputs.declared()))

    @dataclass(frozen=True)
    class SyrupLaw(Law):
        slope: float
        kind: ClassVar[str] = "syrup"

        def in_units(self, unit):
            return replace(self, slope=self.slope * np.sqrt(unit))

        def viscosity(self, pressure):
            return 1 + self.slope * np.maximum(pressure, 0)

        def fluidity(self, pressure):
            value = 1 / self.viscosity(pressure)
            return value, np.where(pressure > 0, -self.slope * value**2, 0.0)

        def reduced_pressure(self, pressure):
            return np.where(pressure > 0, np.log(self.viscosity(pressure)) / self.slope, pressure)

        def weakened(self, share):
            return replace(self, slope=self.slope * max(share, 1e-9))

    class Syrup(LiquidPart):
        """A liquid that stiffens in proportion to the pressure."""

        kind: ClassVar[str] = "syrup"
        hardening: float = given("Rise of the viscosity over it and the pressure", INVERSE_PRESSURE, "1 MPa^-1")

        def law(self, pressure_unit):
            return SyrupLaw(self.hardening * pressure_unit)

    yield Syrup
    parts._words_of.cache_clear()


def test_the_help_has_its_option(syrup, capsys):
    for command in ("solve", "squeeze", "flow"):
        assert main([command, "--help"]) == 0
        out = " ".join(capsys.readouterr().out.replace("│", " ").split())
        assert '--hardening STR Rise of the viscosity over it and the pressure, such as "1 MPa^-1".' in out
        assert '"roelands" or "syrup"' in out


def test_both_spellings_from_python(syrup):
    flat = softlube.Contact(**BALL, viscosity="2 Pa s", hardening="10 MPa^-1")
    whole = softlube.Contact(**BALL, liquid=syrup("2 Pa s", hardening="10 MPa^-1"))
    assert flat == whole
    assert flat.inputs() == whole.inputs()
    assert (flat.hardening, flat.viscosity_law, flat.pressure_viscosity) == (pytest.approx(1e-5), "syrup", None)
    with pytest.raises(softlube.InputError, match="pressure_viscosity, hardening: no liquid has both"):
        softlube.Contact(**BALL, viscosity=2.0, pressure_viscosity=1e-8, hardening=1e-6)
    with pytest.raises(softlube.InputError, match="hardening: 10 MPa has the wrong dimension; expected an inverse pressure"):
        softlube.Contact(**BALL, viscosity=2.0, hardening="10 MPa")
    with pytest.raises(softlube.InputError, match="viscosity_law, hardening: the first means nothing without the second"):
        softlube.Contact(**BALL, viscosity=2.0, viscosity_law="syrup")


def test_the_command_solves_it_and_its_file_loads(syrup, capsys, tmp_path):
    path = tmp_path / "a.nc"
    options = [*OPTIONS, "--viscosity", "2 Pa s", "--hardening", "10 MPa^-1", "--accuracy", "0.01", "--output", str(path)]
    assert main(["solve", *options, "--json"]) == 0
    film = json.loads(capsys.readouterr().out)["dimensional"]["film_center"]["value"]
    again = softlube.load(path)
    assert again.contact.liquid == syrup(2.0, hardening="10 MPa^-1")
    assert again.problem.liquid.slope == pytest.approx(1e-5 * again.contact.scales(again.contact.unit_height)["pressure"][0])
    assert again.dimensional["film_center"] == film
    thin = softlube.Contact(**BALL, viscosity="2 Pa s").solve(accuracy=0.01)
    assert film > 1.02 * thin.dimensional["film_center"]
    with xr.open_dataset(path) as data:
        assert json.loads(data.attrs["inputs_SI"])["hardening"] == pytest.approx(1e-5)


def test_a_plan_varies_it(syrup, tmp_path):
    given = BALL | {"viscosity": "2 Pa s", "hardening": {"from": "1 MPa^-1", "to": "10 MPa^-1", "count": 2}}
    assert [case.contact.hardening for case in make_plan(given).cases] == pytest.approx([1e-6, 1e-5])
    table = softlube.sweep(given, accuracy=0.01, workers=1).table
    assert list(table["status"]) == ["done", "done"], list(table["reason"])
    assert list(table["hardening [1/Pa]"]) == pytest.approx([1e-6, 1e-5])
    assert table["film_center [m]"].is_monotonic_increasing
    (tmp_path / "cases.csv").write_text("hardening [1/MPa]\n1\n2\n")
    column = make_plan(given | {"hardening": {"csv": "cases.csv"}}, folder=tmp_path)
    assert [case.contact.hardening for case in column.cases] == pytest.approx([1e-6, 2e-6])


def test_a_plan_of_squeeze_films_has_it(syrup):
    press = BALL | {"viscosity": "2 Pa s", "initial_height": "100 um", "duration": "20 ms", "hardening": "100 MPa^-1"}
    del press["speed"]
    table = softlube.sweep(press, motion="squeeze", accuracy=0.02, workers=1).table
    assert list(table["status"]) == ["done"], list(table["reason"])
    own = softlube.squeeze(**press, accuracy=0.02).final["film_center"]
    assert table["film_center [m]"][0] == pytest.approx(float(own), rel=1e-7)


def test_commands_without_liquids_refuse_it_with_the_reason(syrup, capsys):
    assert main(["reproduce", "--hardening", "1 MPa^-1"]) == 2
    assert "--hardening: softlube reproduce does not take it, the paper's figures are" in capsys.readouterr().err


def test_where_it_is_unknown_its_file_is_refused_with_a_message(syrup, tmp_path):
    contact = softlube.Contact(**BALL, viscosity="2 Pa s", hardening="1 MPa^-1")
    contact.solve(accuracy=0.05).save(tmp_path / "a.nc")
    code = """
        import softlube
        try:
            softlube.load("a.nc")
        except softlube.InputError as error:
            print(error)
    """
    run = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert (
        "path: 'a.nc', problem: holds what this version of softlube does not know (liquid: no law 'syrup' is known"
        in run.stdout
    )
