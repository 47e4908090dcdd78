"""The options of perilune export."""

from __future__ import annotations

import argparse
from pathlib import Path

from ....fmus_src.export.compilers import PLATFORMS
from ....fmus_src.paths import FLAVOURS
from ..common.completers import completed, systems_and_fmus
from ..common.options import add_json


def add(parser: argparse.ArgumentParser) -> None:
    name = parser.add_argument(
        "name",
        metavar="SYSTEM|FMU|BLOCK|FILE.py",
        help="a system or its folder, a block's name (of a .py file in this folder, too), or a file with blocks",
    )
    completed(name, systems_and_fmus)
    parser.add_argument(
        "--platform",
        action="append",
        choices=tuple(PLATFORMS),
        help="of native FMUs; may be repeated; default: those that come built, or that a compiler here serves",
    )
    parser.add_argument(
        "--flavour", choices=FLAVOURS, help="default: native; of FILE.py: both, as far as a compiler is here"
    )
    parser.add_argument(
        "--output", type=Path, metavar="F", help="default: NAME.fmu or NAME.ssp here; of FILE.py: in build/fmus"
    )
    add_json(parser)
