"""perilune new: a block or a system of one's own to start from."""

from __future__ import annotations

import argparse

from ..new.block import Written, block_slots, new_block
from ..new.system import new_system
from .common.options import add_json, check_json, tell

BLOCK, SYSTEM = "block", "system"
NAME = "small letters, digits and underscores"


def add(parser: argparse.ArgumentParser) -> None:
    kinds = parser.add_subparsers(dest="kind", required=True, metavar="KIND", parser_class=type(parser))
    words = "write NAME.py, a block that perilune export builds"
    block = kinds.add_parser(BLOCK, help=words, description=words)
    block.add_argument("name", metavar="NAME", help=NAME)
    slots = ", ".join(block_slots())
    block.add_argument("--slot", metavar="SLOT", help=f"what it is to fit into: {slots}; default: a plain block")
    add_json(block)
    words = "write the folder NAME: blocks, system, parameter sets, campaign"
    system = kinds.add_parser(SYSTEM, help=words, description=words)
    system.add_argument("name", metavar="NAME", help=NAME)
    add_json(system)


def run(options: argparse.Namespace) -> int:
    check_json(options)
    written = new_block(options.name, options.slot) if options.kind == BLOCK else new_system(options.name)
    document = {"paths": [path.as_posix() for path in written.paths], "next": written.commands}
    return tell(document, options, lambda: _print(written))


def _print(written: Written) -> None:
    print(f"written: {', '.join(map(str, written.paths))}")
    print("next:")
    for command in written.commands:
        print(f"  {command}")
