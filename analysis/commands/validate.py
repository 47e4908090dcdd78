"""perilune validate: check FMUs, systems and parameter sets without flying them."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ..api.validate import validated
from ..common.targets import Results
from .common.exit_status import ExitStatus
from .common.options import check_json, system_options, tell


def run(options: argparse.Namespace) -> int:
    check_json(options)
    files = Results()
    results = validated(options.path, system_options(options))
    for result in results:
        for problem in result["problems"]:
            print(f"perilune: {problem}", file=sys.stderr)
    status = tell(results, options, lambda: _print(results), files)
    return ExitStatus.REFUSED if any(result["problems"] for result in results) else status


def _print(results: list[dict[str, Any]]) -> None:
    for result in results:
        for note in result["notes"]:
            print(f"{result['path']}: note: {note}")
        if not result["problems"]:
            print(f"{result['path']}: good")
