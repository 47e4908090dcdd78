"""Commands of compared batches, from their manifests, write the same trials; common caption of figures.

Truth: summaries of a batch and of its command on the page; the caption of the batch's page.
"""

import json
import shlex

import pytest

from perilune.analysis.cli import main
from perilune.analysis.documents.of.campaign.distributions import distribution_note
from tests.support.pages.checks import parse

pytestmark = pytest.mark.usefixtures("fmus")

CAMPAIGN = ["lunar_terminal_guidance", "--campaign", "paper", "--trials", "2", "--stop-time", "2", "--output", "out"]


def commands(page):
    (fold,) = parse(page.read_text(encoding="utf-8")).xpath("//details[summary='Command of each compared batch']")
    return [item.text_content() for item in fold.xpath(".//li/code")]


def test_the_command_of_a_compared_batch_writes_its_trials(tmp_path, monkeypatch):
    first, second = tmp_path / "first", tmp_path / "second"
    for folder in (first, second):
        folder.mkdir()
    monkeypatch.chdir(first)
    assert main(["batch", *CAMPAIGN, "--set", "plant.initial_mass=950"]) == 0
    assert main(["compare", "out", "--report", "page.html"]) == 0
    (command,) = commands(first / "page.html")
    assert command.startswith("perilune batch lunar_terminal_guidance --campaign paper --trials 2 ")
    monkeypatch.chdir(second)
    assert main(shlex.split(command)[1:]) == 0
    summaries = [json.loads((folder / "out" / "summary.json").read_text()) for folder in (first, second)]
    assert summaries[0] == summaries[1]


def test_the_captions_of_distributions_differ_in_what_they_count():
    ends, succeeds = (distribution_note(of_successes=each).content for each in (False, True))
    assert ends.replace("that end with", "that succeed with").replace("has trials", "has failed trials, or some") == (
        succeeds
    )
