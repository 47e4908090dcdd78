"""`perilune compare`: table, JSON and page of real simulations; exit status for incomparable batches.

Truth: summary.json and trials/ of the batches; the documented exit status: 0 if compared, 2 for wrong input.
"""

import json
import shutil

import numpy as np
import pyarrow.parquet
import pytest
from scipy.stats import beta

import perilune
from perilune.analysis.campaigns.statistics import STATISTICS
from perilune.analysis.cli import main
from perilune.common.paths import SYSTEMS
from tests.support.pages.checks import assert_self_contained, data_values, text_of

SYSTEM = "lunar_terminal_guidance"
VARIANTS = ("analytic_guidance", "astar_guidance", "astar_modified_guidance")
RECORD = """[record]
every = 20
trials = 6
signals = [
    "plant.position[1]", "plant.position[2]", "plant.position[3]", "plant.velocity[1]", "plant.velocity[2]",
    "plant.velocity[3]", "guidance.thrust_acceleration", "allocation.thrust",
]
"""


@pytest.fixture(scope="module")
def folders(fmus, tmp_path_factory):
    """Simulate the published campaign with traces in perfect and in noisy conditions."""
    base = tmp_path_factory.mktemp("compare")
    text = (SYSTEMS / SYSTEM / "campaigns" / "paper.toml").read_text().replace("[record]\n", RECORD)
    (base / "c.toml").write_text(text)
    for name, parameters in (("ideal", ()), ("noisy", ("noisy.ssv",))):
        perilune.batch(SYSTEM, str(base / "c.toml"), trials=16, workers=1, parameters=parameters, output=base / name)
    return base / "ideal", base / "noisy"


