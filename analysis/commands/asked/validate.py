"""The options of perilune validate."""

from __future__ import annotations

import argparse

from ..common.completers import completed, systems_and_files
from ..common.options import add_json, add_system_options


def add(parser: argparse.ArgumentParser) -> None:
    path = parser.add_argument("path", nargs="+", metavar="PATH", help="a system, .ssp, .fmu, .ssv or campaign .toml")
    completed(path, systems_and_files)
    add_system_options(parser)
    add_json(parser)
