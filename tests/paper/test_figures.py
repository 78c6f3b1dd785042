"""The paper's figures: every one drawn, legible, labelled, with the data that it shows."""

import csv

import numpy as np
import pytest

import softlube
from softlube.model.exact import HERTZ_LOAD
from softlube.paper.figures import FIGURES, Case, Statement, Table
from softlube.paper.figures.base import BALL_ON_RUBBER, PROFILES, WIDE, beta_text
from softlube.paper.figures.measured import read_friction
from softlube.paper.figures.pressure import radial_slope

PIXEL = 1.0


@pytest.fixture(scope="module")
def solutions():
    """Every case of every figure, more coarsely than the command solves them."""
    cases = {case for spec in FIGURES.values() for case in spec.cases}
    return {
        case: softlube.Contact(**BALL_ON_RUBBER).solve(accuracy=0.01)
        if case.physical
        else softlube.solve(case.beta, cavitation=case.cavitation, accuracy=0.02)
        for case in cases
    }


@pytest.fixture(scope="module")
def drawn(solutions):
    """Figures drawn once, when first asked for."""
    pictures = {}

    def get(key):
        if key not in pictures:
            pictures[key] = FIGURES[key].draw({case: solutions[case] for case in FIGURES[key].cases})
        return pictures[key]

    return get


def every_axes(figure):
    """Axes with their insets."""
    found = []
    for ax in figure.axes:
        found += [ax, *[child for child in ax.child_axes if hasattr(child, "xaxis")]]
    return found


def texts(figure):
    """What a reader can read, with its box in pixels."""
    renderer = figure.canvas.get_renderer()
    result = []
    for ax in every_axes(figure):
        items = [ax.title, ax._left_title, ax._right_title, ax.xaxis.label, ax.yaxis.label, *ax.texts]
        for axis in (ax.xaxis, ax.yaxis):
            low, high = sorted(axis.get_view_interval())
            slack = 1e-6 * (high - low)
            for tick in axis.get_major_ticks():
                if low - slack <= tick.get_loc() <= high + slack:
                    items += [label for label in (tick.label1, tick.label2) if label.get_visible()]
        if ax.get_legend() is not None:
            items += ax.get_legend().get_texts()
        result += [(item.get_text(), item.get_window_extent(renderer)) for item in items if item.get_visible()]
    for legend in figure.legends:
        result += [(item.get_text(), item.get_window_extent(renderer)) for item in legend.get_texts()]
    return [(text, box) for text, box in result if text.strip() and box.width > 0]


@pytest.mark.parametrize("key", FIGURES)
def test_nothing_is_clipped_or_overlaps(drawn, key):
    figure = drawn(key).figure
    figure.canvas.draw()
    found = texts(figure)
    width, height = figure.canvas.get_width_height()
    for text, box in found:
        inside = box.x0 > -PIXEL and box.y0 > -PIXEL and box.x1 < width + PIXEL and box.y1 < height + PIXEL
        assert inside, f"{text!r} is cut off: {box}"
    for i, (first, a) in enumerate(found):
        for second, b in found[i + 1 :]:
            across = min(a.x1, b.x1) - max(a.x0, b.x0)
            up = min(a.y1, b.y1) - max(a.y0, b.y0)
            assert across < PIXEL or up < PIXEL, f"{first!r} and {second!r} overlap"


@pytest.mark.parametrize("key", FIGURES)
def test_axes_are_labelled_and_letters_are_legible(drawn, key):
    figure = drawn(key).figure
    assert figure.get_figwidth() in (3.4, 6.9)  # column widths
    for ax in figure.axes:
        if ax.get_label() == "<colorbar>":
            assert ax.get_ylabel() or ax.get_xlabel()
            continue
        shared_x = any(other.get_xlabel() for other in ax.get_shared_x_axes().get_siblings(ax))
        shared_y = any(other.get_ylabel() for other in ax.get_shared_y_axes().get_siblings(ax))
        assert ax.get_xlabel() or shared_x, key
        assert ax.get_ylabel() or shared_y or (key == "S1" and ax in figure.axes[1:3]), key
    for ax in every_axes(figure):
        sizes = [label.get_fontsize() for label in (*ax.get_xticklabels(), *ax.get_yticklabels(), *ax.texts, ax.xaxis.label)]
        assert min(sizes) >= 6


