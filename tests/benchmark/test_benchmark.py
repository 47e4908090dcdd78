"""The benchmark as a whole: everyone flies, everyone agrees, every promised number is there. No times are asserted."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import benchmarks.contestants
from benchmarks.contestants import CONTESTANTS
from perilune.analysis import cli
from perilune.analysis.benchmark import importers, worker
from perilune.analysis.benchmark.measure import run_benchmark
from perilune.analysis.benchmark.table import benchmark_text
from perilune.common.errors import InputError
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
def test_a_tiny_run_has_every_contestant_and_all_agree(
    fmus: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(worker, "SECONDS", 0.0)
    monkeypatch.setattr(worker, "LEAST", 4)
    monkeypatch.setattr(benchmarks.contestants, "CONTESTANTS", FLOWN)
    document = run_benchmark(steps=30, repeats=1, contestants="benchmarks.contestants")

    # Who does not agree with our loop on the values at the end, `fused_limit` to the last bit, is listed here.
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
def test_the_command_times_what_comes_with_the_package(fmus, capsys, monkeypatch):
    monkeypatch.setattr(worker, "SECONDS", 0.0)
    monkeypatch.setattr(worker, "LEAST", 4)
    assert cli.main(["benchmark", "--steps", "30", "--repeats", "1", "--json", "-"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["unavailable"] == {}
    assert list(document["microseconds_per_step"]) == [each.name for each in importers.CONTESTANTS]


@pytest.mark.parametrize(("steps", "repeats"), [(1, 5), (2500, 0)])
def test_too_few_steps_or_repeats_are_refused(steps: int, repeats: int) -> None:
    with pytest.raises(InputError, match="too few"):
        run_benchmark(steps=steps, repeats=repeats)


def test_an_unknown_system_is_refused() -> None:
    with pytest.raises(InputError, match="no such system"):
        run_benchmark("lunar_terminal_guidence")
