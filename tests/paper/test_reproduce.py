"""Figures in several processes: the choice, the progress, what is written."""

from softlube.paper.figures import FIGURES
from softlube.paper.reproduce import chosen_figures, disagreements, reproduce


def test_progress_counts_every_job(tmp_path):
    seen = []
    result = reproduce(tmp_path, ["11"], processes=1, progress=seen.append)
    assert [news.done for news in seen] == [0, 1, 2]
    assert {news.total for news in seen} == {2}
    assert result.seconds > 0
    assert len(result.files) == 5
    assert disagreements(result) == []


def test_choice_of_figures():
    assert [spec.key for spec in chosen_figures([])] == list(FIGURES)
    assert [spec.key for spec in chosen_figures(["S2", "5", "S2"])] == ["5", "S2"]