@pytest.mark.parametrize("key", FIGURES)
def test_the_inlet_is_on_the_right(drawn, key):
    """In every picture x grows to the right, and the inlet is at +x."""
    for ax in every_axes(drawn(key).figure):
        low, high = ax.get_xlim()
        assert low < high


@pytest.mark.parametrize("key", FIGURES)
def test_data_behind_each_figure(drawn, tmp_path, key):
    tables = drawn(key).tables
    assert tables
    assert len({table.name for table in tables}) == len(tables)
    for table in tables:
        path = tmp_path / f"{table.name}.csv"
        table.write(path)
        with open(path, newline="", encoding="utf-8") as stream:
            rows = list(csv.reader(stream))
        assert rows[0] == list(table.columns)
        assert len(rows) == 1 + len(next(iter(table.columns.values())))
        cells = [cell for row in rows[1:] for cell in row]
        numbers = [float(cell) for cell in cells if cell and cell.replace("-", "").replace("+", "").replace(".", "").isdigit()]
        assert len(numbers) > len(cells) / 5


@pytest.mark.parametrize("key", [key for key in FIGURES if key != "contact"])
def test_statements_explain_disagreements(drawn, key):
    statements = drawn(key).statements
    assert statements
    for statement in statements:
        assert statement.claim
        assert statement.ours
        assert statement.verdict != "disagrees" or statement.remark.endswith(".")
        assert "nan" not in statement.ours


def test_a_disagreement_without_a_reason_is_refused():
    with pytest.raises(ValueError, match="needs a sentence"):
        Statement("the sky is green", "blue", verdict="disagrees")


def test_keys_are_the_paper_s():
    assert [key for key in FIGURES if key.isdigit()] == [str(n) for n in range(5, 14)]
    assert {"S1", "S2", "S3"} <= set(FIGURES)
    assert beta_text(300.0) == r"$\beta$ = 300"
    assert beta_text(3e4) == r"$\beta = 3\times10^4$"


def test_profiles_are_the_solutions(drawn, solutions):
    (along_x, _) = drawn("5").tables
    beta, x, p = (np.asarray(column, dtype=float) for column in along_x.columns.values())
    assert set(beta) == set(PROFILES)
    for value in PROFILES:
        centre = (beta == value) & (x == 0)
        assert p[centre] == pytest.approx(float(solutions[Case(value)].pressure_center), rel=1e-9)
        # the inlet, with its long tail of pressure, is at x > 0
        assert np.interp(1.2, x[beta == value], p[beta == value]) > 0.001
        assert np.interp(-1.2, x[beta == value], p[beta == value]) < 1e-4
    (film_x, film_y) = drawn("8").tables
    beta, _, u = (np.asarray(column, dtype=float) for column in film_y.columns.values())
    for value in PROFILES:
        assert u[beta == value] == pytest.approx(u[beta == value][::-1], rel=1e-9)
    assert min(film_x.columns["u [|h0|]"]) > 0


def test_outlet_gradient_ends_without_a_jump(solution):
    """It goes to zero at the free boundary, from where it is steepest, in a straight line; and is −dp/dx everywhere before."""
    r = np.linspace(0.9, 1.2, 3001)
    slope = radial_slope(solution, r, np.pi)
    assert np.max(np.abs(np.diff(slope))) < 0.01 * np.max(np.abs(slope))
    assert np.all(slope[r > 1.1] == 0)
    pressure = solution.fields.pressure_at(r, np.pi)
    fallen = np.trapezoid(slope, r)
    assert fallen == pytest.approx(pressure[-1] - pressure[0], rel=0.01)


def test_laws_in_the_tables(drawn, solutions):
    table = drawn("10").tables[0].columns
    ours = [float(solutions[Case(beta)].film_center) for beta in WIDE]
    assert table["(22a) film at the centre"] == pytest.approx(ours)
    assert table["(22a) paper"] == pytest.approx(0.9051 * np.array(WIDE) ** -0.5826)
    load = drawn("12").tables[0].columns["load"]
    assert load[-1] == pytest.approx(HERTZ_LOAD, rel=5e-3)


