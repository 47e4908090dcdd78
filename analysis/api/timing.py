"""This loop beside other importers, timed."""

from __future__ import annotations

from typing import Any

from ..benchmark.measure import run_benchmark


def benchmark(*, steps: int = 2500, repeats: int = 5) -> dict[str, Any]:
    """Time a communication step against other importers on the same FMUs: `perilune benchmark`, as a dictionary."""
    return run_benchmark(steps=steps, repeats=repeats)
