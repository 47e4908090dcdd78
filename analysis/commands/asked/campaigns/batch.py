"""The options of perilune batch."""

from __future__ import annotations

import argparse
from pathlib import Path

from argcomplete.completers import FilesCompleter

from ...common.completers import campaigns, completed
from ...common.in_flight import add_input, add_watch
from ...common.options import add_faults, add_json, add_system
from ...common.requirements import add_requirements
from ...common.samples import add_held
from .shard import add_engine


def add(parser: argparse.ArgumentParser) -> None:
    add_system(parser, alone=True)
    add_faults(parser)
    add_input(parser)
    add_watch(parser)
    campaign = parser.add_argument(
        "--campaign", required=True, metavar="NAME", help="a campaign of the system, or a .toml file"
    )
    completed(campaign, campaigns)
    parser.add_argument("--trials", type=int, metavar="N", help="instead of the campaign's number")
    parser.add_argument("--seed", type=int, metavar="S", help="instead of the campaign's root seed")
    draws = parser.add_argument(
        "--draws", type=Path, metavar="F.parquet", help="fly these draws, a trial for each row, and draw none"
    )
    completed(draws, FilesCompleter(("parquet",)))
    parser.add_argument(
        "--compare", action="append", metavar="SLOT=A,B,C", help="fly these FMUs in a slot, on the same draws"
    )
    add_engine(parser)
    parser.add_argument("--output", type=Path, metavar="DIR", help="write the trials, their draws and a summary")
    parser.add_argument("--resume", action="store_true", help="go on with the campaign in --output DIR, or extend it")
    parser.add_argument(
        "--until-decided", action="store_true", help="end as soon as the campaign's requirements are met, or are not"
    )
    parser.add_argument(
        "--prepare", action="store_true", help="write what flies to --output DIR, for perilune shard, and fly nothing"
    )
    parser.add_argument("--replay", type=int, metavar="K", help="fly trial K only, with all signals to --output DIR")
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")
    parser.add_argument("--overwrite", action="store_true", help="put the results in place of those in --output DIR")
    parser.add_argument(
        "--sensitivity",
        type=int,
        metavar="N",
        help="Sobol' indices of the metrics instead: N times (draws + 2) flights, + 3 where noise is random, too; "
        "N a power of two",
    )
    add_held(parser)
    add_requirements(parser, "the summary's numbers")
    add_json(parser)
