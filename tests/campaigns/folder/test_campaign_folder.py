"""perilune.analysis.campaigns.folder.campaign_folder: all readers of a folder read its shards in the same way.

Truth: the written trials in memory; for damage, the rule that all readers refuse a file with the same message.
"""

import json
import shutil

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.campaigns.execute.loaded_campaign import read_folder
from perilune.analysis.campaigns.execute.store import ShardTable
from perilune.analysis.campaigns.folder.stored import read_batch
from perilune.analysis.show.opened_campaign import open_campaign
from perilune.common.errors import InputError
from tests.support.pages.comparison_samples import sample_batch, write_sample

TRIALS = 60  # shards of 25, 25 and 10


@pytest.fixture(scope="module")
def original(tmp_path_factory):
    folder = tmp_path_factory.mktemp("read") / "batch"
    write_sample(folder, trials=TRIALS)
    return folder


@pytest.fixture
def folder(original, tmp_path):
    """Return a copy that a test may damage."""
    return shutil.copytree(original, tmp_path / "batch")


def compared(folder):
    return {name: trials.metrics["miss"] for name, trials in read_batch(folder).variants.items()}


def opened(folder):
    results = perilune.open_results(folder)
    return {
        name: results.arrow(["metric.miss"], pyarrow.compute.field("variant") == name)["metric.miss"].to_numpy()
        for name in results.variants
    }


def displayed(folder):
    campaign = open_campaign(folder, lambda: False)
    column = campaign.read(["metric.miss"])["metric.miss"]
    return {name: column[campaign.variant_numbers == number] for number, name in enumerate(campaign.variants)}


def merged(folder):
    source = read_folder(folder)
    return {
        name: np.concatenate([source.read(shard, ["metric.miss"], name)["metric.miss"] for shard in source.shards])
        for name in source.variants
    }


READERS = [compared, opened, displayed, merged]
CHECKING = [compared, displayed, merged]  # `open_results` leaves the order of rows to whoever asks for columns


@pytest.mark.parametrize("read", READERS)
def test_every_reader_has_the_trials_that_were_written(original, read):
    actual = read(original)
    assert list(actual) == ["alpha", "beta", "gamma"]
    for name, trials in sample_batch(trials=TRIALS).trials.items():
        assert np.asarray(actual[name]).tobytes() == trials.metrics["miss"].tobytes()


def test_some_trials_of_a_folder_are_a_table(original):
    source = read_folder(original)
    stored = ShardTable(source, "beta", source.shards)
    written = sample_batch(trials=TRIALS).trials["beta"]
    some = stored.part(range(20, 55))  # of all three shards
    assert some.trial.tolist() == list(range(20, 55))
    assert some.metrics["miss"].tobytes() == written.metrics["miss"][20:55].tobytes()
    renumbered = stored.renumber(100)
    assert renumbered.trial.tolist() == list(range(100, 100 + TRIALS))
    assert renumbered.statuses == written.statuses


def rewrite(folder, change):
    """Rewrite the second shard with other rows or columns, its row groups and metadata as before."""
    path = folder / "trials" / "000001.parquet"
    table = pyarrow.parquet.read_table(path)
    changed = change(table)
    about = {**json.loads(table.schema.metadata[b"perilune"]), **json.loads(changed.schema.metadata.get(b"new", b"{}"))}
    pyarrow.parquet.write_table(
        changed.replace_schema_metadata({"perilune": json.dumps(about)}), path, row_group_size=changed.num_rows // 3
    )


def says(**about):
    return lambda table: table.replace_schema_metadata({"new": json.dumps(about)})


def with_column(name, make):
    return lambda table: table.set_column(table.column_names.index(name), name, pyarrow.array(make(table)))


SHARDS = {
    "none": (
        lambda folder: (folder / "trials" / "000001.parquet").unlink(),
        "not found; the trials from 25 on are missing",
    ),
    "another batch": (lambda folder: rewrite(folder, says(batch="x")), "belongs to another batch than summary.json"),
    "number": (lambda folder: rewrite(folder, says(shard=2)), "its metadata states another shard than its name"),
    "span": (lambda folder: rewrite(folder, says(trials=[3, 2])), "trials: does not state a valid range of trials"),
    "start": (lambda folder: rewrite(folder, says(trials=[26, 51])), "begins with trial 26, not 25"),
}
ROWS = {
    "order": (
        lambda table: table.take(np.arange(table.num_rows)[::-1]),
        "trial: the rows are not the trials 25 to 49 of",
    ),
    "numbers": (
        with_column("trial", lambda table: np.asarray(table["trial"]) + 1),
        "trial: the rows are not the trials 25",
    ),
    "variant": (
        with_column("variant", lambda table: ["alpha"] * table.num_rows),
        "variant: contains rows of a variant other than beta",
    ),
    "kind": (with_column("metric.miss", lambda table: ["x"] * table.num_rows), "metric.miss: not a column of numbers"),
}


@pytest.mark.parametrize("read", READERS)
@pytest.mark.parametrize("damage", SHARDS)
def test_every_reader_refuses_a_wrong_shard_in_the_same_words(folder, read, damage):
    spoil, words = SHARDS[damage]
    spoil(folder)
    with pytest.raises(InputError) as caught:
        read(folder)
    assert caught.value.file == str(folder / "trials" / "000001.parquet")
    assert words in str(caught.value)


@pytest.mark.parametrize("read", CHECKING)
@pytest.mark.parametrize("damage", ROWS)
def test_wrong_rows_are_refused_in_the_same_words(folder, read, damage):
    change, words = ROWS[damage]
    rewrite(folder, change)
    with pytest.raises(InputError) as caught:
        read(folder)
    assert caught.value.file == str(folder / "trials" / "000001.parquet")
    assert words in str(caught.value)


def test_statuses_that_are_numbers_are_refused_where_they_are_read(folder):
    rewrite(folder, with_column("status", lambda table: [1] * table.num_rows))
    with pytest.raises(InputError, match=r"000001\.parquet: status: not a column of texts"):
        compared(folder)
    assert len(displayed(folder)["beta"]) == TRIALS  # which reads no status here


def test_a_shard_replaced_after_it_was_found(folder):
    source = read_folder(folder)
    shard = source.shards[1]
    rewrite(folder, says(trials=[25, 49]))
    with pytest.raises(InputError, match=r"000001\.parquet: trials: changed since the campaign was opened"):
        source.read(shard, ["metric.miss"])


def test_traces_are_those_of_the_campaign(folder):
    source = read_folder(folder)
    traced = list(source.traces("beta"))
    assert traced == sorted(sample_batch(trials=TRIALS).trials["beta"].traces)
    path = source.traces("beta")[traced[0]]
    shutil.copy(source.traces("alpha")[traced[0]], path)  # of another variant
    assert list(source.traces("beta")) == traced[1:]
    assert source.trace("beta", traced[0]) is None
    assert source.trace("beta", TRIALS + 1) is None
