"""Time and memory as functions of the size of a system: rings with ten connections into each component.

    python -m benchmarks.large_systems [COMPONENTS ...]

Prints four tables: the time of a step of rings of ten different Perilune FMUs, interpreted and fused; the cost of
reading, checking, ordering and instantiating such a ring and simulating one step, in a process for each size; the time
of the command `perilune run` for rings of one foreign FMU, and the cost of each component beyond the smallest ring; and
the times of the commands `run` and `validate` for a foreign FMU with 10^5 variables.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.large_systems import WIDTH, build_mixers, foreign_mixer, large_system, wide_fmu

SIZES = (1250, 2500, 5000, 10_000)
STEPPED_SIZES = (11, 30, 100, 300)
STEPS, ROUNDS = 1000, 7
FOREIGN_SIZES = (1000, 3000, 10_000)
VARIABLES = 100_000
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


def main(sizes: list[int], foreign_sizes: list[int]) -> None:
    """Print a row for each number of components."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        build_mixers(folder)
        _print_steps(folder)
        _print_foreign(folder, foreign_sizes)
        _print_wide(folder)
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


def _print_steps(folder: Path) -> None:
    """Print the time of a step (us), and the time to compile it (s)."""
    print("| components | native, us a step | fused, us a step | compiled in, s |")
    print("|---|---|---|---|")
    for count in STEPPED_SIZES:
        system = large_system(folder / f"stepped_{count}", folder / "native", count)
        row = []
        for flavour in ("native", "fused"):
            prepared = prepare_system(system, SystemOptions(step=0.1, stop_time=0.1 * ROUNDS * STEPS, flavour=flavour))
            begin = time.perf_counter()
            with Simulation(prepared, requested=()) as simulation:
                compiled = time.perf_counter() - begin
                simulation.advance(-1, 0)
                row.append(1e6 * min(_seconds(simulation, first) for first in range(0, ROUNDS * STEPS, STEPS)) / STEPS)
        print(f"| {count} | {row[0]:.2f} | {row[1]:.2f} | {compiled:.1f} |", flush=True)
    print()


def _seconds(simulation: Simulation, first: int) -> float:
    begin = time.perf_counter()
    flight = simulation.advance(first, first + STEPS, every=STEPS)
    assert flight.complete, flight.message
    return time.perf_counter() - begin


def _print_foreign(folder: Path, sizes: list[int]) -> None:
    fmus = foreign_mixer(folder / "native", folder / "foreign")
    print("| components | `perilune run`, s | ms a component beyond the first row |")
    print("|---|---|---|")
    seconds: dict[int, float] = {}
    for count in sizes:
        system = large_system(folder / f"foreign_{count}", fmus, count)
        seconds[count] = _time("run", system)
        first = sizes[0]
        each = 1e3 * (seconds[count] - seconds[first]) / (count - first) if count > first else 0.0
        print(f"| {count} | {seconds[count]:.1f} | {f'{each:.2f}' if each else ''} |", flush=True)
    print()


def _print_wide(folder: Path) -> None:
    wide = wide_fmu(folder / "native", folder / "wide.fmu", VARIABLES)
    print("| variables | `perilune run`, s | `perilune validate`, s |")
    print("|---|---|---|")
    print(f"| {VARIABLES} | {_time('run', wide):.1f} | {_time('validate', wide):.1f} |\n", flush=True)


def _time(verb: str, path: Path) -> float:
    """Return the time (s) of a `perilune` command on a system or an FMU."""
    command = [Path(sys.executable).with_name("perilune"), verb, str(path), "--step", "0.1", "--stop-time", "0.1"]
    begin = time.perf_counter()
    subprocess.run(command, capture_output=True, check=True)
    return time.perf_counter() - begin


if __name__ == "__main__":
    chosen_sizes = [int(text) for text in sys.argv[1:]]
    main(chosen_sizes or list(SIZES), chosen_sizes or list(FOREIGN_SIZES))
