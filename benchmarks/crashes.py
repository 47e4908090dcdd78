"""What processes of foreign FMUs cost, and what a crash in them: times of one run, side by side.

    python -m benchmarks.crashes

An FMU in C whose trial takes about a millisecond flies 200 trials, of which 20 end its process or none does.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from perilune.analysis.campaigns.fly.runner import run_batch
from perilune.analysis.campaigns.spec.plan import read_plan
from perilune.analysis.runtime.system.options import SystemOptions
from tests.support.foreign.odd_fmu import COUNTS, Call, Deed, odd_fmu

REPEATS = 5
STEP = 1e-4  # s, of 1 s


def main() -> None:
    """Print two tables: batches and runs."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        good = odd_fmu(folder, "good")
        bad = odd_fmu(folder, "bad", DEED=Deed.SEGFAULT, IN=Call.STEP, COUNTED=13)
        for fmu in (good, bad):
            (folder / f"{fmu.stem}.toml").write_text(COUNTS.format(name=fmu.stem, trials=200))
        print("| 200 trials, workers | in this process, s | in children, s | 20 of them crash, s | a crash, s |")
        print("|---|---|---|---|---|")
        for workers in (1, 2):
            here = batch(good, workers, in_process=True)
            apart, crashing = batch(good, workers), batch(bad, workers)
            crashes = crashing - apart
            print(f"| {workers} | {here:.3f} | {apart:.3f} | {crashing:.3f} | {crashes / 20:.4f} |", flush=True)
        print("\n| run | s |\n|---|---|")
        for text, options in (("in this process", ["--in-process"]), ("in a child", [])):
            print(f"| {text} | {statistics.median(run(good, options) for _ in range(REPEATS)):.3f} |", flush=True)


def batch(fmu: Path, workers: int, *, in_process: bool = False) -> float:
    """Median time (s) of a batch, the first one left out."""
    options = SystemOptions(stop_time=1.0, step=STEP, in_process=in_process)
    times = []
    for _ in range(REPEATS + 1):
        plan = read_plan(fmu, str(fmu.with_suffix(".toml")), options)
        begin = time.perf_counter()
        run_batch(plan, workers=workers)
        times.append(time.perf_counter() - begin)
    return statistics.median(times[1:])


def run(fmu: Path, options: list[str]) -> float:
    """Time (s) of the command."""
    begin = time.perf_counter()
    command = [sys.executable, "-m", "perilune", "run", str(fmu), "--stop-time", "1", *options]
    subprocess.run(command, check=True, capture_output=True)
    return time.perf_counter() - begin


if __name__ == "__main__":
    main()
