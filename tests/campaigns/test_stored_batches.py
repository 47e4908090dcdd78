"""perilune.analysis.campaigns.folder.stored and side_by_side: reading, checks and comparison of stored batches.

Truth: the written batch in memory; the rule that a file that is missing, damaged or mixed from two batches is refused
in one line that names it.
"""

import json
import shutil
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest

from perilune.analysis.campaigns.compare.side_by_side import compare
from perilune.analysis.campaigns.folder.stored import read_batch
from perilune.common.errors import InputError
from tests.support.campaigns.folders import flip_bit
from tests.support.pages.comparison_samples import CAMPAIGN, sample_batch, write_sample


@pytest.fixture(scope="module")
def original(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stored") / "batch"
    write_sample(folder)
    return folder


@pytest.fixture
def folder(original, tmp_path):
    """Return a copy that a test may damage."""
    return shutil.copytree(original, tmp_path / "batch")


def test_what_was_written_is_read_back_to_the_bit(original):
    written, read = sample_batch(), read_batch(original)
    assert list(read.variants) == list(written.trials)
    assert read.provenance == json.loads(json.dumps(written.provenance))
    for variant, trials in written.trials.items():
        actual = read.variants[variant]
        assert actual.statuses == trials.statuses
        assert actual.success.tolist() == trials.success.tolist()
        for name, values in trials.metrics.items():
            assert actual.metrics[name].tobytes() == values.tobytes()
        for name, values in trials.final.items():
            assert actual.final[name].tobytes() == values.tobytes()
        assert read.traced[variant] == list(trials.traces)
        for trial, trace in trials.traces.items():
            assert {name: values.tobytes() for name, values in read.trace(variant, trial).items()} == {
                name: values.tobytes() for name, values in trace.items()
            }
    for name, values in written.plan.draws.columns.items():
        assert read.draws[name].tobytes() == values.tobytes()
    assert [metric.expression for metric in read.metrics] == [m.expression for m in written.plan.campaign.metrics]
    assert read.foreign_traces == 0


def test_some_signals_of_a_trace(original):
    read = read_batch(original)
    assert list(read.trace("beta", 3, ["ship.mass", "no.such"])) == ["time", "ship.mass"]


def rewrite(path, change):
    table = pyarrow.parquet.read_table(path)
    pyarrow.parquet.write_table(change(table), path)


def edit(path, change):
    document = json.loads(path.read_text())
    change(document)
    path.write_text(json.dumps(document))


def truncated(path):
    path.write_bytes(path.read_bytes()[:-100])


def without(name):
    return lambda table: table.drop_columns([name])


def other_numbers(name):
    def change(table):
        index = table.column_names.index(name)
        return table.set_column(index, name, pyarrow.array(np.asarray(table[name]) + 1.0))

    return change


def texts(name):
    def change(table):
        return table.set_column(table.column_names.index(name), name, pyarrow.array(["x"] * table.num_rows))

    return change


LAST = Path("trials", "000001.parquet")
DAMAGES = {
    "no summary": (lambda f: (f / "summary.json").unlink(), "summary.json: not found; give a folder"),
    "no trials": (lambda f: shutil.rmtree(f / "trials"), "trials: not found"),
    "no shard": (lambda f: (f / LAST).unlink(), "trials from 25 on are missing"),
    "no draws": (lambda f: (f / "draws.parquet").unlink(), "draws.parquet: not found"),
    "truncated": (lambda f: truncated(f / LAST), "000001.parquet: cannot be read as parquet"),
    "empty": (lambda f: (f / "draws.parquet").write_bytes(b""), "draws.parquet: cannot be read as parquet"),
    "flipped": (lambda f: flip_bit(f / LAST), "000001.parquet: cannot be read as parquet"),
    "flipped draws": (lambda f: flip_bit(f / "draws.parquet"), "draws.parquet: cannot be read as parquet"),
    "no JSON": (lambda f: (f / "summary.json").write_text("{"), "summary.json: not JSON"),
    "not UTF-8": (lambda f: (f / "summary.json").write_bytes(b"\xff"), "summary.json: not JSON"),
    "a list": (lambda f: (f / "summary.json").write_text("[]"), "summary.json: variants: missing"),
    "old": (lambda f: edit(f / "summary.json", lambda d: d.pop("signals")), "signals: missing; an older version"),
    "other seed": (lambda f: edit(f / "summary.json", lambda d: d.update(seed=8)), "belongs to another batch than"),
    "metadata": (
        lambda f: rewrite(f / LAST, lambda t: t.replace_schema_metadata({})),
        "000001.parquet: belongs to another batch than summary.json",
    ),
    "rate": (
        lambda f: edit(f / "summary.json", lambda d: d["variants"]["beta"].update(success_rate=0.5)),
        "variants.beta: its success rate differs from the trials in trials/",
    ),
    "variants": (
        lambda f: edit(f / "summary.json", lambda d: d["variants"].pop("beta")),
        "summary.json: variants: differ from the variants in trials/",
    ),
    "column": (lambda f: rewrite(f / LAST, without("metric.miss")), "metric.miss: no such column"),
    "status": (lambda f: rewrite(f / LAST, without("status")), "status: no such column"),
    "texts": (lambda f: rewrite(f / LAST, texts("metric.miss")), "metric.miss: not a column of numbers"),
    "draws": (lambda f: rewrite(f / "draws.parquet", other_numbers("offset")), "its samples differ from draws"),
    "draw": (lambda f: rewrite(f / "draws.parquet", lambda t: t.append_column("x", t["offset"])), "draw.x: no such"),
    "rows": (lambda f: rewrite(f / "draws.parquet", lambda t: t.slice(1)), "its samples differ from draws"),
    "trial": (lambda f: rewrite(f / "draws.parquet", without("trial")), "its samples differ from draws"),
    "trace": (lambda f: truncated(f / "traces" / "beta" / "000002.parquet"), "000002.parquet: cannot be read"),
}  # fmt: skip


@pytest.mark.parametrize("damage", DAMAGES)
def test_what_is_damaged_is_refused_in_one_line(folder, damage):
    spoil, says = DAMAGES[damage]
    spoil(folder)
    with pytest.raises(InputError) as caught:
        read_batch(folder)
    assert says in str(caught.value)
    assert str(folder) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_damaged_trace_is_found_out_when_it_is_read(folder):
    flip_bit(folder / "traces" / "beta" / "000002.parquet")
    read = read_batch(folder)
    with pytest.raises(InputError, match=r"000002\.parquet: cannot be read as parquet"):
        read.trace("beta", 2)


def test_traces_of_an_earlier_batch_are_left_out_and_told(folder):
    write_sample(folder, traced=5)
    read = read_batch(folder)
    assert read.traced == {variant: [0, 1, 2, 3, 4] for variant in ("alpha", "beta", "gamma")}
    assert read.foreign_traces == 3 * 7
    assert compare([folder]).notes == ("batch contains 21 traces of another batch, which are omitted",)
    shutil.copy(folder / "traces/alpha/000001.parquet", folder / "traces/alpha/000030.parquet")
    assert 30 not in read_batch(folder).traced["alpha"]


def test_a_variant_named_by_a_path_keeps_its_traces_in_the_folder(tmp_path):
    write_sample(tmp_path / "out", variants=("/tmp/a.fmu", "b"))
    assert sorted(path.name for path in (tmp_path / "out" / "traces").iterdir()) == ["_tmp_a.fmu", "b"]
    read = read_batch(tmp_path / "out")
    assert len(read.traced["/tmp/a.fmu"]) == 12


def test_several_batches_are_put_side_by_side(original, tmp_path):
    write_sample(tmp_path / "loud", noise=2.0)
    actual = compare([original, tmp_path / "loud"])
    assert list(actual.contenders) == [f"{f}: {v}" for f in ("batch", "loud") for v in ("alpha", "beta", "gamma")]
    assert actual.notes == ()
    assert list(actual.batches) == ["batch", "loud"]
    assert actual.reference == "alpha"
    pairs = set(actual.pairs)
    assert ("loud: beta", "batch: beta") in pairs
    assert ("loud: beta", "loud: alpha") in pairs
    assert not any({a, b} == {"loud: beta", "batch: alpha"} for a, b in pairs)  # differ in two things
    assert len(pairs) == 3 + 3 + 3
    first = {pair for pair in pairs if actual.against_reference(pair)}
    assert len(first) == 2 + 2 + 3


def test_one_variant_in_several_batches_is_called_by_its_folder(tmp_path):
    for name in ("a/out", "b/out"):
        write_sample(tmp_path / name, variants=("default",))
    assert list(compare([tmp_path / "a/out", tmp_path / "b/out"]).contenders) == ["a/out", "b/out"]


def test_the_reference_is_b(original):
    actual = compare([original], "gamma")
    assert set(actual.pairs) == {("alpha", "gamma"), ("beta", "gamma"), ("beta", "alpha")}
    assert [actual.against_reference(pair) for pair in actual.pairs].count(True) == 2


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"seed": 8}, "draws: the samples of offset differ from those in"),
        ({"trials": 39}, "draws: 39 trials, 40 in"),
        (
            {"text": CAMPAIGN.replace("[draw.offset]", "[draw.shift]")},
            "draws: only one of this folder and",
        ),
        ({"text": CAMPAIGN.replace('unit = "kg"', 'unit = "t"')}, "metric propellant: its unit is t, but kg in"),
    ],
)
def test_what_cannot_be_compared_is_refused_in_one_line(original, tmp_path, options, says):
    write_sample(tmp_path / "other", **options)
    with pytest.raises(InputError) as caught:
        compare([original, tmp_path / "other"])
    assert says in str(caught.value)
    assert "\n" not in str(caught.value)


