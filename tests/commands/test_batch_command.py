"""`perilune batch`: exit status, requirements, replay, files and JSON.

Truth: `perilune.batch` with the same options; the documented exit status: 0 if it ran, whatever its success rate, 1 if
a requirement is not met, 2 for wrong input.
"""

import json

import numpy as np
import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.common.paths import SYSTEMS

SYSTEM = "lunar_terminal_guidance"
OVERFLOW = ("--fault", "guidance.thrust_acceleration=override:1e308@1")  # a flight that breaks off
SMALL = ["batch", SYSTEM, "--campaign", "paper", "--trials", "10", "--workers", "1"]
pytestmark = pytest.mark.usefixtures("fmus")


def test_exits_0_whatever_the_success_rate(capsys):
    assert main([*SMALL, "--compare", "guidance=astar_guidance", "--set", "plant.gravity=3"]) == 0
    captured = capsys.readouterr()
    variant, trials, success, *_ = captured.out.splitlines()[1].split()
    assert (variant, trials) == ("astar_guidance", "10")
    assert float(success) < 50.0
    assert captured.err == ""


@pytest.mark.parametrize(
    ("requirement", "status"),
    [
        ("analytic_guidance.success_rate >= 0.99", 0),
        ("analytic_guidance.metrics.position_error.max < 1e-9", 1),
        ("astar_guidance.success_rate > analytic_guidance.success_rate", 1),
    ],
)
def test_requirements(capsys, requirement, status):
    assert main([*SMALL, "--require", "analytic_guidance.trials == 10", "--require", requirement]) == status
    error = capsys.readouterr().err
    assert error == (f"perilune: --require: {requirement}: not met\n" if status else "")


REQUIRED = """
[requirement.near]
expression = "position_error < {limit}"
share = "{share} %"
confidence = "90 %"
"""


@pytest.mark.slow
def test_the_worst_trial_has_its_command(capsys, tmp_path):
    """The largest of an upper bound, the smallest of a lower one, nan before all; by variant, of a stored campaign."""
    metrics = """
[metric.late]
expression = "time"
reduction = "first"
condition = "plant.initial_position[2] > 0"
"""
    text = (SYSTEMS / SYSTEM / "campaigns" / "paper.toml").read_text() + metrics
    for name, metric, bound in (
        ("near", "position_error", "upper"),
        ("far", "position_error", "lower"),
        ("in_time", "late", "upper"),
    ):
        text += REQUIRED.format(limit=1e6, share=50).replace(".near]", f".{name}]")
        text += f'metric = "{metric}"\nbound = "{bound}"\n'
    (tmp_path / "c.toml").write_text(text)
    requested = ["batch", SYSTEM, "--campaign", str(tmp_path / "c.toml"), "--trials", "10", "--workers", "1"]
    assert main(requested) == 0
    assert "perilune replay" not in capsys.readouterr().out
    folder = tmp_path / "stored"
    assert main([*requested, "--output", str(folder)]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if "perilune replay" in line]
    rows = perilune.open_results(folder).to_pandas(["variant", "trial", "metric.position_error", "metric.late"])
    expected = []
    for variant, trials in rows.groupby("variant", sort=False):
        errors, command = trials["metric.position_error"], f"perilune replay {folder} {{}} --configuration {variant}"
        for row in (errors.idxmax(), errors.idxmin()):
            head = f"{variant}: worst position_error, {errors[row]:.4g} m"
            expected.append(f"{head}: {command.format(trials['trial'][row])}")
        never = trials["metric.late"].isna()
        assert 0 < never.sum() < 10
        expected.append(f"{variant}: worst late, none: {command.format(trials['trial'][never.idxmax()])}")
    assert lines == expected


