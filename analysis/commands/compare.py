"""perilune compare: variants of stored batches side by side, on the same trials."""

from __future__ import annotations

import argparse
import shlex
from pathlib import Path

from ..compare.side_by_side import compare
from ..reports.compare.page import write_comparison_page
from .options import add_json, write_json


def add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("result", nargs="+", type=Path, metavar="RESULT", help="a folder that batch --output wrote")
    parser.add_argument("--reference", metavar="VARIANT", help="put the others against this one; default: the first")
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")
    add_json(parser)


def run(options: argparse.Namespace) -> int:
    comparison = compare(options.result, options.reference)
    if options.report is not None:
        words = ["perilune", "compare", *map(str, options.result)]
        words += ["--reference", options.reference] if options.reference is not None else []
        write_comparison_page(comparison, options.report, shlex.join(words))
    if not write_json(comparison.document(), options.json):
        print(comparison.text())
    return 0
