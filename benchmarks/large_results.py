"""Time and memory for a quantile, as a function of the number of trials in a campaign's folder.

    python -m benchmarks.large_results [TRIALS ...]

Each measurement runs in a separate process, which opens the folder and computes the 99.9 % quantile of a metric.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.support.campaigns.large_results import write_large

SIZES = (500_000, 1_000_000, 2_000_000, 4_000_000)
MEASURED = """
import json, resource, sys, time

import duckdb

import perilune

results = perilune.open_results(sys.argv[1])
results.columns
query = "SELECT quantile_disc(\\"metric.miss\\", 0.999) FROM read_parquet(?)"
ask = {
    "perilune": lambda: results.quantile("miss", 0.999),
    "duckdb": lambda: duckdb.execute(query, [sys.argv[1] + "/trials/*.parquet"]).fetchall()[0][0],
}[sys.argv[2]]
before, begin = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.perf_counter()
value = ask()
seconds = time.perf_counter() - begin
print(json.dumps([value, seconds, (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024]))
"""


def main(sizes: list[int]) -> None:
    """Print a row for each number of trials."""
    print("| trials | folder, MB | quantile, s | memory more, MB | DuckDB, s | memory more, MB |")
    print("|---|---|---|---|---|---|")
    for trials in sizes:
        with tempfile.TemporaryDirectory() as place:
            write_large(Path(place), trials)
            size = sum(path.stat().st_size for path in Path(place).rglob("*.parquet")) / 1e6
            (value, own, memory), (other, theirs, more) = (_asked(place, way) for way in ("perilune", "duckdb"))
        assert value == other
        print(f"| {trials} | {size:.0f} | {own:.1f} | {memory:.0f} | {theirs:.1f} | {more:.0f} |", flush=True)


def _asked(folder: str, way: str) -> list[float]:
    words = [sys.executable, "-c", MEASURED, folder, way]
    return list(json.loads(subprocess.run(words, capture_output=True, text=True, check=True).stdout))


if __name__ == "__main__":
    main([int(text) for text in sys.argv[1:]] or list(SIZES))
