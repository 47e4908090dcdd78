"""perilune run: one flight."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from ..campaigns.tables import faults_line
from ..common.targets import PAGES, Results, check_file
from ..reports.figures.declaration.figures import Figure
from ..reports.figures.declaration.reading import read_figures
from ..reports.figures.limits import limit_document
from ..runtime.flight.instances.log import Log
from ..runtime.flight.interruptible import StuckError, fly
from ..runtime.flight.results import Result
from ..runtime.flight.simulation import Simulation
from ..runtime.system.prepared import prepare_system
from .common.exit_status import ExitStatus, exit_status
from .common.flight import check_flight, flight_lines
from .common.in_flight import series, watch
from .common.options import check_json, faults, json_number, system_options, write_json
from .common.remarks import note_lines, say_stale
from .common.requirements import check_requirements, read_requirements

OUTPUT_SUFFIXES = (".csv", ".parquet")
STUCK = "nothing is written; see what it says with --log all, or give it longer"


def run(options: argparse.Namespace) -> int:
    check_file("--output", options.output, OUTPUT_SUFFIXES)
    check_file("--report", options.report, PAGES)
    check_json(options)
    files = Results()
    prepared = prepare_system(options.system, system_options(options), series=series(options))
    say_stale(options)
    figures = read_figures(prepared)
    injected = faults(options)
    asked = watch(options)
    log = None if asked.log is None else Log(asked.log)
    with Simulation(prepared, faults=injected, log=log) as simulation:
        requirements = read_requirements(options.require, [*simulation.signal_names, "time"])
        try:
            result = fly(simulation, asked.timeout)
        except StuckError as error:
            print(f"perilune: {prepared.network.file}: {error}; {STUCK}", file=sys.stderr)
            return ExitStatus.NOT_MET
    final = {name: json_number(value) for name, value in result.final().items()}
    document = result.summary() | {"limits": limit_document(figures, result), "final": final}
    if not write_json(document, options.json, files):
        print("\n".join([*flight_lines(prepared, figures, result), *note_lines(prepared)]))
        if injected:
            print(faults_line(injected))
    files.write(options.output, result.write)
    files.write(options.report, partial(write_page, result, prepared.archive.name, figures))
    if options.json != "-":
        files.say()
    finished = check_flight(prepared, figures, result)
    return exit_status(files, finished, check_requirements(requirements, last_values(result)))


def last_values(result: Result) -> dict[str, float]:
    """What requirements on one flight are about: the last values of signals and of time."""
    if not result.time.size:
        return {}
    return {"time": float(result.time[-1]), **{name: float(value) for name, value in result.final().items()}}


def write_page(result: Result, system: str, figures: Sequence[Figure], path: Path) -> None:
    """The page of one flight, which ``system`` heads."""
    from ..reports.flight.run_report import write_run_report  # and matplotlib, which takes half a second

    write_run_report(result, path, system, figures)
