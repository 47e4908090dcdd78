"""Campaigns on the workers of a dask scheduler: processes of this machine without access to the campaign's folder.

Truth: every file that the same campaign writes when it is simulated here, in one thread.
"""

import random
import shutil
import threading

import pytest

import perilune
from perilune.analysis.campaigns.execute.cluster import connection, shard_tasks
from perilune.analysis.campaigns.execute.cluster.sent import refuse_others
from perilune.analysis.cli import main
from perilune.common.errors import InputError
from perilune.common.paths import PACKAGE, SYSTEMS
from tests.support.campaigns.clusters import can_hide, dask_cluster, until
from tests.support.campaigns.folders import bytes_of, killed_when, shards_in, started
from tests.support.foreign.coupled import coupled_system
from tests.support.interrupts import interrupted_when
from tests.support.lengths import either
from tests.support.lone_fmus import build_lone_fmu

pytest.importorskip("distributed", reason="the extra cluster is not installed")
pytestmark = pytest.mark.usefixtures("fmus")
SYSTEM = "lunar_terminal_guidance"
PAPER = SYSTEMS / SYSTEM / "campaigns" / "paper.toml"
SAMPLED = '[record]\nevery = 500\nsignals = ["plant.mass"]'
TRIALS = 55  # three shards, the last one of five trials


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """Return the folder of this file's campaigns: it is empty to the workers, where this machine can hide it."""
    return tmp_path_factory.mktemp("campaigns")


@pytest.fixture(scope="module")
def cluster(place, tmp_path_factory, fmus):
    hidden = place if can_hide() else None
    with dask_cluster(tmp_path_factory.mktemp("cluster"), hidden=hidden) as actual:
        yield actual


@pytest.fixture(scope="module")
def line(place):
    """Return the command line of a campaign that keeps traces."""
    campaign = place / "c.toml"
    campaign.write_text(PAPER.read_text().replace("[record]", SAMPLED))
    return ["batch", SYSTEM, "--campaign", str(campaign), "--trials", str(TRIALS)]


@pytest.fixture(scope="module")
def whole(line, place):
    assert main([*line, "--output", str(place / "whole"), "--workers", "1"]) == 0
    return bytes_of(place / "whole")


def test_the_bytes_of_two_workers(cluster, line, whole, place):
    assert main([*line, "--output", str(place / "two"), "--scheduler", cluster.address]) == 0
    assert bytes_of(place / "two") == whole


@pytest.mark.slow
def test_shards_one_by_one(cluster, line, whole, place, capsys):
    out = str(place / "parts")
    assert main(["prepare", *line[1:], "--output", out]) == 0
    numbers = list(range(3))
    random.Random(3).shuffle(numbers)
    assert main(["shard", out, str(numbers[0])]) == 0
    perilune.shard(out, numbers[1:], scheduler=cluster.address)
    assert main(["shard", out, "0-2", "--scheduler", cluster.address]) == 0
    assert "shards: 0 simulated, 3 already complete, 0 of 3 missing" in capsys.readouterr().out
    assert main(["merge", out]) == 0
    assert bytes_of(out) == whole


@pytest.mark.parametrize("flavour", either(["native", "python"], ["python"]))
def test_without_a_folder(cluster, flavour):
    """Python FMUs, too, which fly in children of the workers."""
    compare = {"guidance": ["analytic_guidance"]}
    options = dict(trials=3, stop_time=2.0, flavour=flavour, compare=compare)
    there = perilune.batch(SYSTEM, "paper", **options, scheduler=cluster.address)
    here = perilune.batch(SYSTEM, "paper", **options, workers=1)
    assert there.table().equals(here.table(), check_metadata=True)


STUCK = """
system = "{name}"
trials = {trials}
seed = 1

[draw."{name}.pause"]
distribution = "choice"
values = [0.0, 600.0]

[metric.last]
expression = "{name}.y"
reduction = "final"

[success]
expression = "last > 0"
"""


@pytest.mark.slow
def test_a_step_that_hangs_costs_a_trial(cluster, tmp_path):
    """One that keeps Python's lock, too: it hangs in a child of the worker."""
    fmu = build_lone_fmu("Holding", tmp_path, 'stopTime="1" stepSize="0.25"')
    (tmp_path / "c.toml").write_text(STUCK.format(name="Holding", trials=4))
    limited = dict(set={"Holding.at": 0.5}, timeout=0.5)
    actual = perilune.batch(fmu, tmp_path / "c.toml", **limited, scheduler=cluster.address)
    late = actual.plan.draws.columns["Holding.pause"] > 0.0
    assert 0 < late.sum() < late.size
    assert actual.trials["default"].statuses == ["hung" if value else "stop_time" for value in late]


