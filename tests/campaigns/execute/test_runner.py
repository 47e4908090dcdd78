"""Campaign from file to tables: written files, their times, and refusals before any simulation.

Truth: columns and fields documented in docs/campaigns.md; draws recomputed from the campaign alone; metrics recomputed
by numpy from `simulate` with the drawn values; rates counted by hand.
"""

import json
import os
import re

import numpy as np
import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.definition.file import read_campaign
from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.draws.table import draw_table
from perilune.analysis.campaigns.execute.runner import run_batch
from perilune.analysis.campaigns.folder.provenance import batch_digest
from perilune.analysis.campaigns.summary import requirement_values
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.common.errors import InputError
from perilune.common.paths import SYSTEMS

SYSTEM = "lunar_terminal_guidance"
PAPER = SYSTEMS / SYSTEM / "campaigns" / "paper.toml"
pytestmark = pytest.mark.usefixtures("fmus")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("results") / "deep" / "paper"


@pytest.fixture(scope="module")
def result(fmus, folder):
    return perilune.batch(SYSTEM, "paper", trials=12, seed=5, workers=1, output=folder, flavour="native")


def campaign(tmp_path, head="", tail="", name="c.toml"):
    """Write the published campaign with a head before its first line and a tail after its last; both win."""
    text = PAPER.read_text()
    for line in filter(None, head.splitlines()):
        key = line.partition("=")[0].strip()
        text, count = re.subn(rf"(?m)^{re.escape(key)} = .*$", line, text, count=1)
        if not count:
            text = f"{line}\n{text}"
    path = tmp_path / name
    path.write_text(text + tail)
    return str(path)


def test_tables_and_their_columns(result, folder):
    table = pyarrow.parquet.read_table(folder / "trials")
    assert table.equals(result.table())
    read = read_campaign(PAPER)
    expected = ["variant", "trial", "status", "success", "message", "end_time"]
    expected += [f"draw.{name}" for name in read.input_names()]
    expected += [f"final.{name}" for name in read.record.final]
    expected += [f"metric.{metric.name}" for metric in read.metrics]
    assert table.column_names == expected
    assert table.num_rows == 36
    assert table["variant"].to_pylist() == [
        v for v in ("analytic_guidance", "astar_guidance", "astar_modified_guidance") for _ in range(12)
    ]
    assert table["trial"].to_pylist() == list(range(12)) * 3
    about = json.loads(table.schema.metadata[b"perilune"])
    assert about == {"batch": batch_digest(result.provenance), "shard": 0, "trials": [0, 12]}
    draws = pyarrow.parquet.read_table(folder / "draws.parquet")
    assert draws.column_names == ["trial", *read.input_names()]
    for name in read.input_names():
        assert table[f"draw.{name}"].to_pylist() == draws[name].to_pylist() * 3


def test_summary_counts_what_the_table_holds(result, folder):
    summary = json.loads((folder / "summary.json").read_text())
    assert {"system", "system_sha256", "campaign", "trials", "seed", "step", "algorithm", "fmus", "perilune"} <= set(
        summary
    )
    table = pyarrow.parquet.read_table(folder / "trials").to_pylist()
    for variant, actual in summary["variants"].items():
        rows = [row for row in table if row["variant"] == variant]
        good = [row for row in rows if row["success"]]
        assert actual["trials"] == 12
        assert actual["success_rate"] == len(good) / 12
        low, high = actual["success_interval"]
        assert 0 <= low <= actual["success_rate"] <= high <= 1
        assert sum(actual["statuses"].values()) == 12
        errors = [row["metric.position_error"] for row in good]
        assert actual["metrics"]["position_error"]["mean"] == pytest.approx(np.mean(errors), rel=1e-12)
        assert actual["metrics"]["position_error"]["std"] == pytest.approx(np.std(errors, ddof=1), rel=1e-12)
        assert actual["metrics"]["position_error"]["unit"] == "m"


