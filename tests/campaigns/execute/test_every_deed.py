"""Campaigns whose FMU misbehaves in a tenth of its trials, in every way: equal bytes for every way of simulation.

Truth: the same trials with an FMU that does not misbehave, and the FMU's source, which misbehaves if its count is 13.
`make test` covers one way of ending the process, `make long` all.
"""

from __future__ import annotations

import pyarrow.compute
import pyarrow.parquet
import pytest

from perilune.analysis.cli import main
from tests.support.campaigns.clusters import dask_cluster
from tests.support.campaigns.folders import bytes_of, killed_when, shards_in, started
from tests.support.foreign.odd_fmu import COUNTS, Call, Deed, odd_fmu
from tests.support.lengths import either

pytest.importorskip("distributed", reason="the extra cluster is not installed")
pytestmark = pytest.mark.flies
TRIALS = either(200, 75)
IN_A_STEP = "odd: on the way to t = 0.75 s: "
INITIALLY = "odd: in the initialisation: "
ENDS = {
    (Deed.SEGFAULT, Call.STEP): ("crashed", f"{IN_A_STEP}its process ended by SIGSEGV"),
    (Deed.ABORT, Call.STEP): ("crashed", f"{IN_A_STEP}its process ended by SIGABRT"),
    (Deed.OVERFLOW, Call.STEP): ("crashed", f"{IN_A_STEP}its process ended by SIGSEGV"),
    (Deed.EXIT_0, Call.STEP): ("crashed", f"{IN_A_STEP}its process ended with exit status 0"),
    (Deed.EXIT_1, Call.INITIALISATION): ("crashed", f"{INITIALLY}its process ended with exit status 1"),
    (Deed.EXIT_AT_ONCE, Call.STEP): ("crashed", f"{IN_A_STEP}its process ended with exit status 3"),
    (Deed.KILL_GROUP, Call.STEP): ("crashed", f"{IN_A_STEP}its process ended by SIGKILL"),
    (Deed.LEAVE_ORPHAN, Call.STEP): ("crashed", f"{IN_A_STEP}its process ended by SIGABRT"),
    (Deed.HANG, Call.STEP): ("hung", f"{IN_A_STEP}a call did not return for 0.5 s"),
    (Deed.HANG, Call.INITIALISATION): ("hung", f"{INITIALLY}a call did not return for 0.5 s"),
    (Deed.HANG_WITH_LOCK, Call.STEP): ("hung", f"{IN_A_STEP}a call did not return for 0.5 s"),
    (Deed.GROW, Call.STEP): ("out_of_memory", f"{IN_A_STEP}its process exceeded its memory limit"),
    (Deed.LOG_MILLION, Call.STEP): ("stop_time", ""),
}
TIMEOUT = {"hung": "0.5"}  # s, for a call; elsewhere 30


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    with dask_cluster(tmp_path_factory.mktemp("cluster")) as actual:
        yield actual


def words_for(folder, **quirks):
    """Return the words that name a campaign of a good FMU, or one with quirks."""
    folder.mkdir()
    (folder / "c.toml").write_text(COUNTS.format(name="odd", trials=TRIALS))
    return [str(odd_fmu(folder, **quirks)), "--campaign", str(folder / "c.toml"), "--step", "0.25", "--stop-time", "1"]


def rows_of(folder):
    return pyarrow.parquet.read_table(folder / "trials")


@pytest.mark.parametrize("deed_in", either(list(ENDS), [(Deed.SEGFAULT, Call.STEP)]), ids=str)
def test_the_same_however_simulated(cluster, tmp_path, deed_in):
    status, message = ENDS[deed_in]
    deed, call = deed_in
    good, words = words_for(tmp_path / "good"), words_for(tmp_path / "bad", DEED=deed, IN=call, COUNTED=13)
    words += ["--memory", "0.2", "--call-timeout", TIMEOUT.get(status, "30")]
    assert main(["batch", *good, "--output", str(tmp_path / "reference"), "--workers", "1"]) == 0
    one, expected = tmp_path / "one", int(status != "stop_time")
    assert main(["batch", *words, "--output", str(one), "--workers", "1"]) == expected

    rows, reference = rows_of(one), rows_of(tmp_path / "reference")
    is_bad = pyarrow.compute.equal(rows["draw.odd.count"], 13)
    assert 0 < pyarrow.compute.sum(is_bad).as_py() < TRIALS
    well = pyarrow.compute.invert(is_bad)
    assert rows.filter(well).equals(reference.filter(well))
    assert set(rows.filter(is_bad)["status"].to_pylist()) == {status}
    assert set(rows.filter(is_bad)["message"].to_pylist()) == {message}

    two = tmp_path / "two"
    assert main(["batch", *words, "--output", str(two), "--workers", "2"]) == expected
    on_dask = tmp_path / "dask"
    assert main(["batch", *words, "--output", str(on_dask), "--scheduler", cluster.address]) == expected
    shards = tmp_path / "shards"
    assert main(["prepare", *words, "--output", str(shards)]) == 0
    for part in ("1-2", "0", f"3-{TRIALS // 25 - 1}")[: either(3, 2)]:
        assert main(["shard", str(shards), part]) == expected
    assert main(["merge", str(shards)]) == expected
    resumed = tmp_path / "resumed"
    process = started("batch", *words, "--output", resumed, "--workers", "2")
    killed_when(process, lambda: shards_in(resumed) >= 1)
    process.communicate()
    assert main(["batch", *words, "--output", str(resumed), "--resume"]) == expected
    assert bytes_of(one) == bytes_of(two) == bytes_of(on_dask) == bytes_of(shards) == bytes_of(resumed)
