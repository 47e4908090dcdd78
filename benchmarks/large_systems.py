"""How time and memory grow with the size of a system: ten FMUs in rings, ten connections into each component.

    python -m benchmarks.large_systems [COMPONENTS ...]

Each size has a process of its own, which reads, checks and orders the system, instantiates its FMUs and flies one step.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tests.support.large_systems import WIDTH, build_mixers, large_system

SIZES = (1250, 2500, 5000, 10_000)
MEASURED = """
import json, resource, sys, time

begin = time.perf_counter()
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system

imported = time.perf_counter()
prepared = prepare_system(sys.argv[1], SystemOptions(step=0.1))
checked = time.perf_counter()
with Simulation(prepared) as simulation:
    started = time.perf_counter()
    simulation.fly()
memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
print(json.dumps([imported - begin, checked - imported, started - checked, memory]))
"""


def main(sizes: list[int]) -> None:
    """Print a row for each number of components."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        build_mixers(folder)
        print("| components | connections | read and checked, s | instantiated, s | whole process, s | MB |")
        print("|---|---|---|---|---|---|")
        for count in sizes:
            system = large_system(folder / f"large_{count}", folder / "native", count)
            begin = time.perf_counter()
            done = subprocess.run(
                [sys.executable, "-c", MEASURED, str(system)], capture_output=True, text=True, check=True
            )
            whole = time.perf_counter() - begin
            _, checked, started, memory = json.loads(done.stdout.splitlines()[-1])
            row = f"| {count} | {count * WIDTH} | {checked:.2f} | {started:.2f} | {whole:.2f} | {memory:.0f} |"
            print(row, flush=True)


if __name__ == "__main__":
    main([int(text) for text in sys.argv[1:]] or list(SIZES))
