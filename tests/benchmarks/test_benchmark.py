"""Complete benchmark: all importers run and agree, and every documented number is present; times are not asserted."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from benchmarks.importers import worker
from benchmarks.importers.__main__ import main
from benchmarks.importers.contestants import CONTESTANTS
from benchmarks.importers.measure import run_benchmark
from benchmarks.importers.table import benchmark_text
from perilune.common.paths import ROOT
from tests.support.interrupts import descendants, seconds_until_gone, started, wait_for
from tests.support.lengths import either

PROMISED_TIMES = {
    "fmpy_simulate_ssp",
    "fmpy_calls",
    "libcosim",
    "fmucontainer",
    "perilune_python",
    "perilune_native",
    "fused_limit",
}
PROMISED_RATIOS = {
    "perilune_native/fused_limit",
    "fmpy_simulate_ssp/perilune_native",
    "fmucontainer_native/perilune_native",
    "fmpy_simulate_ssp/perilune_python",
    "two_workers/one_worker_python",
    "two_workers/one_worker_native",
}


# All of them under `make long`, else those that something is promised of.
FLOWN = either(CONTESTANTS, [each for each in CONTESTANTS if each.name in {*PROMISED_TIMES, "fmucontainer_native"}])


@pytest.mark.slow
def test_a_tiny_run_has_every_contestant_and_all_agree(fmus: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(worker, "SECONDS", 0.0)
    monkeypatch.setattr(worker, "LEAST", 4)
    document = run_benchmark(steps=30, repeats=1, contestants=FLOWN)

    # A contestant whose final values differ from our loop's, `fused_limit` to the last bit, is listed here.
    assert document["unavailable"] == {}
    times = document["microseconds_per_step"]
    assert times.keys() >= PROMISED_TIMES
    assert list(times) == [each.name for each in FLOWN]
    assert document["median_microseconds_per_step"].keys() == times.keys()
    assert document["milliseconds_to_start"].keys() == times.keys()
    assert document["promised_ratios"].keys() == PROMISED_RATIOS
    assert {flavour: set(rates) for flavour, rates in document["trials_per_second"].items()} == {
        "python": {"1", "2"},
        "native": {"1", "2"},
    }
    first = {line.split()[0] for line in benchmark_text(document).splitlines() if line}  # names are parts of others
    assert {*times, *PROMISED_RATIOS} <= first


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
@pytest.mark.usefixtures("fmus")
def test_no_contestant_outlives_it(tmp_path: Path) -> None:
    """Truth: the operating system's list of its descendants, whose flights take minutes."""
    path = os.pathsep.join(filter(None, (str(ROOT), os.environ.get("PYTHONPATH"))))
    with started((), tmp_path, {"PYTHONPATH": path}, module="benchmarks.importers") as command:
        wait_for(command, lambda lines: any("importers.serve" in line for line in lines))
        family = descendants(command)
        command.kill()
        assert not seconds_until_gone(family, 30.0)[1]


@pytest.mark.parametrize(("steps", "repeats"), [(1, 5), (2500, 0)])
def test_too_few_steps_or_repeats_are_refused(
    steps: int, repeats: int, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", ["importers", "--steps", str(steps), "--repeats", str(repeats)])
    with pytest.raises(SystemExit) as stop:
        main()
    assert stop.value.code == 2
    assert capsys.readouterr().err == f"benchmark: {steps} steps, {repeats} repeats: too few; give 2 and 1 at least\n"
