"""Options of studies that choose a campaign's draws themselves: the campaign, what of it is held, its noise."""

from __future__ import annotations

import argparse
from pathlib import Path

from .completers import campaigns, completed
from .in_flight import add_input, add_watch
from .options import add_faults, add_system


def add_samples(parser: argparse.ArgumentParser) -> None:
    """System, campaign and what is held; read with `read_samples` and `held` of sample_plans."""
    add_system(parser, alone=True)
    add_faults(parser)
    add_input(parser)
    add_watch(parser)
    campaign = parser.add_argument(
        "--campaign", required=True, metavar="NAME", help="a campaign of the system, or a .toml file"
    )
    completed(campaign, campaigns)
    parser.add_argument(
        "--compare", action="append", metavar="SLOT=FMU", help="which FMU flies in a slot that the campaign compares"
    )
    add_held(parser)
    parser.add_argument("--seed", type=int, metavar="S", help="instead of the campaign's root seed")
    parser.add_argument("--workers", type=int, metavar="N", help="flights in parallel; default: one per processor")
    parser.add_argument("--overwrite", action="store_true", help="put the results in place of those in --output DIR")


def add_held(parser: argparse.ArgumentParser) -> None:
    """What does not vary; read with `held` of sample_plans."""
    parser.add_argument(
        "--hold",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="a draw that has one value in all flights; choices and grids need it",
    )
    parser.add_argument(
        "--noise-trial",
        type=int,
        metavar="K",
        help="all flights have the noise of trial K; default: the noise is random, too",
    )


def add_report(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")


def add_folder(parser: argparse.ArgumentParser, names: str) -> None:
    parser.add_argument("--output", type=Path, metavar="DIR", help=f"write {names}")
