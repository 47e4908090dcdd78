"""perilune.open_results: complete and incomplete campaign folders.

Truth: the written batch in memory, numpy's quantiles, the summary of the batch; the rule that a file that is missing,
damaged or from another campaign is refused in one line that names it.
"""

import json
import shutil

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest
from pyarrow.compute import field

import perilune
from perilune.analysis.cli import main
from tests.support.campaigns.folders import flip_bit
from tests.support.campaigns.large_results import write_large
from tests.support.pages.comparison_samples import sample_batch, write_sample

TRIALS = 60  # shards of 25, 25 and 10
SYSTEM = "lunar_terminal_guidance"


@pytest.fixture(scope="module")
def original(tmp_path_factory):
    folder = tmp_path_factory.mktemp("opened") / "batch"
    write_sample(folder, trials=TRIALS)
    return folder


@pytest.fixture
def folder(original, tmp_path):
    """Return a copy that a test may damage."""
    return shutil.copytree(original, tmp_path / "batch")


@pytest.fixture(scope="module")
def written():
    return sample_batch(trials=TRIALS)


def rows(table):
    return table.sort_by([("variant", "ascending"), ("trial", "ascending")]).to_pylist()


def shard(folder, number):
    return folder / "trials" / f"{number:06d}.parquet"


def test_all_trials_come_as_they_were_written(original, written):
    results = perilune.open_results(original)
    assert rows(results.arrow()) == rows(written.table())
    assert (results.trials, results.flown) == (TRIALS, TRIALS)
    assert results.variants == ["alpha", "beta", "gamma"]
    assert results.provenance == json.loads(json.dumps(written.provenance))
    assert repr(results) == "StoredResults(ship, 60 trials: alpha, beta, gamma)"
    assert results.to_pandas().shape == (3 * TRIALS, len(written.table().column_names))
    assert list(results.to_pandas(["trial", "metric.miss"])) == ["trial", "metric.miss"]


def test_some_columns_and_some_rows(original, written):
    results = perilune.open_results(original)
    actual = results.arrow(["variant", "trial"], where=(field("metric.miss") > 3) & (field("variant") == "beta"))
    miss = written.trials["beta"].metrics["miss"]
    assert actual.column("trial").to_pylist() == np.flatnonzero(miss > 3).tolist()
    assert results.dataset.count_rows() == 3 * TRIALS


def test_units_and_meanings(original, written):
    columns = perilune.open_results(original).columns
    assert list(columns) == written.table().column_names
    assert columns["metric.miss"] == ("m", "how far off")
    assert columns["metric.tilt"] == ("rad", "max of ship.tilt")
    assert columns["final.ship.mass"] == ("kg", "last value of ship.mass")
    assert columns["end_time"].unit == "s"
    assert "offset" in columns["draw.offset"].meaning
    assert columns["success"].meaning == "whether miss <= 3"
    schema = perilune.open_results(original).arrow(["metric.miss", "status"]).schema
    assert schema.field("metric.miss").metadata == {b"unit": b"m"}
    assert schema.field("status").metadata is None


def test_batches_are_all_of_it_in_little_memory(tmp_path):
    write_large(tmp_path, 150_000)
    results = perilune.open_results(tmp_path)
    size = results.arrow().nbytes
    before, maximum, actual = pyarrow.total_allocated_bytes(), 0, []
    for part in results.batches():
        actual += part.column("trial").to_pylist()
        maximum = max(maximum, pyarrow.total_allocated_bytes() - before)
    assert actual == list(range(150_000))
    assert maximum < size / 2


@pytest.mark.parametrize("share", [0.0, 0.05, 0.5, 0.99, 0.999, 1.0])
def test_quantiles(original, written, share):
    results = perilune.open_results(original)
    for variant, trials in written.trials.items():
        for metric, values in trials.metrics.items():
            expected = np.quantile(values, share, method="inverted_cdf")
            assert results.quantile(metric, share, variant) == expected
        good = trials.metrics["miss"][trials.success]
        assert results.quantile("miss", share, variant, where=field("success")) == np.quantile(
            good, share, method="inverted_cdf"
        )


def test_quantiles_are_those_of_the_summary(original):
    results = perilune.open_results(original)
    for variant, entry in json.loads((original / "summary.json").read_text())["variants"].items():
        for metric, actual in entry["metrics_all"].items():
            assert results.quantile(metric, 0.99, variant) == actual["p99"]
            assert results.quantile(metric, 0.99, variant, where=field("success")) == entry["metrics"][metric]["p99"]


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda results: results.arrow(["metric.mis"]), "no column metric.mis; the nearest of 19 known names"),
        (lambda results: list(results.batches(["metric.mis"])), "no column metric.mis"),
        (lambda results: results.to_pandas(["mis"]), "no column mis"),
        (lambda results: results.arrow(where=field("metric.mis") > 1), "no column metric.mis; the nearest"),
        (lambda results: results.quantile("mis", 0.5, "alpha"), "no metric mis; use one of miss"),
        (lambda results: results.quantile("miss", 0.5, "alfa"), "no variant alfa; use one of alpha"),
        (lambda results: results.quantile("miss", 0.5), "several variants; name one of alpha, beta, gamma"),
        (lambda results: results.traces("alfa"), "no variant alfa"),
    ],
)  # fmt: skip
def test_what_there_is_not(original, ask, words):
    with pytest.raises(KeyError, match=words):
        ask(perilune.open_results(original))


