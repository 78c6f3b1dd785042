"""Every page of the built site in a browser: it fits a screen and a telephone, is quiet, and its links lead somewhere.

Built by ``sphinx-build -W --keep-going -b html docs site``; tested by ``SOFTLUBE_SITE=site pytest tests/docs/test_site.py``.
"""

import os
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote, urldefrag, urlparse

import pytest

WIDTHS = (1280, 390)
"""Pixels: a screen, a telephone."""

pytestmark = pytest.mark.skipif("SOFTLUBE_SITE" not in os.environ, reason="SOFTLUBE_SITE names no folder with the built site")


@dataclass
class Visit:
    """What a page does in the browser."""

    excess: dict[int, int]
    """Pixels by which it is too wide, by the width of the window."""
    complaints: list[str]
    broken_images: list[str]
    links: list[str]
    anchors: set[str]


@pytest.fixture(scope="module")
def site():
    return Path(os.environ["SOFTLUBE_SITE"]).resolve()


@pytest.fixture(scope="module")
def visits(site, browser):
    """All pages, each opened once."""
    seen: dict[str, Visit] = {}
    page = browser.new_context(offline=True).new_page()
    complaints: list[str] = []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("requestfailed", lambda request: complaints.append(f"not loaded: {request.url}"))
    for path in sorted(site.rglob("*.html")):
        page.goto(path.as_uri())
        visit = Visit(
            excess={},
            complaints=complaints.copy(),
            broken_images=page.evaluate(
                "[...document.images].filter(i => i.loading != 'lazy' && !i.naturalWidth).map(i => i.src)"
            ),
            links=page.evaluate("[...document.querySelectorAll('a[href]')].map(a => a.href)"),
            anchors=set(page.evaluate("[...document.querySelectorAll('[id]')].map(e => e.id)")),
        )
        for width in WIDTHS:
            page.set_viewport_size({"width": width, "height": 900})
            visit.excess[width] = page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
        complaints.clear()
        seen[path.as_uri()] = visit
    return seen


def test_the_site_has_its_sections(visits):
    for page in ("index", "start/five-minutes", "tutorials/first_contact", "reference/api/softlube.Contact"):
        assert any(url.endswith(f"/{page}.html") for url in visits), page


@pytest.mark.parametrize("width", WIDTHS)
def test_pages_are_not_wider_than_the_window(visits, width):
    assert {url: visit.excess[width] for url, visit in visits.items() if visit.excess[width] > 0} == {}


def test_pages_say_nothing_on_the_console(visits):
    assert {url: visit.complaints for url, visit in visits.items() if visit.complaints} == {}


def test_pictures_are_there(visits):
    assert {url: visit.broken_images for url, visit in visits.items() if visit.broken_images} == {}


def test_search_finds_pages_without_a_server(site, browser):
    page = browser.new_context(offline=True).new_page()
    said = []
    page.on("console", lambda message: said.append(message.text))
    page.goto(f"{(site / 'search.html').as_uri()}?q=starvation")
    page.locator("#search-results li a").first.wait_for()
    assert any("What softlube does not model" in text for text in page.locator("#search-results li a").all_inner_texts())
    assert said == []


def test_links_lead_somewhere(visits):
    dead = []
    for url, visit in visits.items():
        for link in visit.links:
            target, anchor = urldefrag(link)
            parts = urlparse(target)
            if parts.scheme != "file":
                assert parts.scheme in ("https", "http"), link
            elif target in visits:
                if anchor and unquote(anchor) not in visits[target].anchors:
                    dead.append(f"{url} -> {link}")
            elif not Path(unquote(parts.path)).is_file():
                dead.append(f"{url} -> {link}")
    assert dead == []
