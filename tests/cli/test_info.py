"""What a report of a fault should say."""

import json

import softlube
from softlube.cli.main import main
from softlube.files.cache import cache_folder


def test_versions_threads_and_cache(capsys):
    assert main(["info", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["softlube"] == softlube.__version__
    assert found["packages"]["numpy"].count(".") == 2
    assert found["threads"]
    assert found["cache"]["folder"] == str(cache_folder())
    assert main(["info"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == f"softlube: {softlube.__version__}"
    assert any(line.startswith("cache: folder ") for line in lines)
