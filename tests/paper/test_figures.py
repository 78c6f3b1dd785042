"""The paper's figures: every one drawn, legible, labelled, with the data that it shows."""

import csv

import pytest

from softlube.paper.figures import FIGURES
from softlube.paper.figures.base import beta_text

PIXEL = 1.0


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


def test_keys_are_the_paper_s():
    assert [key for key in FIGURES if key.isdigit()] == [str(n) for n in range(5, 14)]
    assert {"S1", "S2", "S3"} <= set(FIGURES)
    assert beta_text(300.0) == r"$\beta$ = 300"
    assert beta_text(3e4) == r"$\beta = 3\times10^4$"
