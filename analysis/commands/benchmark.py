"""perilune benchmark: this loop beside other importers, on the same FMUs in one run."""

from __future__ import annotations

import argparse

from ..benchmark.measure import run_benchmark
from ..benchmark.table import benchmark_text
from ..common.targets import Results
from .common.options import check_json, tell


def run(options: argparse.Namespace) -> int:
    check_json(options)
    files = Results()
    document = run_benchmark(steps=options.steps, repeats=options.repeats)
    return tell(document, options, lambda: print(benchmark_text(document)), files)
