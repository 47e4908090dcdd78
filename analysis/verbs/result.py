"""What the command line needs of every verb's result, and how it leaves as text, JSON and files."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Protocol

from ..common.atomic import write_atomically
from ..common.errors import call_by_flags
from ..common.exit_status import ExitStatus
from ..common.targets import Results, check_file, check_folder
from ..runtime.system.options import system_options
from ..runtime.system.stale import stale_fmus
from .options.option import defaults_of, options_of
from .options.verb import Verb

STANDARD_OUTPUT = "-"


class VerbResult(Protocol):
    """The result of a verb. It may have ``report(path)`` and ``write(path)``, for the files of its verb.

    It may also have a ``folder``, in which it is stored already.
    """

    def lines(self) -> Sequence[str]:
        """What the terminal shows."""

    def to_json(self) -> Any:
        """A document of strict JSON."""

    def problems(self) -> Sequence[str]:
        """Requirements that are not met and simulations that did not complete: a line each, exit status 1."""


WRITERS = {
    "report": "report",
    "output": "write",
    "graph": "write_graph",
}  # of a result, by the option that names a file


def check_files(verb: Verb, files: Mapping[str, Any]) -> None:
    """Refuse files that cannot be written, before anything is simulated. Raises InputError."""
    declared = options_of(verb.files)
    for name, path in files.items():
        if path is not None and str(path) != STANDARD_OUTPUT:
            option = declared[name].option
            if option.is_folder:
                check_folder(f"`{name}`", Path(path), overwrite=True)
            else:
                check_file(f"`{name}`", Path(path), option.suffixes)


def report_stale(verb: Verb, arguments: Mapping[str, Any], options: Mapping[str, Any]) -> None:
    """A line on standard error for every source file that is newer than the FMUs built of it, which are simulated."""
    if "system" not in arguments or "use" not in options_of(verb.options):
        return
    compared = [fmu for fmus in options.get("compare", {}).values() for fmu in fmus]
    complete = {**defaults_of(verb.options), **options}
    for line in stale_fmus(arguments["system"], system_options(complete), compared):
        print(f"perilune: {line}", file=sys.stderr)


def present(result: VerbResult, files: Mapping[str, Any], flags: Mapping[str, str]) -> ExitStatus:
    """Print a result or its JSON document, write its files, report its problems; the exit status of the command.

    ``flags`` are what the verb's parameters are called on the command line.
    """
    written = Results()
    written.written += [folder] if (folder := getattr(result, "folder", None)) is not None else []
    target = files.get("json")
    if target == STANDARD_OUTPUT:
        sys.stdout.write(_json_text(result))
    else:
        if target is not None:
            written.write(Path(target), lambda path: write_atomically(path, _json_text(result).encode()))
        else:
            print(call_by_flags("\n".join(result.lines()), flags))
    for name, path in files.items():
        if name in WRITERS and path is not None:
            written.write(Path(path), partial(_call, result, WRITERS[name]))
    if target != STANDARD_OUTPUT:
        written.say()
    problems = result.problems()
    for line in problems:
        print(f"perilune: {call_by_flags(line, flags)}", file=sys.stderr)
    if written.failed:
        return ExitStatus.REFUSED
    return ExitStatus.NOT_MET if problems else ExitStatus.MET


def _json_text(result: VerbResult) -> str:
    return json.dumps(result.to_json(), indent=1, allow_nan=False) + "\n"


def _call(result: VerbResult, method: str, path: Path) -> None:
    getattr(result, method)(path)