@pytest.mark.parametrize(
    ("limit", "share", "status", "words"),
    [
        (1e6, 75, 0, ""),
        (1e6, 99.87, 1, "99.87 % probability at 90 % confidence: undecided: 0 of 10 trials failed; 1761, "),
        (
            0,
            50,
            1,
            "position_error < 0, 50 % probability at 90 % confidence: not met: 10 of 10 trials failed\n",
        ),
    ],
)
def test_requirements_of_the_campaign(capsys, tmp_path, limit, share, status, words):
    """Nine flights without a failure show 75 % at 90 %, and 99.87 % takes 1771."""
    text = (SYSTEMS / SYSTEM / "campaigns" / "paper.toml").read_text() + REQUIRED.format(limit=limit, share=share)
    (tmp_path / "c.toml").write_text(text)
    options = ["--compare", "guidance=analytic_guidance", "--json", "-"]
    known = "analytic_guidance.requirements.near.failures >= 0"
    requested = ["batch", SYSTEM, "--campaign", str(tmp_path / "c.toml"), "--trials", "10", "--workers", "1"]
    assert main([*requested, *options, "--require", known]) == status
    captured = capsys.readouterr()
    assert words in captured.err
    assert captured.err.startswith("perilune: analytic_guidance: requirement near: " if status else "")
    actual = json.loads(captured.out)["variants"]["analytic_guidance"]["requirements"]["near"]
    assert (actual["verdict"] == "met") == (status == 0)
    assert actual["flights"] == 10


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--require", "analytic.success_rate > 1"], "--require: analytic.success_rate: the result has no such number"),
        (["--require", "1 +"], "--require: 1 +"),
        (["--compare", "guidance"], "--compare: guidance: not of the form SLOT=A,B,C"),
        (["--compare", "guidance=no_such_guidance"], "no such FMU is built"),
        (["--workers", "0"], "--workers: 0"),
        (["--seed", "-4"], "seed: -4"),
        (["--campaign", "none"], "--campaign: neither the system nor the working folder has a file none"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_wrong_input(capsys, options, words):
    assert main([*SMALL, *options]) == 2
    error = capsys.readouterr().err
    assert words in error
    assert error.count("\n") == 1
    assert error.startswith("perilune: ")


def test_files_and_json(tmp_path, capsys):
    options = ["--seed", "9", "--compare", "guidance=analytic_guidance,analytic_exact_guidance", "--json", "-"]
    assert main([*SMALL, *options, "--output", str(tmp_path / "out"), "--report", str(tmp_path / "page.html")]) == 0
    actual = json.loads(capsys.readouterr().out)
    assert list(actual["variants"]) == ["analytic_guidance", "analytic_exact_guidance"]
    assert actual == json.loads((tmp_path / "out" / "summary.json").read_text())
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        ".lock",
        "draws.parquet",
        "files",
        "manifest.json",
        "summary.json",
        "trials",
    ]
    compare = {"guidance": ["analytic_guidance", "analytic_exact_guidance"]}
    expected = perilune.batch(SYSTEM, "paper", trials=10, seed=9, compare=compare, workers=1).table()
    assert pyarrow.parquet.read_table(tmp_path / "out" / "trials").equals(expected)
    assert (tmp_path / "page.html").read_text().lower().startswith("<!doctype html")


def test_replay_writes_the_whole_flight(tmp_path, capsys):
    whole = perilune.batch(SYSTEM, "noisy", trials=10, workers=1).table().to_pylist()
    chosen = [row for row in whole if row["trial"] == 3]
    assert len(chosen) > 1
    for row in chosen:
        file = tmp_path / f"{row['variant']}.parquet"
        command = ["replay", SYSTEM, "3", "--campaign", "noisy", "--trials", "10", "--configuration", row["variant"]]
        assert main([*command, "--output", str(file), "--json", "-"]) == 0
        entry = json.loads(capsys.readouterr().out)
        assert (entry["trial"], entry["configuration"]) == (3, row["variant"])
        assert len(entry["metrics"]) > 2
        assert (entry["status"], entry["success"]) == (row["status"].partition(" (")[0], row["success"])
        table = pyarrow.parquet.read_table(file)
        assert table["plant.position[1]"][-1].as_py() == row["final.plant.position[1]"]
        assert table["time"][-1].as_py() == row["end_time"]
        for name, value in entry["metrics"].items():
            assert value == row[f"metric.{name}"]


def test_replay_of_a_flight_without_metrics_is_still_json(capsys):
    """A trial that fails has metrics that are not numbers; strict JSON has null for them."""
    failing = ["replay", SYSTEM, "0", "--campaign", "paper", "--trials", "10"]
    failing += ["--compare", "guidance=analytic_guidance", *OVERFLOW]
    assert main([*failing, "--json", "-"]) == 1
    actual = json.loads(capsys.readouterr().out)
    assert (actual["status"], actual["success"]) == ("nonfinite", False)
    assert set(actual["metrics"].values()) == {None}
    assert main(failing) == 1
    assert "position_error none" in " ".join(capsys.readouterr().out.split())


def test_a_batch_in_which_all_fail_is_reported_not_crashed(tmp_path, capsys):
    failing = ["--compare", "guidance=analytic_guidance", *OVERFLOW]
    assert main([*SMALL, *failing, "--output", str(tmp_path), "--report", str(tmp_path / "r.html"), "--json", "-"]) == 1
    actual = json.loads(capsys.readouterr().out)["variants"]["analytic_guidance"]
    assert actual["statuses"] == {"nonfinite": 10}
    assert actual["metrics"]["position_error"]["mean"] is None
    messages = pyarrow.parquet.read_table(tmp_path / "trials")["message"].to_pylist()
    assert all("allocation.thrust is inf" in text for text in messages)


GROUPED = """
[draw.case]
distribution = "choice"
values = [1, 2, 3.5]
[group]
by = "case"
[metric.near]
expression = "plant.position[3] < 6000"
reduction = "settled"
window = [20.05, 1000]
unit = "s"
[metric.late_mass]
expression = "plant.mass"
reduction = "first"
condition = "plant.position[3] < 6000"
delay = 10
unit = "kg"
[metric.never]
expression = "time < 0"
reduction = "settled"
unit = "s"
"""


@pytest.fixture(scope="module")
def grouped(fmus, tmp_path_factory):
    """Simulate the published campaign with cases and new reductions into a folder."""
    folder = tmp_path_factory.mktemp("grouped")
    (folder / "c.toml").write_text((SYSTEMS / SYSTEM / "campaigns" / "paper.toml").read_text() + GROUPED)
    return folder


