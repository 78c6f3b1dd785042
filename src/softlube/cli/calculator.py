"""``softlube calculator``: a page that computes contacts in a browser.  Heavy imports live inside."""

from __future__ import annotations

from softlube.errors import printable


def calculator(page: str) -> int:
    """Write a page that computes contacts in any browser, without server or network.

    It has sliders and fields with units for radius, modulus, viscosity, speed and load, and gives film, pressure and friction
    with their errors, as `softlube solve --fast` does, with curves against the speed and profiles along the centre line.

    Parameters
    ----------
    page
        HTML file to write, such as calculator.html.
    """
    from softlube.errors import InputError
    from softlube.files.writing import check_destination, write_whole

    if not page.lower().endswith((".html", ".htm")):
        raise InputError(f"page: expected a file that ends with .html, got {page!r}")
    check_destination("page", page)
    from softlube.plots.calculator.page import page as written

    content = written().encode()
    write_whole({page: content})
    print(f"Wrote {printable(page)} ({len(content) / 1e3:.0f} kB): open it in a browser")
    return 0