def damage_data(folder):
    flip_bit(shard(folder, 1))
    return "cannot be read as parquet"


def cut_off(folder):
    shard(folder, 1).write_bytes(shard(folder, 1).read_bytes()[:-20])
    return "cannot be read as parquet"


def of_another(folder):
    write_sample(folder.parent / "other", trials=TRIALS, seed=8)
    shutil.copy(shard(folder.parent / "other", 1), shard(folder, 1))
    return "belongs to another batch than summary.json"


def renamed(folder):
    shutil.copy(shard(folder, 2), shard(folder, 1))
    return "its metadata states another shard than its name"


@pytest.mark.parametrize("harm", [damage_data, cut_off, of_another, renamed])
@pytest.mark.parametrize("ask", [lambda results: results.arrow(), lambda results: list(results.batches())])
def test_a_wrong_shard_is_named_when_it_is_read(folder, harm, ask):
    words = harm(folder)
    results = perilune.open_results(folder)  # nothing of the trials is read yet
    with pytest.raises(perilune.InputError) as caught:
        ask(results)
    assert caught.value.file == str(shard(folder, 1))
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["trials", "traces", "traces/beta"])
def test_a_linked_folder_is_refused_by_all_readers(folder, tmp_path, name):
    (folder / name).rename(tmp_path / "elsewhere")
    (folder / name).symlink_to(tmp_path / "elsewhere")
    for ask in (perilune.open_results, perilune.compare):
        with pytest.raises(perilune.InputError, match=f"{name}: a link, not a folder"):
            ask(folder)


def test_a_metric_that_the_campaign_does_not_declare_is_named(folder):
    table = pyarrow.parquet.read_table(shard(folder, 0))
    other = table.append_column("metric.other", pyarrow.array(np.zeros(table.num_rows)))
    pyarrow.parquet.write_table(other, shard(folder, 0))
    with pytest.raises(perilune.InputError, match=r"000000\.parquet: metric\.other: not a metric of the campaign"):
        _ = perilune.open_results(folder).columns


def test_what_is_no_folder_of_results(folder, tmp_path):
    shard(folder, 1).unlink()
    with pytest.raises(perilune.InputError, match="trials from 25 on are missing"):
        perilune.open_results(folder).arrow()
    with pytest.raises(perilune.InputError, match="give a folder that perilune batch or prepare wrote"):
        perilune.open_results(tmp_path)
    (folder / "summary.json").write_text("{")
    with pytest.raises(perilune.InputError, match="not JSON"):
        perilune.open_results(folder)


@pytest.mark.parametrize(("module", "ask"), [("pandas", "to_pandas"), ("xarray", "traces")])
def test_what_is_not_installed_is_named_with_its_extra(original, monkeypatch, module, ask):
    for place in ("runtime.flight.results", "campaigns.folder.traces"):
        monkeypatch.setattr(f"perilune.analysis.{place}.find_spec", lambda name: None if name == module else name)
    words = {"to_pandas": [], "traces": ["alpha"]}[ask]
    with pytest.raises(
        ImportError, match=rf"needs {module}, which is not installed; pip install 'perilune\[notebook\]'"
    ):
        getattr(perilune.open_results(original), ask)(*words)


def test_a_notebook_shows_columns(original):
    text = perilune.open_results(original)._repr_html_()
    assert "60 of 60 trials of alpha, beta, gamma" in text
    assert "metric.miss" not in text or "how far off" in text


def test_a_campaign_that_flies(fmus, tmp_path):
    folder = tmp_path / "flying"
    words = ["--compare", "guidance=analytic_guidance", "--trials", "60"]
    assert main(["prepare", SYSTEM, "--campaign", "paper", *words, "--output", str(folder)]) == 0
    nothing = perilune.open_results(folder)
    assert (nothing.trials, nothing.flown) == (60, 0)
    with pytest.raises(perilune.InputError, match="no shard is complete yet"):
        nothing.arrow()
    with pytest.raises(perilune.InputError, match=r"shard: 0-1: a text, not a list of shards; give \['0-1'\]"):
        perilune.shard(folder, "0-1")
    perilune.shard(folder, [0, 2])
    results = perilune.open_results(folder)
    assert repr(results) == f"StoredResults({SYSTEM}, 35 of 60 trials: analytic_guidance)"
    assert results.arrow(["trial"]).column(0).to_pylist() == [*range(25), *range(50, 60)]
    perilune.shard(folder, [1])
    assert results.arrow().num_rows == 35  # as it was when it was opened
    whole = perilune.merge(folder)
    opened = perilune.open_results(folder)
    assert rows(opened.arrow()) == rows(whole.table())
    assert opened.columns == results.columns
    assert opened.provenance == json.loads(json.dumps(results.provenance))
    part = whole.table().filter((field("trial") < 25) | (field("trial") >= 50))
    expected = np.quantile(part.column("metric.position_error").to_numpy(), 0.9, method="inverted_cdf")
    assert results.quantile("position_error", 0.9) == expected