def test_killed_workers_fly_again(cluster, line, place):
    trials, kills = either((2000, 20), (75, 1))
    source = random.Random(5)
    command = [*line[:-1], trials]
    process = started(*command, "--output", place / "killed", "--scheduler", cluster.address)
    shards, done = trials // max(25, trials // 40), 0
    for kill in range(kills):
        wanted = 1 + kill * (shards * 3 // 4) // kills
        done += killed_when(
            process,
            lambda wanted=wanted: shards_in(place / "killed") >= wanted,
            lambda: source.choice(cluster.flying()),
        )
    _, said = process.communicate()
    assert (process.returncode, done) == (0, kills), said
    assert said == ""
    assert main([*map(str, command), "--output", str(place / "left")]) == 0
    assert bytes_of(place / "killed") == bytes_of(place / "left")


@pytest.mark.slow
@pytest.mark.parametrize("lost", ["scheduler", "workers"])
def test_a_cluster_that_is_gone(line, tmp_path, capsys, monkeypatch, lost):
    """After the first of sixteen shards."""
    monkeypatch.setattr(shard_tasks, "WITHOUT_WORKERS", 2.0)
    line = [*line[:-1], "400"]
    out = tmp_path / f"without_{lost}"
    with dask_cluster(tmp_path) as alone:
        watch = threading.Thread(target=lambda: (until(lambda: shards_in(out) >= 1), alone.end(lost)))
        watch.start()
        assert main([*line, "--output", str(out), "--scheduler", alone.address]) == 1
        watch.join()
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert {"scheduler": "no longer answers", "workers": "had no worker for 2 s"}[lost] in said
    assert f"; completed trials are stored in {out}: resume with the same command and --resume, or with shard" in said
    assert main([*line, "--output", str(out), "--resume"]) == 0
    assert main([*line, "--output", str(tmp_path / f"complete_{lost}"), "--workers", "1"]) == 0
    assert bytes_of(out) == bytes_of(tmp_path / f"complete_{lost}")


def test_ctrl_c_leaves_what_can_be_gone_on_with(cluster, line, whole, place, capsys):
    out = place / "interrupted"
    command = [*line, "--output", str(out), "--scheduler", cluster.address]
    with interrupted_when(lambda: shards_in(out) >= 1):
        assert main(command) == 1
    words = (
        f"interrupted; completed trials are stored in {out}: resume with the same command and --resume, or with shard"
    )
    assert capsys.readouterr().err == f"perilune: {words}\n"
    assert 1 <= shards_in(out) < 3
    assert main([*command, "--resume"]) == 0
    assert bytes_of(out) == whole


def test_what_is_refused_costs_no_results(cluster, line, whole, place, capsys, monkeypatch):
    out = ["--output", str(place / "whole"), "--overwrite"]
    for options, words in (
        (
            ["--scheduler", "tcp://127.0.0.1:1"],
            "--scheduler: tcp://127.0.0.1:1: no dask scheduler answers at this address",
        ),
        (["--scheduler", "nowhere"], "--scheduler: nowhere: no dask scheduler answers at this address"),
        (["--scheduler", cluster.address, "--workers", "2"], "--workers: 2: the cluster's workers simulate"),
        (["--scheduler", cluster.address, "--engine", "threads"], "--engine: threads: the cluster's workers simulate"),
    ):
        monkeypatch.setattr(connection, "ANSWER", 0.5)
        assert main([*line, *out, *options]) == 2
        said = capsys.readouterr().err
        assert words in said
        assert said.count("\n") == 1
    assert bytes_of(place / "whole") == whole


def test_the_package_is_missing(line, capsys, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    assert main([*line, "--scheduler", "tcp://127.0.0.1:1"]) == 2
    assert capsys.readouterr().err.endswith("which is not installed; pip install 'perilune[cluster]'\n")


def other_perilune(folder, change):
    """Copy the package's sources with a change, before ours in a worker's path."""
    copy = shutil.copytree(PACKAGE, folder / "perilune", symlinks=False, ignore=shutil.ignore_patterns("*.fmu"))
    change(copy)
    return {"PYTHONPATH": str(folder)}


def changed_source(copy):
    path = copy / "common" / "progress.py"
    path.write_text(path.read_text() + "\n")


def none_at_all(copy):
    (copy / "__init__.py").write_text("raise ModuleNotFoundError('no perilune here')\n")


OTHERS = {
    "changed": (changed_source, "with different source files"),
    "missing": (none_at_all, "cannot load perilune: ModuleNotFoundError"),
}


def test_no_worker_comes(line, tmp_path, monkeypatch, refusal):
    monkeypatch.setattr(connection, "FIRST_WORKER", 0.2)
    with dask_cluster(tmp_path, workers=0) as alone:
        words = f"no worker has connected within 0.2 s; start a worker with dask worker {alone.address}"
        assert words in refusal([*line, "--scheduler", alone.address])


@pytest.mark.slow
@pytest.mark.parametrize("other", OTHERS)
def test_a_worker_with_another_perilune(line, tmp_path, capsys, other):
    change, words = OTHERS[other]
    with dask_cluster(tmp_path, workers=0) as alone:
        alone.worker(other_perilune(tmp_path / "other", change))
        until(alone.flying)
        assert main([*line, "--scheduler", alone.address]) == 2
        said = capsys.readouterr().err
        assert words in said
        assert said.count("\n") == 1


def test_what_is_said_of_another_perilune():
    """As far as it can be had without a worker: the line for each difference, none where there is none."""
    ours = ("0.2.0", "ab")
    refuse_others(ours, ours, "w")
    for theirs, words in (
        (
            ("0.1.0", "ab"),
            "worker w has perilune 0.1.0, but this process has 0.2.0; install this version in the worker's environment",
        ),
        (("0.2.0", "cd"), "worker w has perilune 0.2.0 with different source files;"),
        (ModuleNotFoundError("No module named 'perilune'"), "cannot load perilune: No module named 'perilune';"),
    ):
        with pytest.raises(InputError) as caught:
            refuse_others(ours, theirs, "w")
        assert words in str(caught.value)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*one process per simulation")
def test_trials_of_foreign_fmus_are_those_of_one_worker(cluster, tmp_path):
    """FMUs that leave something in their thread, process or folder."""
    system, campaign = coupled_system(tmp_path)
    tables = [
        perilune.batch(system, campaign, **options).to_pandas()
        for options in ({"workers": 1}, {"scheduler": cluster.address})
    ]
    assert tables[0].equals(tables[1])
