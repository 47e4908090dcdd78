"""The console command `perilune`; its exit status is one of `ExitStatus`."""

from __future__ import annotations

import argparse
import importlib
import os
import shutil
import sys
import textwrap
from collections.abc import Sequence
from importlib.metadata import version
from types import ModuleType
from typing import Any, NoReturn

import argcomplete

from .common.errors import EndedError, InputError, UnwrittenError, call_by_flags, warn_in_one_line
from .common.exit_status import ExitStatus
from .common.process_end import leave
from .common.streams import steady_streams
from .examples import EXAMPLES
from .verbs.options.parsing import add_verb, flags_of, read_parsed
from .verbs.options.verb import Verb
from .verbs.options.verbs import VERBS as DECLARED

HELP_ALL = "--help-all"
WIDEST = 100  # columns of any output
VERBS = {
    "list": "list systems, with parameter sets, campaigns and loops, laws and FMUs",
    "describe": "say what a system, an FMU or a slot has: connectors, parameters with their values, what fits where",
    "validate": "check systems, FMUs, parameter sets and campaigns",
    "compare": "compare the variants of one or several stored batches on the same trials",
    "law": "print a network operator's law as a formula, or write it as parameter set or drawing",
    "synthesize": "search for a control law, every candidate flown in its system",
    "plan": "plan a transfer between hovers, or bound what a landing takes",
    "benchmark": "time a communication step against other importers",
    "new": "write a block or a system of your own to start from",
    "export": "build an FMU, or a self-contained .ssp of a system, for a chosen platform",
}
VERBS |= {verb.name: verb.text for verb in DECLARED.values()}

# What exit status 1 means in addition to an interruption.
FAILURES = {
    "synthesize": "no law was found with every trial a success",
    "plan": "there is no such plan, or less propellant on board than it takes",
}


class Formatter(argparse.HelpFormatter):
    """argparse's own, at most 100 columns wide, which keeps the lines of examples as they are: those with an indent."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, max_help_position=32, width=min(shutil.get_terminal_size().columns, WIDEST))

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return "\n".join(
            line
            if line.startswith(" ")
            else textwrap.fill(line, width, initial_indent=indent, subsequent_indent=indent)
            for line in text.splitlines()
        )


class Parser(argparse.ArgumentParser):
    """argparse with errors on one line and options in full."""

    def __init__(self, **keywords: Any) -> None:
        super().__init__(**keywords, allow_abbrev=False, formatter_class=Formatter)

    def error(self, message: str) -> NoReturn:
        place = ": ".join(self.prog.split())
        self.exit(2, f"{place}: {message}; see {self.prog} --help\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out one command; returns the exit status, which does not depend on who reads its output."""
    with steady_streams() as output:
        status = _carry_out(sys.argv[1:] if arguments is None else list(arguments))
        output.flush()
        if output.is_cut and output.error is not None:
            print(f"perilune: standard output: {output.error.strerror}; make room, or write to a file", file=sys.stderr)
            return ExitStatus.REFUSED
        return status


def _carry_out(given: Sequence[str]) -> int:
    parser = parser_of(given)
    argcomplete.autocomplete(parser)
    options = parser.parse_args(given)
    verb = DECLARED.get(options.verb)
    flags = flags_of(verb or DECLARED["run"])
    try:
        return _module(options.verb).run(options) if verb is None else carry_out(verb, options)
    except InputError as error:
        print(f"perilune: {error.line(flags)}", file=sys.stderr)
        return ExitStatus.REFUSED
    except TimeoutError as error:
        print(f"perilune: {call_by_flags(str(error), flags)}", file=sys.stderr)
        return ExitStatus.NOT_MET
    except EndedError as ended:
        print(f"perilune: {call_by_flags(str(ended), flags)}", file=sys.stderr)
        return ended.status
    except KeyboardInterrupt as interrupt:
        hint = call_by_flags("".join(getattr(interrupt, "__notes__", [])), flags)
        print(f"perilune: interrupted{hint}", file=sys.stderr)
        return ExitStatus.NOT_MET
    except OSError as error:  # a file that cannot be read or written
        reason = f"{error.filename}: {error.strerror}" if error.filename else str(error)
        print(f"perilune: {reason}; give another path or mend this one", file=sys.stderr)
        return ExitStatus.REFUSED


def carry_out(verb: Verb, parsed: argparse.Namespace) -> int:
    """Call the function of a verb with what a command line gives, and present its result."""
    arguments, options, files = read_parsed(verb, parsed)
    result = importlib.import_module(".verbs.result", __package__)
    result.check_files(verb, files)
    result.report_stale(verb, arguments, options)
    module, function = verb.home
    called = getattr(importlib.import_module(f".verbs.{module}", __package__), function)
    try:
        outcome = called(**arguments, **options)
    except UnwrittenError as error:
        result.present(error.result, files, flags_of(verb))
        raise
    return result.present(outcome, files, flags_of(verb))


def exit_status(verb: str) -> str:
    """What the exit statuses of a verb mean."""
    not_met = DECLARED[verb].not_met if verb in DECLARED else FAILURES.get(verb)
    failure = f"{not_met}, or interrupted" if not_met else "interrupted"
    return f"Exit status: 0: done, and all is met. 1: {failure}. 2: wrong input, or a result could not be written."


def parser_of(given: Sequence[str]) -> Parser:
    """All verbs by name; only the one that is given has its options read, which is what keeps completion quick."""
    parser = Parser(prog="perilune", description="Spacecraft guidance, navigation and control as FMI components.")
    parser.add_argument("--version", action="version", version=f"perilune {version('perilune')}")
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB", parser_class=Parser)
    named = [*given, *os.environ.get("COMP_LINE", "").split()]  # a shell asks with the line that is being written
    for verb, words in VERBS.items():
        declared = DECLARED.get(verb)
        given_examples = EXAMPLES[verb] if declared is None else declared.examples
        examples = "".join(f"  {command}\n      {comment}\n" for command, comment in given_examples)
        epilog = f"Examples:\n{examples}\n{exit_status(verb)}"
        own = verbs.add_parser(verb, help=words, description=words, epilog=epilog)
        if verb in named and verb in DECLARED:
            add_verb(own, DECLARED[verb], is_complete=HELP_ALL in named)
            own.add_argument(HELP_ALL, action="help", help="show the shared options, too")
        elif verb in named:
            _module(verb, "asked.").add(own)
    return parser


def _module(verb: str, of: str = "") -> ModuleType:
    return importlib.import_module(f".commands.{of}{verb}", __package__)


def run() -> NoReturn:
    """The console script: `main`, then leave at once."""
    warn_in_one_line()
    try:
        status = main()
    except SystemExit as stop:  # argparse's --help and errors
        status = stop.code if isinstance(stop.code, int) else 1
    leave(status)
