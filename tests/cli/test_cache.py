"""softlube cache: what is kept, and how it goes."""

import json

from softlube.cli.main import main
from softlube.files.cache import VARIABLE, Cache


def test_cache(monkeypatch, tmp_path, capsys):
    monkeypatch.setenv(VARIABLE, str(tmp_path / "kept"))
    assert main(["cache"]) == 0
    assert "0 solved contacts" in capsys.readouterr().out
    Cache().put("a", {"film_min": 1.0})
    assert main(["cache", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["folder"], told["entries"], told["cleared"]) == (str(tmp_path / "kept"), 1, False)
    assert 0 < told["bytes"] < 100
    assert main(["cache", "--clear"]) == 0
    assert "Removed: 1 solved contacts" in capsys.readouterr().out
    assert Cache().usage().entries == 0
