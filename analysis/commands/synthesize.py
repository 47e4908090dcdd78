"""perilune synthesize: a search for a control law."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from ..synthesis.synthesis import run_synthesis
from ..synthesis.synthesis_file import named_search, read_synthesis
from .common.options import add_json, check_json, tell
from .common.targets import Results, check_folder

METHODS = ("network-operator",)


def add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("method", choices=METHODS, metavar="METHOD", help=f"one of: {', '.join(METHODS)}")
    parser.add_argument(
        "file", metavar="F.toml", help="a campaign with a table [network_operator]; by name of laws/searches, or a path"
    )
    parser.add_argument("--output", type=Path, metavar="DIR", help="write checkpoints, Pareto set and law to a folder")
    parser.add_argument("--seed", type=int, metavar="S", help="instead of the campaign's root seed")
    parser.add_argument("--workers", type=int, metavar="N", help="laws in flight together; default: one per processor")
    parser.add_argument("--resume", action="store_true", help="go on from the checkpoint in --output DIR")
    parser.add_argument(
        "--evaluations", type=int, metavar="N", help="end with the generation in which N laws have flown"
    )
    add_json(parser)


def run(options: argparse.Namespace) -> int:
    check_folder("--output", options.output, overwrite=options.resume, otherwise="--resume to go on")
    check_json(options)
    result = run_synthesis(
        read_synthesis(named_search(options.file)),
        seed=options.seed,
        workers=options.workers,
        output=options.output,
        resume=options.resume,
        evaluations=options.evaluations,
    )
    files = Results()
    if options.output is not None:
        files.written.append(options.output)
    status = tell(result.document(), options, lambda: print(result.text()), files)
    if not result.succeeded:
        print(f"perilune: {result.failure()}", file=sys.stderr)
    return status or int(not result.succeeded)
