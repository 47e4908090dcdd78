"""`perilune.benchmark` and `perilune benchmark`: a communication step, timed."""

from __future__ import annotations

from typing import Any, Unpack

from ..benchmark.measure import run_benchmark
from ..benchmark.table import benchmark_text
from .options.library import BENCHMARK, BenchmarkOptions
from .options.verb import verb
from .result import NoProblems


class Timings(NoProblems, dict[str, Any]):
    """Times by contestant, what they are ratios of, the machine and the versions, by key."""

    def lines(self) -> list[str]:
        """What `perilune benchmark` prints."""
        return benchmark_text(self).splitlines()

    def to_json(self) -> dict[str, object]:
        """The same for other programs."""
        return dict(self)


@verb(BENCHMARK)
def benchmark(**options: Unpack[BenchmarkOptions]) -> Timings:
    """Time a communication step against other importers on the same FMUs: `perilune benchmark`, as a dictionary.

    Raises InputError.
    """
    return Timings(run_benchmark(steps=options["steps"], repeats=options["repeats"]))
