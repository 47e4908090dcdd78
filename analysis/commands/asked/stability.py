"""The options of perilune stability."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..common.completers import campaigns, completed
from ..common.options import add_json, add_system


def add(parser: argparse.ArgumentParser) -> None:
    add_system(parser)
    parser.add_argument(
        "--loop",
        action="append",
        default=[],
        metavar="NAME",
        help="a loop that the SSD names, or COMPONENT.CONNECTOR to cut; default: all that the SSD names",
    )
    parser.add_argument(
        "--at",
        type=_times,
        default=(),
        metavar="T,...",
        help="times of the operating points, s; default: those that the SSD gives, of a cut 0",
    )
    campaign = parser.add_argument(
        "--campaign", metavar="NAME", help="disperse the margins over a campaign, by name or .toml"
    )
    completed(campaign, campaigns)
    parser.add_argument("--trials", type=int, metavar="N", help="fewer or more trials than the campaign says")
    parser.add_argument("--seed", type=int, metavar="S", help="another root seed than the campaign's")
    parser.add_argument("--draws", type=Path, metavar="F.parquet", help="these draws, a trial for each row")
    parser.add_argument("--trial", type=int, metavar="K", help="study the draws of one trial of the campaign instead")
    parser.add_argument(
        "--workers", type=int, metavar="N", help="points studied side by side; default: one per processor"
    )
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")
    parser.add_argument(
        "--data", type=Path, metavar="FOLDER", help="write loop responses and A, B, C, D for python-control and MATLAB"
    )
    add_json(parser)


def _times(text: str) -> tuple[float, ...]:
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not seconds, or several with commas between") from None
