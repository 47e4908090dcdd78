"""The options of perilune law."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..common.completers import completed, laws
from ..common.options import add_json


def add(parser: argparse.ArgumentParser) -> None:
    law = parser.add_argument("law", metavar="LAW", help="a law of laws/ by name, or the path of its .json file")
    completed(law, laws)
    parser.add_argument("--output", type=Path, metavar="F.ssv", help="write the parameter set that flies it")
    parser.add_argument("--component", metavar="NAME", help="the component it is for; default: guidance")
    parser.add_argument("--graph", type=Path, metavar="F.svg", help="draw its graph")
    add_json(parser)
