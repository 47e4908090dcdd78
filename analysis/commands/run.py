"""perilune run: one flight."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from ..batch.tables import faults_line
from ..flight.instances.log import Log
from ..flight.interruptible import StuckError, fly
from ..flight.results import Result
from ..flight.simulation import Simulation
from ..flight.statuses import status_lines
from ..reports.own.asked.declared import Figure
from ..reports.own.asked.reading import read_figures
from ..reports.own.asked.stages import Limits
from ..reports.own.limit_table import limit_lines
from ..system.prepared import prepare_system
from ..targets import PAGES, Results, check_file
from .common.in_flight import series, watch
from .common.options import check_json, faults, json_number, system_options, write_json
from .common.remarks import note_lines, say_stale
from .common.requirements import check_requirements, read_requirements

OUTPUT_SUFFIXES = (".csv", ".parquet")
REMEDIES = {
    "nonfinite": "see what drives it with --output F.csv",
    "interrupted": "what was flown until then is in the files",
    "timed_out": "what was flown until then is in the files; give it longer, or see what takes so long with --log",
}
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
            return 1
    final = {name: json_number(value) for name, value in result.final().items()}
    if not write_json(result.summary() | {"final": final}, options.json, files):
        end = f" at t = {result.time[-1]:g} s" if result.time.size else ""
        print(f"{prepared.archive.name}: {result.status}{end}, {result.time.size} rows")
        for limits in figures if result.time.size else ():
            if isinstance(limits, Limits):
                print("\n".join(limit_lines(limits, result)))
        for line in (*status_lines(prepared.network, result), *note_lines(prepared)):
            print(line)
        if injected:
            print(faults_line(injected))
    files.write(options.output, result.write)
    files.write(options.report, partial(_write_page, result, prepared.archive.name, figures))
    if options.json != "-":
        files.say()
    if not result.complete:
        remedy = REMEDIES.get(result.status, "see the FMU's message and its documentation")
        print(f"perilune: {prepared.network.file}: {' '.join(result.message.split())}; {remedy}", file=sys.stderr)
    last = {"time": result.time[-1:].tolist(), **{name: [value] for name, value in result.final().items()}}
    met = check_requirements(requirements, {name: float(value[0]) for name, value in last.items() if value})
    return 2 if files.failed else 0 if met and result.complete else 1


def _write_page(result: Result, system: str, figures: Sequence[Figure], path: Path) -> None:
    from ..reports.run.run_report import write_run_report  # and matplotlib, which takes half a second

    write_run_report(result, path, system, figures)
