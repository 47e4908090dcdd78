"""The options of perilune run."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..common.in_flight import add_input, add_watch
from ..common.options import add_faults, add_json, add_system
from ..common.requirements import add_requirements


def add(parser: argparse.ArgumentParser) -> None:
    add_system(parser, alone=True)
    add_faults(parser)
    add_input(parser)
    add_watch(parser)
    parser.add_argument("--output", type=Path, metavar="F", help="write all signals to F.csv or F.parquet")
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")
    add_requirements(parser, "the last values of signals and of time")
    add_json(parser)
