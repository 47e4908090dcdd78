"""The options of perilune describe."""

from __future__ import annotations

import argparse

from ..common.completers import completed, systems_and_fmus
from ..common.options import add_json, add_system_options


def add(parser: argparse.ArgumentParser) -> None:
    what = parser.add_argument(
        "what", metavar="SYSTEM|FMU|SLOT", help="a system, an FMU by its name or file, or an interface"
    )
    completed(what, systems_and_fmus)
    parser.add_argument("component", nargs="?", metavar="COMPONENT", help="of a system: this component with all it has")
    add_system_options(parser)
    add_json(parser)
