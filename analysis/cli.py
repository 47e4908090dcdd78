"""The console command `perilune`; its exit status is one of `ExitStatus`."""

from __future__ import annotations

import argparse
import importlib
import inspect
import os
import sys
from collections.abc import Sequence
from typing import NoReturn

from ..common.errors import EndedError, ExitStatus, InputError, UnwrittenError, name_by_flags, warn_in_one_line
from ..common.machine.os_errors import line_of, reason_of
from ..common.process import exit_process, guard_streams, open_closed_streams
from ..common.targets import check_encoding
from .options.declaration import Verb
from .options.parsing import Completer, add_verb, flags_of, read_parsed
from .verbs.help import Parser, group_help, overview, verb_help
from .verbs.options.verbs import FORMER, GROUPS, VERBS

HELP_ALL = "--help-all"
COMPLETES = "_ARGCOMPLETE"  # set where a shell asks for completions; argcomplete is slow to import
COMPLETING = "COMP_LINE"  # variable of a shell: the line being completed
USAGE = "perilune [--help] [--version] VERB ..."


def main(arguments: Sequence[str] | None = None) -> int:
    """Execute one command and return its exit status.

    A reader that closes the pipe early does not change the status.
    """
    with guard_streams() as output:
        status = _carry_out(sys.argv[1:] if arguments is None else list(arguments))
        output.flush()
        if output.is_cut and output.error is not None:
            print(f"perilune: {line_of(output.error, 'standard output')}", file=sys.stderr)
            return ExitStatus.REFUSED
        return status


def _carry_out(arguments: Sequence[str]) -> int:
    for former in (" ".join(arguments[:2]), *arguments[:1]):
        if former in FORMER:
            print(f"perilune: {former}: {FORMER[former]}", file=sys.stderr)
            return ExitStatus.REFUSED
    parser = parser_of(arguments)
    if COMPLETES in os.environ:
        importlib.import_module("argcomplete").autocomplete(parser)
    parsed, unknown = parser.parse_known_args(arguments)
    verb = VERBS[f"{parsed.verb} {parsed.second}" if parsed.verb in GROUPS else parsed.verb]
    if unknown:
        Parser(prog=f"perilune {verb.name}").error(f"unrecognized arguments: {' '.join(unknown)}")
    flags = flags_of(verb)
    try:
        _check_names(verb, arguments)
        return carry_out(verb, parsed)
    except InputError as error:
        for line in error.lines(flags):
            print(f"perilune: {line}", file=sys.stderr)
        return ExitStatus.REFUSED
    except TimeoutError as error:
        print(f"perilune: {name_by_flags(str(error), flags)}", file=sys.stderr)
        return ExitStatus.NOT_MET
    except EndedError as ended:
        print(f"perilune: {name_by_flags(str(ended), flags)}", file=sys.stderr)
        return ended.status
    except KeyboardInterrupt as interrupt:
        hint = name_by_flags("".join(getattr(interrupt, "__notes__", [])), flags)
        print(f"perilune: interrupted{hint}", file=sys.stderr)
        return ExitStatus.NOT_MET
    except OSError as error:  # a file that cannot be read or written
        print(f"perilune: {line_of(error)}", file=sys.stderr)
        return ExitStatus.REFUSED


def _check_names(verb: Verb, arguments: Sequence[str]) -> None:
    """Reject arguments and a working folder that libraries cannot open, before any file is read. Raises InputError."""
    for text in arguments:
        check_encoding(verb.name, text)
    try:
        here = os.getcwd()
    except OSError as error:
        raise InputError("working folder", "", reason_of(error), "change to an existing folder") from error
    check_encoding("working folder", here)


class _Version(argparse.Action):
    """Action that prints the version, which is slow to determine and therefore read only on demand."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        metadata = importlib.import_module("importlib.metadata")
        commit = importlib.import_module("..common.machine.commit", __package__).known_commit()
        print(f"perilune {metadata.version('perilune')}{f' (commit {commit})' if commit else ''}")
        parser.exit()


def carry_out(verb: Verb, parsed: argparse.Namespace) -> int:
    """Call the function of a verb with the parsed arguments and options, and present its result."""
    arguments, options, files = read_parsed(verb, parsed)
    importlib.import_module(".verbs.early_server", __package__).start_early(verb, arguments, options)
    result = importlib.import_module(".verbs.result", __package__)
    result.check_files(verb, options, files)
    result.report_state_of_fmus(verb, arguments, options)
    module, function = verb.home
    called = getattr(importlib.import_module(f".verbs.{module}", __package__), function)
    parameters = inspect.signature(called).parameters.values()
    several = [each for one in parameters if one.kind is one.VAR_POSITIONAL for each in arguments.pop(one.name)]
    try:
        outcome = called(*several, **arguments, **options)
    except UnwrittenError as error:
        result.output_result(verb, error.result, files)
        raise
    return result.output_result(verb, outcome, files)


def parser_of(arguments: Sequence[str]) -> Parser:
    """Return the parser of all verbs.

    Only the options of the verb named on the command line are read, which keeps completion fast.
    """
    parser = Parser(prog="perilune", usage=USAGE, description=overview(), add_help=False)
    parser.add_argument("--help", "-h", action="help", help="show this help")
    parser.add_argument("--version", action=_Version, nargs=0, help="show the version, and the commit if known")
    named = [*arguments, *os.environ.get(COMPLETING, "").split()]
    is_complete = HELP_ALL in named or COMPLETING in os.environ
    seconds = {}
    verbs = parser.add_subparsers(
        dest="verb", required=True, metavar="VERB", prog="perilune", parser_class=Parser, help=argparse.SUPPRESS
    )
    for group in GROUPS:
        usage = f"perilune {group} [--help] VERB ..."
        added = verbs.add_parser(group, usage=usage, description=group_help(group))
        seconds[group] = added.add_subparsers(
            dest="second",
            required=True,
            metavar="VERB",
            prog=f"perilune {group}",
            parser_class=Parser,
            help=argparse.SUPPRESS,
        )
    for name, verb in VERBS.items():
        first, _, second = name.partition(" ")
        own = (seconds[first] if second else verbs).add_parser(
            second or first, description=verb.text, epilog=verb_help(verb), add_help=False
        )
        if first in named and (not second or second in named):
            add_verb(own, verb, _find_completer, is_complete=is_complete)
            displayed = own.add_argument_group("help")
            displayed.add_argument("--help", "-h", action="help", help="show this help")
            displayed.add_argument(HELP_ALL, action="help", help="show this help with the shared options")
    return parser


def _find_completer(name: str) -> Completer:
    """Return a completer by name; only this function imports the module of completers, which is slow."""
    completer: Completer = getattr(importlib.import_module(".verbs.options.completers", __package__), name)
    return completer


def run() -> NoReturn:
    """Run the console script: call `main`, then exit immediately."""
    open_closed_streams()
    warn_in_one_line()
    try:
        status = main()
    except SystemExit as stop:  # argparse's --help and errors
        status = stop.code if isinstance(stop.code, int) else 1
    exit_process(status)
