"""Recorded trials and column metadata of a stored batch: trials with traces, equal bits for any workers, checksums.

Truth: the trials named in the campaign file, counted here; the traces of the same campaign without the key; units and
types as declared by the blocks.
"""

import json

import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.definition.file import read_campaign
from perilune.common.errors import InputError
from perilune.common.paths import SYSTEMS
from perilune.fmus_src.plants.flat_moon_lander import FlatMoonLander
from tests.support.lengths import either

SYSTEM = "lunar_terminal_guidance"
PAPER = SYSTEMS / SYSTEM / "campaigns" / "paper.toml"
SAMPLED = 'every = 50\nsignals = ["plant.position[3]", "guidance.finished", "plant.mass"]\n'


def campaign(folder, record):
    """Write the published campaign with more in its [record]."""
    path = folder / "c.toml"
    text = PAPER.read_text().replace('traces = "none"', "# ")
    path.write_text(text.replace("[record]\n", f"[record]\n{record}"))
    return path


def fly(folder, record, **options):
    compare = {"guidance": ["analytic_guidance", "astar_guidance"]}
    options = {"trials": 14, "seed": 11, "workers": 1, "compare": compare} | options
    perilune.batch(SYSTEM, str(campaign(folder, record)), output=folder / "out", **options)
    return folder / "out"


def traces(folder):
    """Return every trace by variant and trial, without the metadata."""
    return {
        (path.parent.name, int(path.stem)): pyarrow.parquet.read_table(path).replace_schema_metadata(None)
        for path in sorted((folder / "traces").glob("*/*.parquet"))
    }


@pytest.fixture(scope="module")
def everything(fmus, tmp_path_factory):
    return fly(tmp_path_factory.mktemp("all"), SAMPLED)


def test_the_key_is_read(tmp_path):
    read = read_campaign(campaign(tmp_path, SAMPLED + "trials = 5\n"))
    assert (read.record.every, read.record.trials) == (50, 5)
    assert read_campaign(campaign(tmp_path, SAMPLED)).record.trials is None


@pytest.mark.parametrize(
    ("record", "says"),
    [
        (SAMPLED + "trials = 0\n", "record.trials: 0 trial(s); give n >= 1"),
        (SAMPLED + "trials = -3\n", "record.trials: -3 trial(s)"),
        (SAMPLED + "trials = 2.5\n", "record.trials: 2.5 is not a whole number"),
        (SAMPLED + "trials = true\n", "record.trials: True is not a whole number"),
        ("trials = 5\n", "record.trials: no signal is recorded over time; give every = n and signals"),
    ],
)
def test_the_key_is_refused(tmp_path, record, says):
    with pytest.raises(InputError) as caught:
        read_campaign(campaign(tmp_path, record))
    assert says in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("trials", "workers"), either([(5, 1), (5, 3), (1, 2), (14, 1), (99, 2)], [(5, 3), (99, 2)]))
def test_the_first_trials_leave_the_traces_they_leave_without_it(everything, tmp_path, trials, workers):
    actual = traces(fly(tmp_path, f"{SAMPLED}trials = {trials}\n", workers=workers))
    expected = {key: table for key, table in traces(everything).items() if key[1] < trials}
    assert len(expected) == 2 * min(trials, 14)
    assert actual.keys() == expected.keys()
    assert all(actual[key].equals(table) for key, table in expected.items())


def test_trials_and_metrics_are_the_same_with_or_without_traces(everything, tmp_path):
    few = pyarrow.parquet.read_table(fly(tmp_path, f"{SAMPLED}trials = 2\n") / "trials")
    assert few.replace_schema_metadata(None).equals(
        pyarrow.parquet.read_table(everything / "trials").replace_schema_metadata(None)
    )


def test_failures_beyond_the_first_trials_are_kept_in_full(tmp_path):
    folder = fly(tmp_path, f'{SAMPLED}trials = 3\ntraces = "failures"\n')
    table = pyarrow.parquet.read_table(folder / "trials").to_pylist()
    failed = {(row["variant"], row["trial"]) for row in table if not row["success"]}
    assert any(trial >= 3 for _, trial in failed)
    actual = traces(folder)
    assert set(actual) == failed | {(row["variant"], row["trial"]) for row in table if row["trial"] < 3}
    for key, trace in actual.items():
        assert ("guidance.status" in trace.column_names) == (key in failed)


def test_the_summary_says_what_the_columns_are(everything):
    summary = json.loads((everything / "summary.json").read_text())
    assert summary["record"] == {
        "every": 50,
        "signals": ["plant.position[3]", "guidance.finished", "plant.mass"],
        "trials": None,
        "traces": "none",
    }
    assert summary["signals"]["plant.position[3]"] == {
        "unit": FlatMoonLander.position.unit,
        "type": "Real",
        "axis": "up",
    }
    assert summary["signals"]["guidance.finished"] == {"unit": None, "type": "Boolean"}
    assert summary["signals"]["plant.velocity[1]"]["unit"] == "m/s"
    assert "plant.thrust" not in summary["signals"]
    assert summary["success"] == read_campaign(PAPER).success.text
    assert summary["metrics"]["finished"]["truth"] is True  # a Boolean signal at the end
    assert summary["metrics"]["clamped"]["truth"] is False  # a mean of truths is none
    assert summary["metrics"]["position_error"]["unit"] == "m"
    for variant in ("analytic_guidance", "astar_guidance"):
        target = summary["targets"][variant]
        assert [target[f"guidance.target_position[{i}]"] for i in (1, 2, 3)] == [0.0, 0.0, 2000.0]
        assert [target[f"guidance.target_velocity[{i}]"] for i in (1, 2, 3)] == [0.0, 0.0, 0.0]


def test_targets_are_those_that_were_set(tmp_path):
    folder = fly(tmp_path, "", trials=1, set={"guidance.target_position[3]": 1500.0})
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["targets"]["astar_guidance"]["guidance.target_position[3]"] == 1500.0


@pytest.mark.parametrize(
    ("text", "truth"),
    [
        ("a < 1", True), ("0 < a <= 1", True), ("a and b", True), ("not a", True), ("(a == 1) or b", True),
        ("a", False), ("a < 1 and 2 * b", True), ("where(a < 1, 2, 3)", False), ("1 * (a < 1)", False),
    ],
)  # fmt: skip
def test_truths_are_told_from_numbers(text, truth):
    expression = Expression(text)
    assert expression.is_truth == truth
    if truth:
        values = {expression.evaluate({"a": a, "b": b}) for a in (0.0, 0.5, 3.0) for b in (0.0, 2.0)}
        assert values <= {0.0, 1.0}


def test_tables_have_checksums(everything):
    """A byte of the data changed, the length kept: found out when checksums are verified."""
    path = everything / "trials" / "000000.parquet"
    data = bytearray(path.read_bytes())
    column = pyarrow.parquet.ParquetFile(path).metadata.row_group(0).column(8)
    start = column.data_page_offset if column.dictionary_page_offset is None else column.dictionary_page_offset
    data[start + column.total_compressed_size - 3] ^= 0xFF
    damaged = everything.parent / "damaged.parquet"
    damaged.write_bytes(data)
    with pytest.raises(OSError, match="CRC"):
        pyarrow.parquet.ParquetFile(damaged, page_checksum_verification=True).read()