def of_campaign(folder, *options):
    return ["batch", SYSTEM, "--campaign", str(folder / "c.toml"), "--trials", "12", "--workers", "1", *options]


def test_groups_settled_and_first(grouped, capsys):
    """Truth: trials/ filtered by hand; a flight of one trial's draws, row by row."""
    compare = ["--compare", "guidance=analytic_guidance,astar_guidance"]
    need = ["--require", 'astar_guidance.groups["3.5"].metrics.near.p95 < 200']
    files = ["--output", str(grouped / "out"), "--report", str(grouped / "page.html")]
    assert main(of_campaign(grouped, *compare, *need, *files)) == 0
    printed = [line.split()[:3] for line in capsys.readouterr().out.splitlines()]
    summary = json.loads((grouped / "out" / "summary.json").read_text())
    assert summary["group"] == "case"
    rows = pyarrow.parquet.read_table(grouped / "out" / "trials").to_pylist()
    for variant, entry in summary["variants"].items():
        assert list(entry["groups"]) == ["1", "2", "3.5"]
        assert sum(group["trials"] for group in entry["groups"].values()) == 12
        for label, group in entry["groups"].items():
            mine = [row for row in rows if row["variant"] == variant and row["draw.case"] == float(label)]
            assert group["value"] == float(label)
            assert group["success_rate"] == np.mean([row["success"] for row in mine])
            assert group["metrics_all"]["near"]["mean"] == pytest.approx(np.mean([row["metric.near"] for row in mine]))
            assert group["metrics_all"]["never"]["p50"] == "inf"
            assert [variant, label, str(len(mine))] in printed
    late, near = summary["metrics"]["late_mass"], summary["metrics"]["near"]
    assert (late["condition"], late["delay"], near["truth"]) == ("plant.position[3] < 6000", 10.0, False)
    row = rows[17]
    sampled = {name[5:]: value for name, value in row.items() if name.startswith("draw.") and "." in name[5:]}
    flight = perilune.simulate(SYSTEM, use={"guidance": row["variant"]}, set=sampled)
    below = [float(t) for t, z in zip(flight.time, flight["plant.position[3]"], strict=True) if z < 6000]
    last_above = max(t for t, z in zip(flight.time, flight["plant.position[3]"], strict=True) if z >= 6000)
    assert row["metric.near"] == pytest.approx(min(t for t in below if t > last_above) - 20.05)
    later = next(k for k, t in enumerate(flight.time) if t >= below[0] + 10 - 1e-6)
    assert row["metric.late_mass"] == flight["plant.mass"][later]
    assert row["metric.never"] == np.inf


def test_other_conditions_are_noted_when_batches_are_compared(grouped, tmp_path, capsys):
    text = (grouped / "c.toml").read_text().replace("delay = 10", "delay = 20")
    (tmp_path / "c.toml").write_text(text)
    for campaign in (grouped, tmp_path):
        compare = ["--compare", "guidance=analytic_guidance"]
        assert main(of_campaign(campaign, *compare, "--output", str(tmp_path / campaign.name))) == 0
    capsys.readouterr()
    assert main(["compare", str(tmp_path / grouped.name), str(tmp_path / tmp_path.name)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == f"{grouped.name} and {tmp_path.name} define the metric late_mass differently"
    assert lines[0].split()[:3] == ["variant", "case", "trials"]


def test_a_replay_says_null_for_what_never_settles(grouped, capsys):
    command = of_campaign(grouped, "--configuration", "astar_guidance", "--json", "-")
    command = ["replay", command[1], "2", *(token for token in command[2:] if token not in ("--workers", "1"))]
    assert main(command) == 0
    metrics = json.loads(capsys.readouterr().out)["metrics"]
    assert metrics["never"] is None
    assert metrics["near"] > 0.0


@pytest.mark.parametrize(
    ("requirement", "status", "words"),
    [
        ('analytic_guidance.groups["2"].trials > 0', 0, ""),
        ('analytic_guidance.groups["2"].statuses.failed == 0', 0, ""),
        ("analytic_guidance.metrics_all.never.p95 > 0", 1, "not met"),
        ('analytic_guidance.groups["4"].trials > 0', 2, "the result has no such number"),
        ("analytic_guidance.groups[2].trials > 0", 2, 'analytic_guidance.groups["2"].trials'),
    ],
)
def test_requirements_on_groups(grouped, capsys, requirement, status, words):
    options = ["--compare", "guidance=analytic_guidance", "--require", requirement]
    assert main(of_campaign(grouped, *options)) == status
    error = capsys.readouterr().err
    assert words in error
    assert error.count("\n") == (1 if words else 0)


def test_too_many_groups_are_refused_before_anything_flies(grouped, tmp_path, capsys):
    text = (grouped / "c.toml").read_text().replace('by = "case"', 'by = "azimuth"')
    (tmp_path / "c.toml").write_text(text)
    assert main([*of_campaign(tmp_path, "--output", str(tmp_path / "out")), "--trials", "101"]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert f"{tmp_path / 'c.toml'}: group.by: has at least 101 different values" in error
    assert not (tmp_path / "out").exists()
