"""perilune run: one flight."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from ..batch.tables import faults_line
from ..errors import InputError
from ..flight.simulation import Simulation
from ..reports.own.asked.reading import read_figures
from ..reports.run.run_report import write_run_report
from ..system.prepared import prepare_system
from .options import add_faults, add_json, add_system, faults, json_number, system_options, write_json

HELP = "fly a system once"
OUTPUT_SUFFIXES = (".csv", ".parquet")


def add(parser: argparse.ArgumentParser) -> None:
    add_system(parser)
    add_faults(parser)
    parser.add_argument("--output", type=Path, metavar="F", help="write all signals to F.csv or F.parquet")
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")
    add_json(parser)


def run(options: argparse.Namespace) -> int:
    if options.output is not None and options.output.suffix not in OUTPUT_SUFFIXES:
        raise InputError("--output", str(options.output), "neither .csv nor .parquet", "end the name with one of them")
    prepared = prepare_system(options.system, system_options(options))
    figures = read_figures(prepared) if options.report is not None else []
    injected = faults(options)
    with Simulation(prepared, faults=injected) as simulation:
        result = simulation.fly()
    if options.output is not None:
        result.write(options.output)
    if options.report is not None:
        write_run_report(result, options.report, prepared.archive.name, figures)
    final = {name: json_number(value) for name, value in result.final().items()}
    if not write_json(result.summary() | {"final": final}, options.json):
        end = f" at t = {result.time[-1]:g} s" if result.time.size else ""
        print(f"{prepared.archive.name}: {result.status}{end}, {result.time.size} rows")
        if injected:
            print(faults_line(injected))
    if not result.complete:
        remedy = "see what drives it with --output F.csv" if result.status == "nonfinite" else "see the FMU's message"
        print(f"perilune: {prepared.network.file}: {' '.join(result.message.split())}; {remedy}", file=sys.stderr)
        return 1
    return 0
