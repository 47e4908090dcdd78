"""Studies and comparisons state the number of crashed simulations with every result.

Truth: the FMU's source, which ends its process if its count is 13; the known number of trials with this count.
"""

from __future__ import annotations

import numpy as np
import pytest

import perilune
from perilune.analysis.cli import main
from tests.support.foreign.odd_fmu import Call, Deed, odd_fmu

pytestmark = pytest.mark.flies
CAMPAIGN = """
system = "odd"
trials = 40
seed = 3

[draw."odd.gain"]
distribution = "uniform"
low = 0.0
high = 1.0

[draw.heavy]
distribution = "uniform"
low = 0.0
high = 1.0

[derive]
"odd.count" = "1 + 12 * (heavy > 0.9)"

[metric.last]
expression = "odd.y"
reduction = "final"

[success]
expression = "last < 2.4"
"""
OPTIONS = dict(stop_time=1.0, step=0.25, workers=1)
STEPS = ["--stop-time", "1", "--step", "0.25", "--workers", "1"]


@pytest.fixture(scope="module")
def crashing(tmp_path_factory):
    folder = tmp_path_factory.mktemp("crashing")
    (folder / "c.toml").write_text(CAMPAIGN)
    return odd_fmu(folder, DEED=Deed.SEGFAULT, IN=Call.STEP, COUNTED=13), folder / "c.toml"


def crashed_in(result):
    return int(np.sum(result.flown.draws["heavy"] > 0.9))


@pytest.mark.parametrize(
    ("study", "arguments"),
    [("rare", {"samples": 100}), ("worst", {"flights": 100}), ("sensitivity", {"base": 32})],
)
def test_a_study_states_them(crashing, tmp_path, study, arguments):
    result = getattr(perilune, study)(*crashing, **arguments, **OPTIONS)
    count = crashed_in(result)
    assert count > 0
    words = f"{count} crashed of {result.flights} simulations counted as failures"
    assert words in result.lines()[0]
    assert words in str(result.to_json()["conditions"])
    assert result.to_json()["lost"] == {"crashed": count}
    result.report(tmp_path / "page.html")
    assert f"<p>All numbers: {words}.</p>" in (tmp_path / "page.html").read_text()


@pytest.mark.parametrize("options", ["rare --samples 100", "worst --flights 100", "sensitivity --base 32"])
def test_its_lines_on_the_terminal_state_them(crashing, options, capsys):
    """The first one on standard output; as many as a study in Python counts, with two workers too."""
    (fmu, campaign), (study, option, size) = crashing, options.split()
    result = getattr(perilune, study)(fmu, campaign, **{option[2:]: int(size)}, **OPTIONS)
    words = [study, str(fmu), "--campaign", str(campaign), option, size, *STEPS[:-1], "2"]
    assert main(words) == 0
    first = capsys.readouterr().out.splitlines()[0]
    assert first.endswith(f", {crashed_in(result)} crashed of {result.flights} simulations counted as failures")


def test_a_comparison_notes_them(crashing, tmp_path, capsys):
    fmu, campaign = crashing
    good = odd_fmu(tmp_path)
    for name, each in (("bad", fmu), ("good", good)):
        assert main(["batch", str(each), "--campaign", str(campaign), "--output", str(tmp_path / name), *STEPS]) < 2
    count = perilune.open_results(tmp_path / "bad").to_pandas()["status"].eq("crashed").sum()
    page = tmp_path / "page.html"
    capsys.readouterr()
    assert main(["compare", str(tmp_path / "bad"), str(tmp_path / "good"), "--report", str(page)]) == 0
    line = f"bad: {count} crashed of 40 trials, counted as failures"
    assert line in capsys.readouterr().out.splitlines()
    assert line in page.read_text()
