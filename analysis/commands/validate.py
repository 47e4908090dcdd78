"""perilune validate: check FMUs, systems and parameter sets without flying them."""

from __future__ import annotations

import argparse
import sys

from ..api.validate import validate
from .common.options import add_json, write_json


def add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("path", nargs="+", metavar="PATH", help="a system, .ssp, .fmu, .ssv or campaign .toml")
    add_json(parser)


def run(options: argparse.Namespace) -> int:
    results = validate(*options.path)
    silent = write_json(results, options.json)
    for result in results:
        for problem in result["problems"]:
            print(f"perilune: {problem}", file=sys.stderr)
        if not silent:
            for note in result["notes"]:
                print(f"{result['path']}: note: {note}")
            if not result["problems"]:
                print(f"{result['path']}: good")
    return 2 if any(result["problems"] for result in results) else 0
