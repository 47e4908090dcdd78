"""perilune benchmark: this loop beside other importers, on the same FMUs in one run."""

from __future__ import annotations

import argparse

from ..benchmark.measure import run_benchmark
from ..benchmark.table import benchmark_text
from .common.options import add_json, check_json, tell


def add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--steps", type=int, default=2500, metavar="N", help="communication steps; default 2500")
    parser.add_argument("--repeats", type=int, default=5, metavar="N", help="runs of each; default 5")
    add_json(parser)


def run(options: argparse.Namespace) -> int:
    check_json(options)
    document = run_benchmark(steps=options.steps, repeats=options.repeats)
    return tell(document, options, lambda: print(benchmark_text(document)))