def test_other_refusals(original, tmp_path):
    with pytest.raises(InputError, match=r"given twice; give each folder once"):
        compare([original, original.parent / "." / original.name])
    with pytest.raises(InputError, match=r"reference: delta: no such variant; use one of beta, alpha, gamma"):
        compare([original], "delta")
    with pytest.raises(InputError, match=r"summary\.json: not found"):
        compare([tmp_path / "nothing"])
    (tmp_path / "file").write_text("x")
    with pytest.raises(InputError, match=r"summary\.json: not found"):
        compare([tmp_path / "file"])


def test_differences_that_matter_are_noted(original, tmp_path):
    text = CAMPAIGN.replace("miss <= 3", "miss <= 2").replace('"ship.tilt"', '"2 * ship.tilt"')
    write_sample(tmp_path / "other", text=text)
    assert compare([original, tmp_path / "other"]).notes == (
        "batch and other define success differently: miss <= 3 and miss <= 2",
        "batch and other define the metric tilt differently",
    )


def test_rates_are_what_is_true_or_false(original, tmp_path):
    names = lambda actual: [None if rate is None else rate.name for rate in actual.rates]  # noqa: E731
    assert names(compare([original])) == [None, "pinpoint"]
    # by its values where the expression does not say so; a number that happens to be 0 in every trial is none
    text = CAMPAIGN.replace('"ship.position[1] < 12 and ship.position[1] > 8"', '"ship.position[1]"')
    write_sample(tmp_path / "values", text=text)
    assert names(compare([tmp_path / "values"])) == [None, "pinpoint"]
    write_sample(tmp_path / "zero", text=text, noise=1e-9)
    assert names(compare([tmp_path / "zero"])) == [None]
    write_sample(tmp_path / "true", noise=1e-9)
    actual = compare([tmp_path / "true"])
    assert names(actual) == [None, "pinpoint"]
    assert actual.summary["beta"].rates["pinpoint"].count == 40


def test_a_metric_that_only_one_batch_has(original, tmp_path):
    cut = CAMPAIGN[: CAMPAIGN.index("[metric.tilt]")] + CAMPAIGN[CAMPAIGN.index("[metric.pinpoint]") :]
    write_sample(tmp_path / "fewer", text=cut)
    actual = compare([tmp_path / "fewer", original])
    assert [metric.name for metric in actual.metrics] == ["miss", "propellant", "x_error_over_sigma", "tilt"]
    assert np.all(np.isnan(actual.values("fewer: alpha", "tilt")))
    assert actual.summary["fewer: alpha"].metrics["tilt"].count == 0
