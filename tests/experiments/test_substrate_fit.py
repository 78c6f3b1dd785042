"""Substrates from tests of their material: the series, what is printed, and what the data cannot tell."""

import json

import numpy as np
import pytest

import softlube
from softlube.errors import InputError
from softlube.experiments.moduli import Moduli
from softlube.experiments.substrate_fit import fit_substrate
from softlube.model.creep import creep_of

RELAXED, TERMS = 3e6, ((4e6, 2e-3), (1e6, 0.1))


def oscillation(noise=0.01, rows=31, shear=False, low=1e-2, high=1e5, terms=TERMS):
    frequency, random = np.geomspace(low, high, rows), np.random.default_rng(3)
    modulus = RELAXED + sum(weight * 1j * frequency * time / (1 + 1j * frequency * time) for weight, time in terms)
    storage, loss = (part * np.exp(noise * random.standard_normal(rows)) for part in (modulus.real, modulus.imag))
    return Moduli.from_arrays(frequency=frequency, storage_modulus=storage, loss_modulus=loss, shear=shear)


def stepped(response, low=1e-4, high=1e3, rows=41, **kind):
    time = np.geomspace(low, high, rows)
    return Moduli.from_arrays(time=time, **{name: response(time) for name in kind})


def test_what_is_printed_is_one_substrate():
    found = fit_substrate(oscillation())
    assert eval(found.python, {"softlube": softlube}) == found.substrate
    assert found.substrate.young_modulus == pytest.approx(RELAXED, rel=0.02)
    assert found.options.startswith('--young-modulus "')
    assert '--prony "' in found.options
    assert "poisson" not in found.options
    drained = fit_substrate(oscillation(), poisson_ratio=0.3)
    assert drained.options.endswith('--poisson-ratio "0.3"')
    assert eval(drained.python, {"softlube": softlube}) == drained.substrate


def test_shear_moduli_make_a_substrate_of_shear_moduli():
    found = fit_substrate(oscillation(noise=0.0, shear=True))
    assert found.substrate.shear_modulus == pytest.approx(RELAXED)
    assert [term for each in found.substrate.terms for term in each] == pytest.approx([x for term in TERMS for x in term])
    assert found.options.startswith('--shear-modulus "3 MPa"')


def test_three_tests_of_one_material_give_one_substrate():
    """Its moduli against frequency, its relaxation modulus and its creep compliance, which is converted exactly."""
    creep = creep_of(RELAXED, TERMS)

    def compliance(time):
        return creep.instantaneous + sum(each.weight * -np.expm1(-time / each.time) for each in creep.terms)

    def relaxing(time):
        return RELAXED + sum(weight * np.exp(-time / each) for weight, each in TERMS)

    for data in (
        oscillation(noise=0.0),
        stepped(relaxing, relaxation_modulus=True),
        stepped(compliance, creep_compliance=True),
    ):
        found = fit_substrate(data)
        assert found.relaxed == pytest.approx(RELAXED, rel=1e-6)
        assert [x for term in found.terms for x in term] == pytest.approx([x for term in TERMS for x in term], rel=1e-6)
        assert found.instantaneous == pytest.approx(8e6, rel=1e-6)
        assert found.creep.relaxed == pytest.approx(1 / RELAXED, rel=1e-6)


def test_modulus_is_that_of_the_data():
    data = oscillation(noise=0.0)
    found = fit_substrate(data)
    modulus = found.complex_modulus(data.where)
    np.testing.assert_allclose(modulus.real, data.values["storage_modulus"], rtol=1e-8)
    np.testing.assert_allclose(modulus.imag, data.values["loss_modulus"], rtol=1e-8)
    np.testing.assert_allclose(found.predicted(data.where)["loss_modulus"], data.values["loss_modulus"], rtol=1e-8)


def test_what_lies_outside_is_told():
    said = " ".join(fit_substrate(oscillation()).verdicts)
    assert "The data span 0.01 to 1e+05 rad/s, 7.0 decades" in said
    assert "Largest misfit" in said
    assert "outside" not in said
    assert "guess." in said.split("Scatter")[0]
    assert said.count("guess") == 1
    # The slow time ends beyond the slowest rate, the fast one beyond the fastest.
    narrow = " ".join(fit_substrate(oscillation(noise=0.001, low=3.0, high=300)).verdicts)
    assert "are outside" in narrow
    assert "the instantaneous modulus" in narrow


def test_number_of_terms_may_be_asked_for():
    assert len(fit_substrate(oscillation(), terms=1).terms) == 1
    found = fit_substrate(oscillation(terms=((4e6, 2e-3), (1e6, 0.1), (1e6, 4.0))), terms=2)
    assert len(found.terms) == 2
    assert any("ordered along frequency" in each for each in found.verdicts)


def test_objects_show_themselves():
    found = fit_substrate(oscillation())
    assert repr(found).startswith("<SubstrateFit: 2 times, E from ")
    assert "instantaneous" in str(found.summary())
    assert list(found.to_dataframe()) == ["modulus [Pa]", "time [s]"]
    plain = json.loads(json.dumps(found.to_dict(), allow_nan=False))
    assert plain["terms"][0] == {"modulus": found.terms[0].weight, "time": found.terms[0].time}
    assert plain["range"] == pytest.approx([1e-2, 1e5])
    assert plain["numbers_of_times"][-1]["times"] == 0
    size, column, row = found.largest
    assert size == pytest.approx(abs(found.series.residuals[column][row]))
    assert plain["largest_misfit"] == {"size": size, "column": column, "line": row + 1}


@pytest.mark.parametrize(
    ("data", "arguments", "fragment"),
    [
        (oscillation(rows=4), {}, "4 rows"),
        (oscillation(low=1, high=5), {}, "a factor of 5 in frequency tell no series"),
        (oscillation(), {"terms": 40}, "terms: the data take"),
        (oscillation(), {"terms": 0}, "terms: expected a whole number"),
        (oscillation(), {"poisson_ratio": 0.7}, "poisson_ratio"),
        (stepped(lambda t: 1e6 + 0 * t, relaxation_modulus=True), {}, "show no memory"),
        (stepped(lambda t: 1e6 * np.exp(-t / 300), relaxation_modulus=True), {}, "do not tell the relaxed modulus"),
        (stepped(lambda t: 1e-6 * (1 + t), creep_compliance=True), {}, "do not tell the compliance"),
        (stepped(lambda t: -1e-6 * np.expm1(-t), creep_compliance=True), {}, "do not tell the compliance"),
    ],
)
def test_refusals(data, arguments, fragment):
    with pytest.raises(InputError) as error:
        fit_substrate(data, **arguments)
    assert fragment in str(error.value)


def test_a_file_is_read(tmp_path):
    path = tmp_path / "moduli.csv"
    data = oscillation()
    rows = zip(data.where, *data.values.values(), strict=True)
    path.write_text("frequency [rad/s], E' [Pa], E'' [Pa]\n" + "".join(f"{w:.8e}, {s:.8e}, {x:.8e}\n" for w, s, x in rows))
    assert fit_substrate(path).relaxed == pytest.approx(fit_substrate(data).relaxed, rel=1e-6)
