"""perilune compare: variants of stored batches side by side, on the same trials."""

from __future__ import annotations

import argparse
import shlex

from ..campaigns.compare.side_by_side import compare
from ..common.targets import PAGES, Results, check_file
from ..reports.compare.page import write_comparison_page
from .common.exit_status import exit_status
from .common.options import check_json, write_json


def run(options: argparse.Namespace) -> int:
    check_file("--report", options.report, PAGES)
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
    return exit_status(files)
