"""The options of perilune replay."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...common.in_flight import add_watch
from ...common.options import add_json
from ...common.requirements import add_requirements
from .shard import add_folder


def add(parser: argparse.ArgumentParser) -> None:
    add_folder(parser)
    parser.add_argument("trial", type=int, metavar="TRIAL", help="its number, the first is 0")
    parser.add_argument(
        "--configuration", metavar="NAME", help="the variant, needed where the campaign compares several"
    )
    add_watch(parser)
    parser.add_argument("--output", type=Path, metavar="F", help="write all signals to F.csv or F.parquet")
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")
    add_requirements(parser, "the last values of signals and of time, and of metrics")
    add_json(parser)