def test_friction_parts_add_up_in_the_table(drawn):
    table = {name.split(" [")[0]: np.asarray(values) for name, values in drawn("friction").tables[0].columns.items()}
    assert table["sphere"] == pytest.approx(table["couette"] + table["poiseuille"])
    assert table["substrate"] == pytest.approx(table["couette"] - table["poiseuille"])
    assert table["drag"] == pytest.approx(table["sphere"] + table["sphere_pressure"])
    imbalance = drawn("friction").tables[1].columns["horizontal imbalance, whole plane"]
    assert np.max(np.abs(imbalance)) < 2e-4


def test_style_is_left_alone(solutions):
    import matplotlib as mpl

    before = dict(mpl.rcParams)
    FIGURES["10"].draw(solutions)
    assert dict(mpl.rcParams) == before


# --- measured points ------------------------------------------------------------------------------------------------


def test_measured_points_in_both_forms(tmp_path, solutions):
    """A contact solved under a load, as an experimenter would write it down, falls on the theory's curve."""
    solution = softlube.Contact(**BALL_ON_RUBBER).solve(accuracy=0.01)
    force = float(solution.dimensional["friction_domain"])
    physical = tmp_path / "physical.csv"
    physical.write_text(
        "# a comment\nradius [mm],young_modulus [MPa],viscosity [Pa s],speed [mm/s],load [mN],friction [uN],operator\n"
        f"2,3,2,0.1,100,{force * 1e6},A. B.\n",
        encoding="utf-8",
    )
    points = read_friction(physical)
    assert points.beta == pytest.approx(solution.beta_load)
    assert points.friction == pytest.approx(float(solution.friction_domain), rel=1e-6)
    plain = tmp_path / "plain.csv"
    plain.write_text(f"beta,friction\n{points.beta[0]},{points.friction[0]}\n", encoding="utf-8")
    assert read_friction(plain).friction == pytest.approx(points.friction)
    wide = {case: solutions[case] for case in FIGURES["13"].cases}
    drawn = FIGURES["13"].draw(wide, physical)
    table = next(table for table in drawn.tables if table.name == "measured").columns
    assert np.asarray(table["friction"]) == pytest.approx(np.asarray(table["theory r <= 2"]), rel=0.02)
    assert any("measured" in text.get_text() for text in drawn.figure.axes[0].get_legend().get_texts())


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("beta,friction\n", "has no points"),
        ("beta,drag\n1,2\n", "has no column 'radius'"),
        ("beta,friction\n1,-2\n", "point 1, column 'friction': expected a positive, finite number, got '-2'"),
        ("beta,friction\n1,2\nx,2\n", "point 2, column 'beta': expected a number, got 'x'"),
        ("beta,friction\n1\n", "point 1, column 'friction': expected a number, got ''"),
        (
            "radius [mm],young_modulus [MPa],viscosity [Pa s],speed [mm/s],load [kg],friction [mN]\n1,1,1,1,1,1\n",
            "column 'load' has the unit 'kg'",
        ),
        (
            "radius,young_modulus [MPa],viscosity [Pa s],speed [mm/s],load [N],friction [mN]\n1,1,1,1,1,1\n",
            "column 'radius' has the unit ''",
        ),
    ],
)
def test_bad_measurements_are_refused(tmp_path, text, message):
    path = tmp_path / "data.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(softlube.InputError, match=r"^data: ") as error:
        read_friction(path)
    assert message in str(error.value)


def test_missing_measurements_are_refused(tmp_path):
    with pytest.raises(softlube.InputError, match="does not exist"):
        read_friction(tmp_path / "none.csv")


def test_tables_must_be_rectangular(tmp_path):
    with pytest.raises(ValueError, match=r"shorter|longer"):
        Table("odd", {"a": [1.0, 2.0], "b": [1.0]}).write(tmp_path / "odd.csv")
    assert list(tmp_path.iterdir()) == []
