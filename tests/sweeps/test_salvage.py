"""What is sound in a damaged store is copied, and nothing else."""

import pytest

import softlube
from softlube.cli.main import main
from softlube.model.problem import Problem
from softlube.sweeps import Store
from softlube.sweeps.salvage import salvage
from softlube.sweeps.steady import SteadyTask
from softlube.sweeps.tasks import Outcome
from softlube.sweeps.work import content_key, solver_version

COUNT, PAGE = 400, 4096


def outcome(number):
    return Outcome(quantities={"film_min": (0.1 * number, 1e-4)}, facts={"beta": 10.0 + number, "warnings": ""})


@pytest.fixture
def store(tmp_path):
    """A store of many pages, and what is in it."""
    path, content = tmp_path / "old.sweep", {}
    with Store(path) as made:
        made._connection.execute("PRAGMA synchronous = OFF")
        for number in range(COUNT):
            task = SteadyTask(Problem(beta=10.0 + number))
            key = content_key(task, 1e-3)
            content[key] = outcome(number)
            made.save(key, task, 1e-3, solver_version("steady"), content[key])
    return path, content


def test_a_damaged_page_costs_its_rows_and_no_others(store, tmp_path):
    path, content = store
    whole = bytearray(path.read_bytes())
    pages = len(whole) // PAGE
    for page in (pages // 3, pages // 2):
        whole[page * PAGE : (page + 1) * PAGE] = b"\xa5" * PAGE
    path.write_bytes(whole)
    copied = salvage(path, tmp_path / "new.sweep")
    assert COUNT * 0.7 < copied < COUNT
    assert path.read_bytes() == whole
    with Store(tmp_path / "new.sweep") as made:
        found = made.outcomes(content)
        assert len(found) == copied
        assert all(found[key] == content[key] for key in found)
        assert set(made.counts().values()) == {1}


def test_rows_whose_content_is_not_that_of_their_key_stay(store, tmp_path):
    path, _ = store
    with Store(path) as made:
        keys = [key for (key,) in made._connection.execute("SELECT key FROM outcomes LIMIT 3")]
        made._connection.execute("UPDATE outcomes SET accuracy = 0.1 WHERE key = ?", keys[:1])
        made._connection.execute("UPDATE outcomes SET quantities = '{' WHERE key = ?", keys[1:2])
        made._connection.execute("UPDATE outcomes SET status = 'failed' WHERE key = ?", keys[2:])
    assert salvage(path, tmp_path / "new.sweep") == COUNT - 3


def test_what_cannot_be_salvaged_is_told(tmp_path, store):
    with pytest.raises(softlube.InputError, match=r"store: .*none' does not exist"):
        salvage(tmp_path / "none", tmp_path / "new.sweep")
    with pytest.raises(softlube.InputError, match=r"salvage: .* exists"):
        salvage(store[0], store[0])
    (tmp_path / "text").write_text("no store" * 1000)
    with pytest.raises(softlube.InputError, match=r"nothing of .*text' can be read"):
        salvage(tmp_path / "text", tmp_path / "new.sweep")
    assert not (tmp_path / "new.sweep").exists()


def test_from_the_command_line(tmp_path, store, capsys):
    (tmp_path / "plan.toml").write_text("[parameters]\nbeta = 10\n")
    new = tmp_path / "new.sweep"
    assert main(["sweep", str(tmp_path / "plan.toml"), "--store", str(store[0]), "--salvage", str(new)]) == 0
    assert f"Copied {COUNT} outcomes" in capsys.readouterr().out
