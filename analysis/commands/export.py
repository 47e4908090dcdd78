"""perilune export: an FMU, a system with its FMUs inside, or the blocks of a file, to fly here or elsewhere."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from ...fmus_src.export.compilers import PLATFORMS
from ...fmus_src.places import FLAVOURS
from ..api.export import export
from ..errors import InputError
from .common.options import add_json, check_json, write_json


def add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "name", metavar="SYSTEM|FMU|FILE.py", help="a system or its folder, a block's name, or a file with blocks"
    )
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


def run(options: argparse.Namespace) -> int:
    check_json(options)
    try:
        exported = export(options.name, platforms=options.platform, flavour=options.flavour, output=options.output)
    except InputError:
        raise
    except ValueError as error:  # what is wrong with a block, told by the export as one line
        print(f"perilune: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    if options.name.endswith(".py") and options.flavour is None and "native" not in exported.flavours:
        print("perilune: no C compiler here: the Python flavour only; pip install ziglang for both", file=sys.stderr)
    paths = [str(path) for path in exported.paths]
    document = {"paths": paths, "flavours": list(exported.flavours), "platforms": list(exported.platforms)}
    if not write_json(document, options.json):
        print("\n".join(paths))
    return 0