def test_a_trial_is_the_flight_of_its_draws(result):
    for row in result.table().to_pylist()[::5]:
        sampled = {name.removeprefix("draw."): value for name, value in row.items() if name.startswith("draw.")}
        settings = {name: value for name, value in sampled.items() if "." in name}
        flight = perilune.simulate(SYSTEM, use={"guidance": row["variant"]}, set=settings)
        miss = [flight[f"plant.position[{i}]"][-1] - (0.0, 0.0, 2000.0)[i - 1] for i in (1, 2, 3)]
        speed = [flight[f"plant.velocity[{i}]"][-1] for i in (1, 2, 3)]
        assert row["metric.position_error"] == pytest.approx(np.linalg.norm(miss), rel=1e-12)
        assert row["metric.velocity_error"] == pytest.approx(np.linalg.norm(speed), rel=1e-12)
        assert row["final.plant.position[2]"] == flight["plant.position[2]"][-1]
        assert row["end_time"] == flight.time[-1]
        assert row["status"].split(" ")[0] == flight.status
        assert row["success"] == bool(
            flight["finished"][-1] and np.linalg.norm(miss) <= 200 and np.linalg.norm(speed) <= 10
        )


def test_draws_are_written_first(tmp_path, monkeypatch):
    """A batch that dies while flying leaves what it flies and the draws, and no result."""

    def die(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("perilune.analysis.campaigns.execute.runner.fly_shards", die)
    plan = read_plan(SYSTEM, "paper", SystemOptions(), trials=5)
    with pytest.raises(KeyboardInterrupt):
        run_batch(plan, workers=1, output=tmp_path / "out")
    assert {path.name for path in (tmp_path / "out").iterdir()} == {".lock", "draws.parquet", "files", "manifest.json"}
    table = pyarrow.parquet.read_table(tmp_path / "out" / "draws.parquet")
    expected = draw_table(plan.campaign).columns
    assert {name: table[name].to_pylist() for name in expected} == {name: list(v) for name, v in expected.items()}


def test_requirements_see_every_number(result):
    values = requirement_values(result.summary)
    for text, truth in {
        "analytic_guidance.success_rate == 1": 1.0,
        "astar_guidance.success_rate >= analytic_guidance.success_rate": float(
            result.summary["astar_guidance"].success_rate == 1.0
        ),
        "analytic_guidance.metrics.position_error.max < 0.1": 1.0,
        "analytic_guidance.success_interval[1] > 0.99": 0.0,
    }.items():
        expression = Expression(text, ("--require", text))
        assert expression.names <= set(values)
        assert float(expression.evaluate(values)) == truth, text


def test_campaign_settings_lose_to_the_users(tmp_path):
    path = campaign(tmp_path, tail='\n[set]\n"plant.initial_mass" = 500.0\n')
    plan = read_plan(SYSTEM, path, SystemOptions(), trials=1)
    variant = plan.campaign.variants()[0]
    assert plan.prepare(variant).settings.variables["plant", "initial_mass"] == 500.0
    plan = read_plan(SYSTEM, path, SystemOptions(set={"plant.initial_mass": 700.0}), trials=1)
    assert plan.prepare(variant).settings.variables["plant", "initial_mass"] == 700.0


def test_traces_of_failures(tmp_path):
    path = campaign(tmp_path, head='traces = "failures"')
    result = perilune.batch(
        SYSTEM, path, trials=14, seed=11, workers=1, compare={"guidance": ["astar_guidance"]}, output=tmp_path / "out"
    )
    table = result.table().to_pylist()
    failed = [row["trial"] for row in table if not row["success"]]
    assert failed
    files = sorted((tmp_path / "out" / "traces" / "astar_guidance").iterdir())
    assert [int(file.stem) for file in files] == failed
    trace = pyarrow.parquet.read_table(files[0])
    assert {"time", "plant.position[1]", "allocation.thrust", "guidance.status"} <= set(trace.column_names)
    row = table[failed[0]]
    assert trace["plant.position[1]"][-1].as_py() == row["final.plant.position[1]"]


def test_samples_of_signals(tmp_path):
    path = campaign(tmp_path)
    text = (tmp_path / "c.toml").read_text()
    sampling = '[record]\nevery = 50\nsignals = ["plant.position[3]"]\n'
    (tmp_path / "c.toml").write_text(text.replace("[record]\n", sampling))
    compare = {"guidance": ["analytic_guidance"]}
    perilune.batch(SYSTEM, path, trials=2, workers=1, compare=compare, output=tmp_path / "out")
    trace = pyarrow.parquet.read_table(tmp_path / "out" / "traces" / "analytic_guidance" / "000001.parquet")
    assert trace.column_names == ["time", "plant.position[3]"]
    assert trace["time"].to_pylist()[:3] == [0.0, 5.0, 10.0]


@pytest.mark.parametrize(
    ("head", "tail", "words"),
    [
        ('system = "lunar_landing"', "", "the campaign is for lunar_landing, not lunar_terminal_guidance"),
        ("", '\n[draw."plant.initial_positon[3]"]\ndistribution = "uniform"\nlow = 0\nhigh = 1\n', "initial_positon"),
        (
            "",
            '\n[draw."plant.initial_mass"]\ndistribution = "normal"\nmean = 0\nsigma = 1\n',
            "plant.initial_mass.*outside",
        ),
        (
            "",
            '\n[draw."guidance.terminal_step"]\ndistribution = "uniform"\nlow = 0\nhigh = 1\n',
            "guidance.terminal_step.*not whole",
        ),
        (
            "",
            '\n[metric.odd]\nexpression = "plant.heat"\nreduction = "max"\n',
            "plant.heat: neither a signal nor a param",
        ),
        ("", '\n[set]\n"plant.initial_moss" = 1.0\n', "plant.initial_moss: matches no parameter"),
        ('parameters = ["none.ssv"]', "", "has a file none.ssv"),
        ("trials = 0", "", "0 trial"),
    ],
)
def test_refused_before_anything_is_written(tmp_path, head, tail, words):
    path = campaign(tmp_path, head, tail)
    before = sorted(tmp_path.iterdir())
    with pytest.raises(InputError, match=words) as caught:
        perilune.batch(
            SYSTEM, path, workers=1, output=tmp_path / "out", **({} if head == "trials = 0" else {"trials": 8})
        )
    assert "\n" not in str(caught.value)
    assert sorted(tmp_path.iterdir()) == before


def test_recording_what_is_no_signal_is_refused(tmp_path):
    path = campaign(tmp_path)
    text = (tmp_path / "c.toml").read_text().replace('"guidance.time_to_go",', '"plant.initial_mass",')
    (tmp_path / "c.toml").write_text(text)
    with pytest.raises(InputError, match=r"record: plant\.initial_mass: not a signal"):
        perilune.batch(SYSTEM, path, trials=1, workers=1, output=tmp_path / "out")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"compare": {"guidance": ["flat_moon_lander"]}}, r"guidance\.position\[1\].*is output in .*flat_moon_lander"),
        ({"compare": {"guidence": ["astar_guidance"]}}, "compare: guidence: no such component"),
        ({"workers": 0}, "workers: 0: not a positive number"),
        ({"trials": 0}, "trials: 0: not a positive number"),
        ({"trials": 10**7}, r"trials: 10000000 trials are requested, but one table of draws has at most 1000000"),
        ({"seed": -1}, "seed: -1 is negative"),
    ],
)
def test_options_refused(tmp_path, options, words):
    with pytest.raises(InputError, match=words):
        perilune.batch(SYSTEM, "paper", output=tmp_path / "out", **({"trials": 2, "workers": 1} | options))
    assert not (tmp_path / "out").exists()


def test_unknown_campaign():
    with pytest.raises(InputError, match=r"campaign: .* has a file papper.*paper\.toml.*noisy\.toml"):
        perilune.batch(SYSTEM, "papper")


@pytest.mark.slow
def test_threads_leave_the_working_directory_alone(tmp_path, monkeypatch):
    """Loading a library changes it for a moment; two threads at once once left it changed."""
    monkeypatch.chdir(tmp_path)
    for k in range(4):
        perilune.batch(SYSTEM, "paper", trials=8, workers=4, flavour="native", output=f"out{k}")
        assert os.getcwd() == str(tmp_path)
        assert (tmp_path / f"out{k}" / "summary.json").is_file()
