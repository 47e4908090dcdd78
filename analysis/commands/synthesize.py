"""perilune synthesize: a search for a control law."""

from __future__ import annotations

import argparse
import sys

from ..common.targets import Results, check_folder
from ..design.synthesis.synthesis import run_synthesis
from ..design.synthesis.synthesis_file import named_search, read_synthesis
from .common.exit_status import exit_status
from .common.options import check_json, tell


def run(options: argparse.Namespace) -> int:
    check_folder("--output", options.output, overwrite=options.resume, otherwise="--resume to go on")
    check_json(options)
    files = Results()
    result = run_synthesis(
        read_synthesis(named_search(options.file)),
        seed=options.seed,
        workers=options.workers,
        output=options.output,
        resume=options.resume,
        evaluations=options.evaluations,
    )
    if options.output is not None:
        files.written.append(options.output)
    tell(result.document(), options, lambda: print(result.text()), files)
    if not result.succeeded:
        print(f"perilune: {result.failure()}", file=sys.stderr)
    return exit_status(files, result.succeeded)
