"""Campaigns of many trials: partial reading, draws by a counter, and the content of pages.

Truth: the same campaign in memory, draws of single trials, trials counted by hand, and the peak memory of a summary,
which may not grow with the number of trials.
"""

import re
import subprocess
import sys
import tracemalloc

import numpy as np
import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.campaigns import plotted_sample, statistics, summary
from perilune.analysis.campaigns.definition.campaign import TrialGroup
from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.definition.requirements import Requirement
from perilune.analysis.campaigns.execute.loaded_campaign import open_folder
from perilune.analysis.campaigns.folder.stored import read_batch
from perilune.analysis.campaigns.plotted_sample import FIRST, select_trials
from perilune.analysis.campaigns.summary import summarise
from perilune.analysis.campaigns.trials import TrialTable
from perilune.analysis.cli import main
from tests.support.campaigns.folders import bytes_of
from tests.support.lengths import either
from tests.support.pages.samples import mixed_batch, write_batch_page

pytestmark = pytest.mark.usefixtures("fmus")
SYSTEM = "lunar_terminal_guidance"
QUICK = ["--step", "1", "--stop-time", "20", "--compare", "guidance=analytic_guidance"]
COUNTED = """
system = "lunar_terminal_guidance"
draw_scheme = "counter"
trials = 60
seed = 4
[draw.case]
distribution = "grid"
values = [1, 2]
[draw."plant.initial_mass"]
distribution = "normal"
mean = 940
sigma = 5
[derive]
late = "5 + plant.initial_mass / 940"
[fault.stuck]
connector = "plant.thrust_direction[1]"
kind = "override"
value = 0
start = "late"
when = "case == 2"
[group]
by = "case"
[metric.mass]
expression = "plant.mass"
reduction = "final"
unit = "kg"
[success]
expression = "mass > 0"
"""


@pytest.fixture(scope="module")
def counted(tmp_path_factory):
    path = tmp_path_factory.mktemp("counted") / "counted.toml"
    path.write_text(COUNTED)
    return path


# From the folder, where there is one.
REPLAYS = r"<p class=.note.>.*--output.*</p>|<code[^>]*>perilune [^<]*|\"command\":\[[^]]*\]"


def test_a_result_in_a_folder_is_the_one_in_memory(tmp_path):
    """Summary, page, table and correlations, of trials that are read shard by shard."""
    options = {"trials": 60, "step": 1.0, "stop_time": 20.0}
    held = perilune.batch(SYSTEM, "paper", **options)
    stored = perilune.batch(SYSTEM, "paper", output=tmp_path / "out", **options)
    assert len(list((tmp_path / "out" / "trials").iterdir())) == 3
    assert stored.summary == held.summary
    assert stored.rank_correlations("astar_guidance") == held.rank_correlations("astar_guidance")
    assert stored.table().equals(held.table())
    pages = []
    for result in (held, stored):
        result.report(tmp_path / "page.html")
        pages.append(re.sub(REPLAYS, "", (tmp_path / "page.html").read_text()))
    assert pages[0] == pages[1]


def test_draws_by_a_counter_fly_in_any_part(counted, tmp_path):
    line = ["batch", SYSTEM, "--campaign", str(counted), "--step", "1", "--stop-time", "20"]
    assert main([*line, "--output", str(tmp_path / "whole")]) == 0
    whole = bytes_of(tmp_path / "whole")
    assert "draws.parquet" not in whole
    assert main(["prepare", *line[1:], "--output", str(tmp_path / "parts")]) == 0
    for shard in (2, 0, 1):
        assert main(["shard", str(tmp_path / "parts"), str(shard)]) == 0
    assert main(["merge", str(tmp_path / "parts")]) == 0
    assert bytes_of(tmp_path / "parts") == whole
    assert main([*line, "--trials", "100", "--output", str(tmp_path / "whole"), "--resume"]) == 0
    actual = read_batch(tmp_path / "whole")
    sampled = open_folder(tmp_path / "whole").plan.draws
    for trial in (0, 59, 60, 99):
        one = sampled.of_part(range(trial, trial + 1)).columns
        assert {name: values[0] for name, values in one.items()} == {
            name: values[trial] for name, values in actual.draws.items()
        }
    assert [group.label for group in actual.groups] == ["1", "2"]
    page = tmp_path / "page.html"
    assert main(["compare", str(tmp_path / "whole"), str(tmp_path / "parts"), "--report", str(page)]) == 2  # 100, 60
    assert main(["compare", str(tmp_path / "whole"), "--report", str(page)]) == 0