def test_table_on_the_console(folders, capsys):
    assert main(["compare", str(folders[0]), "--metrics", "velocity_error"]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    summary = json.loads((folders[0] / "summary.json").read_text())["variants"]
    lines = captured.out.splitlines()
    assert lines[0].split()[:4] == ["variant", "trials", "success", "%"]
    for line, (name, entry) in zip(lines[1:4], summary.items(), strict=True):
        low, high = (100 * end for end in entry["success_interval"])
        expected = [name, "16", f"{100 * entry['success_rate']:.2f}", f"({low:.2f}", "to", f"{high:.2f})"]
        assert line.split()[:6] == expected
    header = next(line.split() for line in lines if line.startswith("metric,"))
    statistics = header[header.index("variant") + 1 : -1]
    assert {"mean", "p95", "max"} <= set(statistics) <= set(STATISTICS)  # those that fit into 100 columns
    for name, entry in summary.items():
        actual = entry["metrics"]["velocity_error"]
        row = ["velocity_error", name, *(f"{actual[key]:.4g}" for key in statistics), "m/s"]
        assert row in [line.split() for line in lines]


def test_json_holds_rates_metrics_and_pairs(folders, capsys):
    assert main(["compare", *map(str, folders), "--json", "-"]) == 0
    actual = json.loads(capsys.readouterr().out)
    for folder in folders:
        summary = json.loads((folder / "summary.json").read_text())
        table = pyarrow.parquet.read_table(folder / "trials").to_pylist()
        assert actual["batches"][str(folder)] == {key: value for key, value in summary.items() if key != "variants"}
        for name, entry in summary["variants"].items():
            mine = actual["variants"][f"{folder.name}: {name}"]
            assert mine["success_rate"] == entry["success_rate"] == mine["rates"]["success"]["rate"]
            assert mine["metrics"]["position_error"] == entry["metrics"]["position_error"]
            yes = sum(row["metric.finished"] for row in table if row["variant"] == name)
            low = beta.ppf(0.025, yes, 17 - yes) if yes else 0.0
            high = beta.ppf(0.975, yes + 1, 16 - yes) if yes < 16 else 1.0
            assert mine["rates"]["finished"]["interval"] == pytest.approx([low, high], rel=1e-9)
    rows = pyarrow.parquet.read_table(folders[1] / "trials").to_pylist()
    good = {name: np.array([row["success"] for row in rows if row["variant"] == name]) for name in VARIANTS}
    (pair,) = (p for p in actual["pairs"] if (p["a"], p["b"]) == ("noisy: astar_guidance", "noisy: analytic_guidance"))
    assert pair["rates"]["success"]["only_b"] == int(np.sum(good["analytic_guidance"] & ~good["astar_guidance"]))
    assert len(actual["pairs"]) == 3 + 3 + 3


def test_json_file_and_page(folders, tmp_path, capsys):
    page, document = tmp_path / "deep" / "page.html", tmp_path / "c.json"
    command = ["compare", str(folders[0]), "--reference", "astar_guidance"]
    assert main([*command, "--report", str(page), "--json", str(document)]) == 0
    assert "astar_guidance" in capsys.readouterr().out
    text = page.read_text(encoding="utf-8")
    assert_self_contained(text)
    actual = json.loads(document.read_text())
    values = set(data_values(text))
    for entry in actual["variants"].values():
        assert {repr(entry["success_rate"]), *map(repr, entry["success_interval"])} <= values
    assert "B is astar_guidance" in text_of(text)
    assert f"perilune compare {folders[0]} --reference astar_guidance" in text_of(text)
    for words in ("6 of each", "plant.position minus guidance.target_position", "guidance.thrust_acceleration"):
        assert words in text_of(text)
    for digest in json.loads((folders[0] / "summary.json").read_text())["fmus"]["astar_guidance"].values():
        assert digest in text
    repeated = tmp_path / "again.html"
    assert main([*command, "--report", str(repeated)]) == 0
    assert repeated.read_bytes() == page.read_bytes()


def damage(folder, name):
    (folder / name).write_bytes((folder / name).read_bytes()[:-60])


@pytest.mark.parametrize(
    ("spoil", "says"),
    [
        (lambda folder: shutil.rmtree(folder), "summary.json: not found; give a folder that perilune batch"),
        (lambda folder: damage(folder, "trials/000000.parquet"), "000000.parquet: cannot be read as parquet"),
        (lambda folder: damage(folder, "draws.parquet"), "draws.parquet: cannot be read as parquet"),
        (lambda folder: damage(folder, "summary.json"), "summary.json: not JSON"),
        (lambda folder: damage(folder, "traces/astar_guidance/000003.parquet"), "000003.parquet: cannot be read"),
    ],
)  # fmt: skip
def test_damaged_results_exit_2_with_one_line(folders, tmp_path, capsys, spoil, says):
    folder = shutil.copytree(folders[0], tmp_path / "copy")
    spoil(folder)
    assert main(["compare", str(folder), "--report", str(tmp_path / "page.html")]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    assert captured.err.startswith("perilune: ")
    assert says in captured.err
    assert not (tmp_path / "page.html").exists()


def test_different_draws_exit_2_with_one_line(folders, tmp_path, capsys):
    perilune.batch(SYSTEM, "paper", trials=16, seed=1, workers=1, output=tmp_path / "other")
    assert main(["compare", str(folders[0]), str(tmp_path / "other")]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "other: draws: the samples of ground_range differ from those in" in error


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ([], "perilune: compare: the following arguments are required: RESULT"),
        (["{0}", "{0}"], "given twice; give each folder once"),
        (["{0}", "--reference", "nobody"], "--reference: nobody: no such variant; use one of analytic_guidance"),
        (["/dev/null"], "summary.json: not found"),
        (["{0}", "--report", "/dev/null/page.html"], "/dev/null is a file; give another folder"),
    ],
)
def test_wrong_options(folders, capsys, options, says):
    try:
        status = main(["compare", *(option.format(*folders) for option in options)])
    except SystemExit as stop:
        status = stop.code
    assert status == 2
    error = capsys.readouterr().err
    assert says in error
    assert error.count("\n") == 1
