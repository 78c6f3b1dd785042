"""The calculator's page, opened in a real browser without a network."""

import pytest

from softlube.plots.calculator.page import page as written


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    path = tmp_path_factory.mktemp("calculator") / "page.html"
    path.write_text(written(), encoding="utf-8")
    return path.as_uri()


@pytest.fixture
def open_page(browser, address):
    """Open the page in a window of its own; whatever it asks of a network, or complains of, fails the test."""
    said, contexts = [], []

    def opened(fragment="", **options):
        context = browser.new_context(offline=True, **({"viewport": {"width": 1280, "height": 900}} | options))
        contexts.append(context)
        page = context.new_page()
        page.on("request", lambda request: said.append(request.url))
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.goto(address + fragment)
        while not page.evaluate("'softlube' in window"):  # it is painted first, then it computes
            page.wait_for_timeout(20)
        return page

    yield opened
    for context in contexts:
        context.close()
    assert {each.split("#")[0] for each in said} <= {address, "data:,"}
