"""The options of perilune shard."""

from __future__ import annotations

import argparse
from pathlib import Path

from ....campaigns.fly.workers.engines import ENGINES


def add(parser: argparse.ArgumentParser) -> None:
    add_folder(parser)
    parser.add_argument("shards", nargs="+", metavar="K", help="numbers of shards, the first is 0; A-B: from A to B")
    add_engine(parser)


def add_folder(parser: argparse.ArgumentParser) -> None:
    """The folder of a campaign."""
    parser.add_argument("folder", type=Path, metavar="DIR", help="what perilune batch --output DIR has written")


def add_engine(parser: argparse.ArgumentParser) -> None:
    """How trials fly side by side."""
    parser.add_argument("--workers", type=int, metavar="N", help="flights in parallel; default: one per processor")
    parser.add_argument("--engine", choices=ENGINES, help="what flies in parallel; default: threads where FMUs can")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="fly on the workers of this dask scheduler instead")
