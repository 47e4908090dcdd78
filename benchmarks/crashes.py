"""Cost of processes for foreign FMUs, and of crashes in them, measured side by side in one run.

    python -m benchmarks.crashes

An FMU in C whose trial takes half a millisecond runs FEW and MANY trials; the difference of their times is the cost of
a trial without start-up. It also runs FEW trials in which one of ten trials ends its process.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.execute.runner import run_batch
from perilune.analysis.runtime.system.options import SystemOptions
from tests.support.foreign.odd_fmu import COUNTS, Call, Deed, odd_fmu

REPEATS = 5
FEW, MANY = 200, 2000
STEP = 1e-4  # s; a trial simulates 1 s


def main() -> None:
    """Print two tables: batches and runs."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        good = odd_fmu(folder, "good")
        bad = odd_fmu(folder, "bad", DEED=Deed.SEGFAULT, IN=Call.STEP, COUNTED=13)
        print("| workers | a trial here, ms | in a child, ms | start here, ms | of children, ms | a crash, ms |")
        print("|---|---|---|---|---|---|")
        for workers in (1, 2):
            (here, start_here), (apart, start_apart) = (costs(good, workers, in_process=each) for each in (True, False))
            crash = (batch(bad, workers, FEW) - batch(good, workers, FEW)) / (FEW / 10)
            columns = [f"{1e3 * here:.2f}", f"{1e3 * apart:.2f}"]
            columns += [f"{1e3 * value:.0f}" for value in (start_here, start_apart, crash)]
            print(f"| {workers} | {' | '.join(columns)} |", flush=True)
        print("\n| run | s |\n|---|---|")
        for text, options in (("in this process", ["--in-process"]), ("in a child", [])):
            print(f"| {text} | {statistics.median(run(good, options) for _ in range(REPEATS)):.3f} |", flush=True)


def costs(fmu: Path, workers: int, *, in_process: bool) -> tuple[float, float]:
    """Return the time (s) of a trial, and of the start-up of a batch."""
    few, many = (batch(fmu, workers, trials, in_process=in_process) for trials in (FEW, MANY))
    trial = (many - few) / (MANY - FEW)
    return trial, few - FEW * trial


def batch(fmu: Path, workers: int, trials: int, *, in_process: bool = False) -> float:
    """Return the median time (s) of batches of ``trials`` trials, without the first batch."""
    fmu.with_suffix(".toml").write_text(COUNTS.format(name=fmu.stem, trials=trials))
    options = SystemOptions(stop_time=1.0, step=STEP, in_process=in_process)
    times = []
    for _ in range(REPEATS + 1):
        plan = read_plan(fmu, str(fmu.with_suffix(".toml")), options)
        begin = time.perf_counter()
        run_batch(plan, workers=workers)
        times.append(time.perf_counter() - begin)
    return statistics.median(times[1:])


def run(fmu: Path, options: list[str]) -> float:
    """Run a command and return its time (s)."""
    begin = time.perf_counter()
    command = [sys.executable, "-m", "perilune", "run", str(fmu), "--stop-time", "1", *options]
    subprocess.run(command, check=True, capture_output=True)
    return time.perf_counter() - begin


if __name__ == "__main__":
    main()
