"""Measurement of all contestants in turn: cost of a step, machine and versions."""

from __future__ import annotations

import platform
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from loky import cpu_count

from perilune.common.errors import InputError
from perilune.common.paths import SYSTEMS, shipped_fmu
from perilune.common.progress import progress_bar
from perilune.fmus_src.export.available import fmu_file
from perilune.fmus_src.export.ssp_package import list_fmus, pack_system

from .contestant import OURS, Contestant, ExchangeSystem, Unavailable, Values
from .contestants import CONTESTANTS
from .times import Times, compute_guaranteed_ratios, disagreements
from .worker import ROUNDS, Worker, WorkerError, trials_per_second

SYSTEM = "lunar_terminal_guidance"


def run_benchmark(
    steps: int = 2500, repeats: int = 5, contestants: Sequence[Contestant] = CONTESTANTS
) -> dict[str, Any]:
    """Measure the time per communication step of `SYSTEM` with every contestant.

    Each contestant has a separate process. In every repeat each contestant simulates one step and then ``steps`` steps;
    the difference of the times is the cost of steps without reading, instantiation and initialisation, which are stated
    separately. Raises InputError.
    """
    if steps < 2 or repeats < 1:
        raise InputError("benchmark", f"{steps} steps, {repeats} repeats", "too few", "give 2 and 1 at least")
    unavailable: dict[str, str] = {}
    trials: dict[str, dict[str, float]] = {}
    with tempfile.TemporaryDirectory(prefix="perilune_benchmark_") as folder:
        archives = _pack(Path(folder), contestants, unavailable)
        prepared = ExchangeSystem(next(iter(archives.values()))).prepared
        with _workers(archives, contestants, unavailable) as workers:
            times = _fly_in_turn(workers, contestants, steps, repeats, unavailable)
        for flavour, archive in archives.items():
            if OURS[flavour] in times:
                try:
                    trials[flavour] = trials_per_second(
                        archive, times[OURS[flavour]].step() * prepared.steps, min(ROUNDS, repeats)
                    )
                except (Unavailable, WorkerError) as reason:
                    unavailable[f"trials per second, {flavour} FMUs"] = str(reason)
    flavours = {each.name: each.flavour for each in contestants}
    return {
        "system": SYSTEM,
        "step": prepared.step,
        "steps": steps,
        "repeats": repeats,
        "microseconds_per_step": {name: 1e6 * each.step() for name, each in times.items()},
        "median_microseconds_per_step": {name: 1e6 * each.median_step() for name, each in times.items()},
        "milliseconds_to_start": {name: 1e3 * each.start() for name, each in times.items()},
        "ratios": {
            name: each.ratio(times[OURS[flavours[name]]])
            for name, each in times.items()
            if OURS[flavours[name]] in times
        },
        "promised_ratios": compute_guaranteed_ratios(times, trials),
        "trials_per_second": trials,
        "unavailable": unavailable,
        "what": {each.name: each.what for each in contestants},
        "flavours": flavours,
        "machine": machine(),
        "versions": versions(),
    }


def _pack(folder: Path, contestants: Sequence[Contestant], unavailable: dict[str, str]) -> dict[str, Path]:
    """Pack the system with the FMUs of each built flavour; add reasons for missing flavours to ``unavailable``."""
    archives: dict[str, Path] = {}
    for flavour in OURS:
        try:
            files = [fmu_file(Path(source).stem, flavour) for source in list_fmus(SYSTEMS / SYSTEM)]
            folders = [*dict.fromkeys(path.parent for path in files if path), shipped_fmu("x", flavour).parent]
            archives[flavour] = pack_system(SYSTEMS / SYSTEM, folders, folder / flavour)
        except ValueError as error:
            unavailable |= {each.name: str(error) for each in contestants if each.flavour == flavour}
    if not archives:
        raise InputError("benchmark", SYSTEM, "not all of its FMUs are built", "run build_fmus.py")
    return archives


@contextmanager
def _workers(
    archives: dict[str, Path], contestants: Sequence[Contestant], unavailable: dict[str, str]
) -> Iterator[dict[str, Worker]]:
    """Yield a worker for every available contestant; add reasons for missing contestants to ``unavailable``."""
    with ExitStack() as stack:
        workers: dict[str, Worker] = {}
        for contestant in contestants:
            if contestant.flavour in archives:
                try:
                    worker = Worker(contestant.name, archives[contestant.flavour])
                except (Unavailable, WorkerError) as reason:
                    unavailable[contestant.name] = str(reason)
                else:
                    workers[contestant.name] = stack.enter_context(worker)
        yield workers


def _fly_in_turn(
    workers: dict[str, Worker],
    contestants: Sequence[Contestant],
    steps: int,
    repeats: int,
    unavailable: dict[str, str],
) -> dict[str, Times]:
    """Return the times of every contestant, after a round that is not counted and compares final values."""
    final: dict[str, Values] = {}
    times = {name: Times(steps) for name in workers}
    with progress_bar(total=(repeats + 1) * len(workers), unit="run") as progress:
        for repeat in range(repeats + 1):
            for name, worker in workers.items():
                progress.update()
                if name in unavailable:
                    continue
                try:
                    short, long = worker.ask(steps=1), worker.ask(steps=steps)
                except (Unavailable, WorkerError) as reason:
                    unavailable[name] = str(reason)
                    continue
                if repeat == 0:
                    final[name] = long["values"]
                else:
                    times[name].add(short["seconds"], long["seconds"])
            if repeat == 0:
                unavailable |= disagreements(contestants, final)
    return {name: each for name, each in times.items() if name not in unavailable}


PACKAGES = ("perilune", "fmpy", "pythonfmu", "libcosimpy", "fmu-manipulation-toolbox", "numpy")


def machine() -> dict[str, str | int]:
    """Return the processor, the number of processors available to this process, and the operating system."""
    return {"processor": _processor(), "processors": cpu_count(), "system": platform.platform()}


def versions() -> dict[str, str]:
    """Return the versions of Python, of Perilune and of the other packages; "not installed" for missing ones."""
    by_package = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            by_package[package] = version(package)
        except PackageNotFoundError:
            by_package[package] = "not installed"
    return by_package


def _processor() -> str:
    path = Path("/proc/cpuinfo")
    if path.is_file():
        for line in path.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()
