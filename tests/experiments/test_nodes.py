"""Solved contacts of curves: what is read off them, what is kept of them, and that nothing is lost."""

import json
import os
import random
import signal
import subprocess
import sys
import time
from dataclasses import asdict

import numpy as np
import pytest

import softlube
from softlube.discretization.measure import friction_parts
from softlube.experiments import nodes
from softlube.experiments.nodes import Node, at, content_key, solve_and_keep, solving
from softlube.files.cache import VARIABLE, Cache
from softlube.model.liquids import BarusLaw
from softlube.model.problem import Problem
from softlube.model.substrates import LayerKernel, ViscoelasticKernel
from softlube.steady.solve import solve_problem

ROUGH = 0.03
LAYER = Problem(beta_load=300.0, substrate=LayerKernel(1.7, 0.5, "bonded"), liquid=BarusLaw(0.14))


@pytest.fixture
def cache(monkeypatch, tmp_path):
    monkeypatch.setenv(VARIABLE, str(tmp_path / "cache"))
    return Cache()


@pytest.fixture(scope="module")
def layer():
    return solve_problem(LAYER, accuracy=ROUGH)


@pytest.mark.parametrize("region", [0.5, 1.0, 1.7, 2.0, 5.0, 12.0])
def test_the_friction_within_any_radius(layer, region):
    """Against the integral over the disc itself."""
    node = Node.of(layer)
    edge = softlube.steady.regime.Regime.of(LAYER).edge_radius
    couette, poiseuille = friction_parts(layer.fields, region * edge)
    found = node.friction(region)
    assert found["total"][0] == pytest.approx(couette - poiseuille, rel=1e-4)
    assert found["sphere"][0] == pytest.approx(couette + poiseuille, rel=1e-4)
    assert found["total"][1] == pytest.approx(layer.friction_total.error / layer.friction_total * found["total"][0], rel=1e-9)


def test_a_region_beyond_the_grid_has_no_friction(layer):
    assert np.isnan(Node.of(layer).friction(1e5)["total"][0])


def test_liquid_in_a_spike_that_the_grid_misses_counts_where_the_disc_holds_it():
    node = Node(
        {"friction_total": (5.0, 0.5), "friction_domain": (4.0, 0.4)},
        tuple(np.linspace(0, 4, 9)),
        tuple(np.linspace(0, 4, 9)),
        (0.0,) * 9,
        (0.5, 0.9),
    )
    assert node.friction(0.8)["total"][0] == pytest.approx(0.8)
    assert node.friction(1.0)["sphere"][0] == pytest.approx(1.5)
    assert node.friction(2.0) == {"total": (5.0, 0.5), "sphere": (4.0, 0.4)}
    assert node.friction(3.0)["sphere"][1] == pytest.approx(0.1 * 3.5)


def test_a_node_is_kept_whole(cache, layer):
    node = solve_and_keep((LAYER, ROUGH))
    (path,) = cache.folder.iterdir()
    assert path.stem == content_key(LAYER, ROUGH)
    assert json.loads(path.read_text())["quantities"]["film_min"] == [float(layer.film_min), layer.film_min.error]
    with solving() as solver:
        again = solver.get([LAYER], ROUGH, lambda: None)[LAYER]
    assert asdict(again) == asdict(node)


def test_a_failure_is_kept_with_its_reason(cache, monkeypatch):
    hopeless = Problem(beta_load=100.0, liquid=BarusLaw(500.0))
    node = solve_and_keep((hopeless, ROUGH))
    assert node.reason
    monkeypatch.setattr(nodes, "solve_problem", lambda *_, **__: pytest.fail("solved again"))
    with solving() as solver:
        assert solver.get([hopeless], ROUGH, lambda: None)[hopeless] == node


def test_the_key_is_made_of_all_that_determines_a_node(monkeypatch):
    keys = [
        content_key(LAYER, ROUGH),
        content_key(LAYER, 0.02),
        content_key(at(LAYER, 301.0), ROUGH),
        content_key(Problem(beta_load=300.0), ROUGH),
        content_key(Problem(beta=300.0), ROUGH),
    ]
    assert at(LAYER, 300.0) == LAYER
    monkeypatch.setattr(nodes, "code_version", lambda patterns: "another")
    assert len({*keys, content_key(LAYER, ROUGH)}) == 6


COMPUTE = """
from softlube.experiments.load_curve import load_curve
from softlube.model.problem import Problem
curve = load_curve(Problem(beta_load=1.0), 30, 3e4, region="contact", accuracy=0.03)
print(*curve.friction([47.0, 812.0, 9e3])[0], sep=",")
"""


def computing(**options):
    return subprocess.Popen([sys.executable, "-c", COMPUTE], stdout=subprocess.PIPE, text=True, **options)


def kept(cache):
    """Entries with the file that holds each; one that is written again is another file."""
    return {path.name: path.stat().st_ino for path in cache.folder.glob("[!.]*")} if cache.folder.is_dir() else {}


def kill_and_finish(cache, kills, delay):
    """Kill a computing process again and again, then let one finish; what it prints, and the entries that were there before."""
    before = {}
    for number in range(kills):
        process = computing()
        delay(number, lambda: len(kept(cache)), process)
        os.kill(process.pid, signal.SIGKILL)
        process.communicate()
        now = kept(cache)
        assert before.items() <= now.items()
        before = now
    finished = computing()
    printed = finished.communicate()[0]
    assert finished.returncode == 0
    assert before.items() <= kept(cache).items(), "something was solved twice"
    assert all(cache.get(name.removesuffix(".json")) is not None for name in kept(cache))
    return printed, before


@pytest.mark.slow
def test_kills_lose_nothing(cache, monkeypatch, tmp_path):
    """Killed as soon as it has kept another contact; then the curve is what it is without any kill."""

    def when_more_is_kept(number, count, process):
        deadline = time.monotonic() + 60
        while count() <= 2 * number and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.02)

    printed, before = kill_and_finish(cache, 2, when_more_is_kept)
    assert len(before) >= 2
    monkeypatch.setenv(VARIABLE, str(tmp_path / "other"))
    assert computing().communicate()[0] == printed


@pytest.mark.slow
def test_a_hundred_kills_lose_nothing(cache):
    """At any time, from the start of the process on."""
    chance = random.Random(1)
    _, before = kill_and_finish(cache, 100, lambda *_: time.sleep(chance.uniform(0, 3)))
    assert before


def test_two_processes_share_a_cache(cache):
    both = [computing(), computing()]
    printed = {process.communicate()[0] for process in both}
    assert len(printed) == 1
    assert all(process.returncode == 0 for process in both)


def test_a_substrate_that_remembers_passes_as_fast_as_beta_says():
    kernel = ViscoelasticKernel((0.5,), (3.0,))
    problem = Problem(beta_load=100.0, substrate=kernel)
    assert at(problem, 25.0).substrate.lengths == pytest.approx((12.0,))
    assert at(at(problem, 7.0), 100.0).substrate.lengths == pytest.approx((3.0,))
    assert at(Problem(beta=4.0), 2.0) == Problem(beta=2.0)
