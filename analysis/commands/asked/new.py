"""The options of perilune new."""

from __future__ import annotations

import argparse

from ...authoring.new.block import block_slots
from ..common.completers import completed
from ..common.options import add_json

BLOCK, SYSTEM = "block", "system"
NAME = "small letters, digits and underscores"


def add(parser: argparse.ArgumentParser) -> None:
    kinds = parser.add_subparsers(dest="kind", required=True, metavar="KIND", parser_class=type(parser))
    words = "write NAME.py, a block that perilune export builds"
    block = kinds.add_parser(BLOCK, help=words, description=words)
    block.add_argument("name", metavar="NAME", help=NAME)
    slots = ", ".join(block_slots())
    slot = block.add_argument("--slot", metavar="SLOT", help=f"what it is to fit into: {slots}; default: a plain block")
    completed(slot, lambda **_: block_slots())
    add_json(block)
    words = "write the folder NAME: blocks, system, parameter sets, campaign"
    system = kinds.add_parser(SYSTEM, help=words, description=words)
    system.add_argument("name", metavar="NAME", help=NAME)
    add_json(system)
