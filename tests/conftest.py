"""Shared by all tests: NumPy raises where it would return nonsense, and one solution for many readers."""

from __future__ import annotations

import shutil

import numpy as np
import pytest

import softlube
from softlube.files.cache import VARIABLE
from softlube.model.exact import HERTZ_LOAD
from softlube.transient.motion import constant_load
from softlube.transient.sliding.result import follow_sliding
from softlube.transient.squeeze.result import follow


@pytest.fixture(autouse=True)
def _numpy_raises():
    with np.errstate(invalid="raise", divide="raise", over="raise"):
        yield


@pytest.fixture(scope="module")
def browser():
    """Debian's Chromium, driven by playwright; without one its tests are skipped."""
    chromium = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if chromium is None:
        pytest.skip("no chromium on this machine (apt-get install chromium)")
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed (pip install '.[test]')")
    with sync_api.sync_playwright() as playwright:
        launched = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        yield launched
        launched.close()


@pytest.fixture(scope="session", autouse=True)
def _own_cache(tmp_path_factory):
    """No test reads or writes the user's cache, and neither do the processes that it starts."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(VARIABLE, str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(scope="session")
def solution() -> softlube.Solution:
    """β = 1000 at the default accuracy."""
    return softlube.solve(beta=1000)


@pytest.fixture(scope="session")
def contact() -> softlube.Contact:
    """The README's ball on rubber."""
    return softlube.Contact(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", speed="0.1 mm/s", load="100 mN")


@pytest.fixture(scope="session")
def physical(contact) -> softlube.Solution:
    """The README's example, solved."""
    return contact.solve()


@pytest.fixture(scope="session")
def squeezed() -> softlube.Squeeze:
    """A normalised squeeze film: the load of the Hertz contact from a height of 2 on."""
    return follow(constant_load(HERTZ_LOAD, 2.0, 3e3))


@pytest.fixture(scope="session")
def slid() -> softlube.Slide:
    """A normalised start of sliding: the load of the Hertz contact from a height of 1 on, β = 100."""
    return follow_sliding(constant_load(HERTZ_LOAD, 1.0, 100.0), beta=100.0, accuracy=0.1)


@pytest.fixture(scope="session")
def fall() -> softlube.Squeeze:
    """A squeeze film in SI."""
    return softlube.squeeze(
        radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", load="100 mN", initial_height="100 um", duration="0.1 s"
    )


@pytest.fixture(scope="session")
def started() -> softlube.Slide:
    """A start of sliding in SI, until the sliding is steady."""
    return softlube.slide(
        radius="2 mm",
        young_modulus="3 MPa",
        viscosity="2 Pa s",
        load="100 mN",
        speed="20 mm/s",
        initial_height="100 um",
        duration="0.2 s",
        accuracy=0.05,
    )
