"""The options of perilune compare."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..common.options import add_json


def add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("result", nargs="+", type=Path, metavar="RESULT", help="a folder that batch --output wrote")
    parser.add_argument("--reference", metavar="VARIANT", help="put the others against this one; default: the first")
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")
    add_json(parser)
