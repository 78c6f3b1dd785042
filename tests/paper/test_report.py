"""The report: one page, with everything in it and nothing that was not meant."""

import struct
import zlib

import pytest

import softlube
from softlube.paper.figures import Statement
from softlube.paper.report import Law, Section, law_table, write_report


@pytest.fixture
def picture(tmp_path):
    """A PNG file of one pixel."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    path = tmp_path / "figure-5.png"
    header = struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"\0\0")) + chunk(b"IEND", b"")
    )
    return path


def test_text_is_escaped_and_verdicts_are_counted(tmp_path, picture):
    statements = (
        Statement("u < 1 & p > 0", "1.00", "1.01", "−1 %"),
        Statement("no effect", "2 %", "0", "+2 %", "disagrees", "It has <some>."),
        Statement("more", "3", verdict="more"),
    )
    section = Section("5", "Figure 5. Pressure", 'Along "x"', picture, ("figure-5-a.csv",), statements)
    path = tmp_path / "report.html"
    write_report(path, [section], [], 3, 12.3)
    page = path.read_text(encoding="utf-8")
    assert "u &lt; 1 &amp; p &gt; 0" in page
    assert "It has &lt;some&gt;." in page
    assert "<some>" not in page
    assert "1 statements and numbers agree and 1 differ" in page
    assert "3 contacts solved and 1 figures drawn in 12 s" in page
    assert '<a href="data/figure-5-a.csv">data/figure-5-a.csv</a>' in page
    assert '<a href="figures/figure-5.png">' in page
    assert '<a href="figures/figure-5.pdf">' in page
    assert 'id="laws"' not in page
    assert sorted(p.name for p in tmp_path.iterdir()) == ["figure-5.png", "report.html"]


def test_powers_are_set_as_mathematics(tmp_path, picture):
    statements = (Statement("u follows β^(−3/5) < 1", "9 β^(−0.58)", "8·10^-4 N", remark="G δ^2"),)
    write_report(tmp_path / "report.html", [Section("6", "Film", "times β^(3/5)", picture, (), statements)], [], 1, 1.0)
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    for text in (
        "β<sup>−3/5</sup> &lt; 1",
        "9 β<sup>−0.58</sup>",
        "8·10<sup>-4</sup> N",
        "G δ<sup>2</sup>",
        "times β<sup>3/5</sup>",
    ):
        assert text in page
    assert "^" not in page.replace('alt="times β^(3/5)"', "")


def test_laws_of_the_report(tmp_path, picture):
    law = Law("22a", "film", 0.9, -0.58, 0.93, -0.587, -0.588, -0.586, 0.985, 1e4, -0.583, -0.59, -0.6)
    none = Law("21", "layer", 4.2, -0.51, 5.8, -0.555, -0.57, -0.54, 0.84, 1e4, -0.49, -0.64, None)
    path = tmp_path / "report.html"
    write_report(path, [], [law, none], 1, 1.0)
    page = path.read_text(encoding="utf-8")
    assert "−0.0070" in page  # the difference of the exponents, with a true minus sign
    assert "no power" in page


def test_law_table_is_made_of_solutions():
    solutions = [softlube.solve(beta=beta, accuracy=0.02) for beta in (30.0, 100.0, 1000.0, 1e4)]
    laws = {law.equation: law for law in law_table(solutions)}
    assert set(laws) == {"20", "21", "22a", "22b", "28"}
    film = laws["22a"]
    assert film.paper_exponent == -0.5826
    assert film.exponent_low < film.exponent < film.exponent_high
    assert film.local_exponent_high < film.local_exponent_low < film.paper_exponent + 0.01
    assert film.limit_exponent == -0.6
    assert laws["21"].limit_exponent is None
