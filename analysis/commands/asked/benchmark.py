"""The options of perilune benchmark."""

from __future__ import annotations

import argparse

from ..common.options import add_json


def add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--steps", type=int, default=2500, metavar="N", help="communication steps; default 2500")
    parser.add_argument("--repeats", type=int, default=5, metavar="N", help="runs of each; default 5")
    add_json(parser)
