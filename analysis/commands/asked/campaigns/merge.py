"""The options of perilune merge."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...common.options import add_json
from ...common.requirements import add_requirements
from .shard import add_folder


def add(parser: argparse.ArgumentParser) -> None:
    add_folder(parser)
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")
    add_requirements(parser, "the summary's numbers")
    add_json(parser)
