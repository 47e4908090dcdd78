"""Time per communication step of every importer: `python -m benchmarks.importers`, after build_fmus.py."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from perilune.common.errors import ExitStatus, InputError

from .measure import run_benchmark
from .table import benchmark_text


def main() -> None:
    """Print the table, and write its JSON document."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=2500, help="communication steps of a simulation")
    parser.add_argument("--repeats", type=int, default=5, help="simulations that are timed")
    parser.add_argument("--json", type=Path, help="file of the JSON document")
    options = parser.parse_args()
    try:
        document = run_benchmark(steps=options.steps, repeats=options.repeats)
    except InputError as error:
        parser.exit(ExitStatus.REFUSED, f"{error}\n")
    print(benchmark_text(document))
    if options.json is not None:
        options.json.write_text(json.dumps(document, indent=2), encoding="utf-8")


if __name__ == "__main__":
    main()
