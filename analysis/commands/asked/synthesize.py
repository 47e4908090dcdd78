"""The options of perilune synthesize."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..common.completers import completed, searches
from ..common.options import add_json

METHODS = ("network-operator",)


def add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("method", choices=METHODS, metavar="METHOD", help=f"one of: {', '.join(METHODS)}")
    file = parser.add_argument(
        "file", metavar="F.toml", help="a campaign with a table [network_operator]; by name of laws/searches, or a path"
    )
    completed(file, searches)
    parser.add_argument("--output", type=Path, metavar="DIR", help="write checkpoints, Pareto set and law to a folder")
    parser.add_argument("--seed", type=int, metavar="S", help="instead of the campaign's root seed")
    parser.add_argument("--workers", type=int, metavar="N", help="laws in flight together; default: one per processor")
    parser.add_argument("--resume", action="store_true", help="go on from the checkpoint in --output DIR")
    parser.add_argument(
        "--evaluations", type=int, metavar="N", help="end with the generation in which N laws have flown"
    )
    add_json(parser)
