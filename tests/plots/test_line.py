"""Pictures of line contacts."""

import pytest

from softlube import LineContact, line


def labels(figure):
    return [axes.get_ylabel() for axes in figure.axes]


def test_dimensionless():
    figure = line.solve(100.0).plot()
    assert labels(figure) == ["film / (b²/R)", "pressure / (4πG b/R)"]
    low, high = figure.axes[0].get_xlim()
    assert low < -1.1 < 1.5 < high
    film, pressure = (axes.lines[0].get_ydata() for axes in figure.axes)
    assert film.min() > 0
    assert pressure.max() == pytest.approx(0.153, abs=0.001)


def test_in_si_and_without_cavitation(tmp_path):
    contact = LineContact(
        radius="10 mm",
        young_modulus="3 MPa",
        viscosity="1 Pa s",
        speed="10 mm/s",
        load_per_length="1 N/mm",
        cavitation="none",
    )
    path = tmp_path / "line.png"
    figure = contact.solve().plot(path)
    assert path.read_bytes().startswith(b"\x89PNG")
    assert labels(figure)[1] == "pressure [kPa]"
    assert figure.axes[1].lines[0].get_ydata().min() < 0
