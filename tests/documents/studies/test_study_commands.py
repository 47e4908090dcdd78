"""`--report` of the three studies: a page, or refusal before any simulation if it cannot be written.

Truth: the numbers of --json.
"""

import json

import pytest

from perilune.analysis.cli import main
from tests.support.foreign.linear_system import linear_system
from tests.support.pages.checks import assert_self_contained, data_values
from tests.support.pages.studies import SUM

VERBS = {
    "rare": ["rare", "--failure", "total > 1.5", "--samples", "100"],
    "worst": ["worst", "--metric", "total", "--flights", "120"],
    "sensitivity": ["sensitivity", "--base", "32"],
}


@pytest.fixture(scope="module")
def linear(tmp_path_factory):
    folder = tmp_path_factory.mktemp("linear")
    system, campaign = linear_system(folder)
    (folder / "sum.toml").write_text(SUM)
    return system, campaign, str(folder / "sum.toml")


def line_of(linear, name):
    verb, *options = VERBS[name]
    campaign = linear[2] if name == "sensitivity" else linear[1]
    return [verb, linear[0], "--campaign", campaign, *options, "--workers", "1"]


@pytest.mark.parametrize("name", VERBS)
def test_the_page_of_a_study(name, linear, tmp_path, capsys):
    page, document = tmp_path / "page.html", tmp_path / "found.json"
    written = ["--output", str(tmp_path / "out"), "--report", str(page), "--json", str(document)]
    assert main([*line_of(linear, name), *written]) == 0
    text = page.read_text(encoding="utf-8")
    assert_self_contained(text)
    assert str(page) in capsys.readouterr().out
    actual = json.loads(document.read_text())
    numbers = {
        "rare": lambda: [actual["probability"], *actual["interval"]],
        "worst": lambda: [actual["worst"]["value"], actual["worst_random"]["value"]],
        "sensitivity": lambda: [entry["total"] for entry in actual["sensitivity"]["total"].values()],
    }[name]()
    assert set(map(repr, numbers)) <= set(data_values(text))
    assert str(tmp_path / "out") in text  # of the command that flies it again


@pytest.mark.parametrize("name", VERBS)
@pytest.mark.parametrize(
    ("target", "words"),
    [
        ("folder", "is a folder; give the name of a file in it"),
        ("file/page.html", "is a file; give another folder"),
        ("page.pdf", "neither .html nor .htm"),
    ],
)
def test_a_page_that_cannot_be_written_is_refused_before_a_flight(
    name, target, words, linear, tmp_path, capsys, monkeypatch
):
    def fly(*_, **__):
        raise AssertionError("it flew")

    monkeypatch.setattr("perilune.analysis.studies.sample_flights.SampleFlights.fly", fly)
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("mine")
    assert main([*line_of(linear, name), "--report", str(tmp_path / target)]) == 2
    error = capsys.readouterr().err
    assert error.startswith("perilune: --report: ")
    assert words in error
    assert error.count("\n") == 1
