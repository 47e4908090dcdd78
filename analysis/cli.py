"""The console command `perilune`. Exit status: 0 done, 1 the run or a requirement failed, 2 wrong input."""

from __future__ import annotations

import argparse
import importlib
import os
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

from .errors import InputError
from .process_end import leave

VERBS = ("list", "validate", "run", "batch", "compare", "law", "synthesize", "plan", "stability", "benchmark", "export")


class Parser(argparse.ArgumentParser):
    """argparse with errors on one line and options in full."""

    def __init__(self, **keywords: Any) -> None:
        super().__init__(**keywords, allow_abbrev=False)

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message}; see {self.prog} --help\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out one command; returns the exit status."""
    parser = Parser(prog="perilune", description="Spacecraft guidance, navigation and control as FMI components.")
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB", parser_class=Parser)
    modules = {verb: importlib.import_module(f".commands.{verb}", __package__) for verb in VERBS}
    for verb, module in modules.items():
        module.add(verbs.add_parser(verb, help=module.HELP, description=module.HELP))
    options = parser.parse_args(arguments)
    try:
        return modules[options.verb].run(options)
    except InputError as error:
        print(f"perilune: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("perilune: interrupted", file=sys.stderr)
        return 1
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except OSError as error:  # a file that cannot be read or written
        reason = f"{error.filename}: {error.strerror}" if error.filename else str(error)
        print(f"perilune: {reason}; give another path or mend this one", file=sys.stderr)
        return 2


def run() -> NoReturn:
    """The console script: `main`, then leave at once."""
    try:
        status = main()
    except SystemExit as stop:  # argparse's --help and errors
        status = stop.code if isinstance(stop.code, int) else 1
    leave(status)
