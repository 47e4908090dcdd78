"""perilune compare: variants of stored batches side by side, on the same trials."""

from __future__ import annotations

import argparse
import shlex
from pathlib import Path

from ..compare.side_by_side import compare
from ..reports.compare.page import write_comparison_page
from ..targets import Results, check_file
from .common.options import add_json, check_json, write_json


def add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("result", nargs="+", type=Path, metavar="RESULT", help="a folder that batch --output wrote")
    parser.add_argument("--reference", metavar="VARIANT", help="put the others against this one; default: the first")
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures")
    add_json(parser)


def run(options: argparse.Namespace) -> int:
    check_file("--report", options.report)
    check_json(options)
    comparison = compare(options.result, options.reference)
    files = Results()
    words = ["perilune", "compare", *map(str, options.result)]
    words += ["--reference", options.reference] if options.reference is not None else []
    files.write(options.report, lambda path: write_comparison_page(comparison, path, shlex.join(words)))
    if not write_json(comparison.document(), options.json, files):
        print(comparison.text())
    if options.json != "-":
        files.say()
    return 2 if files.failed else 0
