"""Entries in the cache folder: whole or not there, the oldest used out, never an error of the calculation."""

import os
import sys
import time
from pathlib import Path

import pytest

from softlube.files.cache import ABANDONED, VARIABLE, Cache, Usage, cache_folder


@pytest.fixture
def cache(tmp_path):
    return Cache(tmp_path / "deep" / "cache")


def test_what_is_kept_comes_back(cache):
    assert cache.get("a") is None
    assert cache.usage() == Usage(0, 0)
    cache.put("a", {"value": 0.1 + 0.2, "none": float("nan")})
    assert cache.get("a")["value"] == 0.1 + 0.2
    assert cache.get("a")["none"] != cache.get("a")["none"]
    cache.put("a", {"value": 2})
    assert cache.get("a") == {"value": 2}
    assert cache.usage().entries == 1


def test_half_an_entry_is_none(cache):
    cache.put("a", {"value": 1})
    path = cache.folder / "a.json"
    path.write_bytes(path.read_bytes()[:-3])
    assert cache.get("a") is None


def test_the_oldest_used_go_first(cache):
    for number, key in enumerate("abcdefghij"):
        cache.put(key, {"text": "x" * 1000})
        os.utime(cache.folder / f"{key}.json", (number, number))
    size = cache.usage().size
    cache.trim(size)
    assert cache.usage().entries == 10
    cache.get("a")  # used now
    cache.trim(size - 1)
    assert [key for key in "abcdefghij" if (cache.folder / f"{key}.json").exists()] == list(
        "aefghij"
    )  # four fifths of the room


def test_what_killed_processes_have_begun_goes(cache):
    cache.put("a", {})
    begun, old = cache.folder / ".b-123.json", cache.folder / ".c-456.json"
    begun.write_text("{")
    old.write_text("{")
    before = time.time() - ABANDONED - 1
    os.utime(old, (before, before))
    assert cache.usage().entries == 1
    cache.trim()
    assert begun.exists()
    assert not old.exists()
    assert cache.get("a") == {}


def test_clear_removes_all(cache):
    cache.put("a", {})
    cache.put("b", {})
    assert cache.clear().entries == 2
    assert cache.usage() == Usage(0, 0)
    assert cache.clear().entries == 0


def test_where_nothing_can_be_written_nothing_is_kept(tmp_path):
    (tmp_path / "file").write_text("")
    cache = Cache(tmp_path / "file" / "cache")
    cache.put("a", {})
    assert cache.get("a") is None
    assert cache.usage() == Usage(0, 0)
    cache.trim()


def test_the_folder(monkeypatch, tmp_path):
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    assert cache_folder() == tmp_path
    monkeypatch.delenv(VARIABLE)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    monkeypatch.setattr(sys, "platform", "linux")
    assert cache_folder() == tmp_path / "xdg" / "softlube"
    monkeypatch.delenv("XDG_CACHE_HOME")
    assert cache_folder() == Path.home() / ".cache" / "softlube"
    monkeypatch.setattr(sys, "platform", "darwin")
    assert cache_folder() == Path.home() / "Library" / "Caches" / "softlube"
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path / "local"))
    assert cache_folder() == tmp_path / "local" / "softlube" / "Cache"