def test_more_trials_than_a_table_has(counted, tmp_path, capsys):
    """The last shard of two million trials, which nobody draws before it."""
    out = tmp_path / "out"
    line = ["batch", SYSTEM, "--campaign", str(counted), "--trials", "1000002", "--step", "1", "--stop-time", "20"]
    assert main(["prepare", *line[1:], "--output", str(out)]) == 0
    assert "shards 0-200, 5000 trials each" in capsys.readouterr().out
    assert main(["shard", str(out), "200"]) == 0
    table = pyarrow.parquet.read_table(out / "trials" / "000200.parquet")
    assert table["trial"].to_pylist() == [1_000_000, 1_000_001]
    sampled = open_folder(out).plan.draws.of_part(range(1_000_000, 1_000_002)).columns
    for name, values in sampled.items():
        assert table[f"draw.{name}"].to_numpy().tolist() == values.tolist()
    assert table["fault.stuck"].to_pylist() == [False, True]
    plain = counted.read_text().replace('draw_scheme = "counter"\n', "")
    (tmp_path / "plain.toml").write_text(plain)
    assert main(["batch", SYSTEM, "--campaign", str(tmp_path / "plain.toml"), "--trials", "1000002"]) == 2
    assert (
        'one table of draws has at most 1000000; give fewer trials, or write draw_scheme = "counter"'
        in capsys.readouterr().err
    )


def test_the_page_of_a_long_campaign_says_what_it_shows(tmp_path, monkeypatch):
    monkeypatch.setattr(plotted_sample, "FIRST", 30)
    monkeypatch.setattr(plotted_sample, "FAILURES", 4)
    result = mixed_batch(100)
    whole = mixed_batch(100)
    shaky = result.plotted["shaky"]
    failed = np.flatnonzero(~whole.trials["shaky"].success)
    behind = failed[failed >= 30]
    assert behind.size > 4
    order = [*range(30), *behind[:4]]
    assert shaky.first.metrics["miss"].tolist() == whole.trials["shaky"].metrics["miss"][:30].tolist()
    assert shaky.dots.draws["offset"].tolist() == whole.plan.draws.columns["offset"][order].tolist()
    observed = np.count_nonzero(failed < 30) + 4
    assert shaky.note == f"the first 30 of 100 trials; scatter plots also show {observed} of {failed.size} failures"
    assert result.plotted["steady"].note == "the first 30 of 100 trials; scatter plots also show all failures"
    write_batch_page(result, tmp_path / "page.html", "Long")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert f"plots and rank correlations use {shaky.note}." in " ".join(page.split())
    monkeypatch.undo()
    write_batch_page(whole, tmp_path / "whole.html", "Long")
    assert "plots and rank correlations use" not in (tmp_path / "whole.html").read_text(encoding="utf-8")
    tables = [
        re.findall(r"<table.*?</table>", (tmp_path / name).read_text(), re.DOTALL)
        for name in ("page.html", "whole.html")
    ]
    assert tables[0][0] == tables[1][0]  # rates are of all trials


class Made(TrialTable):
    """Trials created as they are read, as by a folder of shards."""

    def __init__(self, trials):
        super().__init__(TrialTable.of({"metric.miss": np.zeros(0), "draw.case": np.zeros(0)}).table)
        self.trials = trials

    def tables(self, names):
        for first in range(0, self.trials, 5000):
            source = np.random.default_rng(first)
            miss, case = source.standard_normal(5000), source.integers(0, 3, 5000).astype(float)
            columns = {"metric.miss": miss, "draw.case": case, "success": miss < 2.5}
            columns["trial"] = np.arange(first, first + 5000)
            columns["status"] = np.array(["finished", "stop_time"], dtype=object)[(miss > 3.0).astype(int)]
            yield TrialTable.of(columns).table.select(names)


def test_summing_up_takes_no_more_memory_for_more_trials(monkeypatch):
    for module in (statistics, summary):
        monkeypatch.setattr(module, "IN_MEMORY", 10_000)
    monkeypatch.setattr(plotted_sample, "FIRST", either(FIRST, 30_000))
    requirement = Requirement("near", Expression("miss < 3"), 0.99, 0.9, "miss")
    groups = [TrialGroup("1", 1.0)]

    def most(trials):
        rows = Made(trials)
        tracemalloc.start()
        actual = summarise({"made": rows}, groups, "case", requirements=[requirement])
        figures = select_trials(rows, ["case"], ["miss"])
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert actual["made"].trials == trials
        assert figures.first.success.size == plotted_sample.FIRST
        return peak

    few, many = either((1_000_000, 4_000_000), (40_000, 80_000))
    assert most(many) < 1.05 * most(few) + 3 * (many - few)  # verdicts hold three bytes a trial for a moment


FLY = """
import resource, sys
from perilune.analysis.cli import main
status = main(sys.argv[1:])
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, file=sys.stderr)
sys.exit(status)
"""


@pytest.mark.skipif(either(False, True), reason="a million flights: make long")
def test_a_million_trials_take_the_memory_of_a_hundred_thousand(tmp_path):
    def most(trials):
        out = str(tmp_path / str(trials))
        words = ["batch", SYSTEM, "--campaign", "paper", *QUICK, "--trials", str(trials), "--output", out]
        words += ["--report", f"{out}.html"]
        flown = subprocess.run([sys.executable, "-c", FLY, *words], capture_output=True, text=True, check=False)
        assert flown.returncode == 0, flown.stderr
        return int(flown.stderr.split()[-1])

    few, many = most(100_000), most(1_000_000)
    assert many <= 1.05 * few
    assert (tmp_path / "1000000.html").stat().st_size < 8e6
