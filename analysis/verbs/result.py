"""What the command line needs of every verb's result, and how it leaves as text, JSON and files."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Protocol

from ..common.atomic import write_atomically
from ..common.errors import InputError, call_by_flags
from ..common.exit_status import ExitStatus
from ..common.targets import Results, check_file
from .options.option import options_of
from .options.verb import Verb

STANDARD_OUTPUT = "-"


class VerbResult(Protocol):
    """The result of a verb.

    It may have ``report(path)``, ``write(path)`` and other methods that write the files of its verb; ``written``, the
    paths of what the verb itself has written; and ``problem_status``, the exit status of problems where it is not 1.
    """

    def lines(self) -> Sequence[str]:
        """What the terminal shows."""

    def to_json(self) -> Any:
        """A document of strict JSON."""

    def problems(self) -> Sequence[str]:
        """Requirements that are not met and simulations that did not complete: a line each, exit status 1."""


WRITERS = {"report": "report", "output": "write"}  # of a result, by the option of a file that does not name another


def check_files(verb: Verb, options: Mapping[str, Any], files: Mapping[str, Any]) -> None:
    """Refuse files that cannot be written, and options without their file, before any work. Raises InputError."""
    declared = options_of(verb.files)
    for name, value in options.items():
        needed = options_of(verb.options)[name].option.needs
        if needed and files.get(needed) is None:
            raise InputError(
                f"`{name}`", str(value), f"without effect unless `{needed}` is given", "give both or neither"
            )
    for name, path in files.items():
        if path is not None and str(path) != STANDARD_OUTPUT:
            check_file(f"`{name}`", Path(path), declared[name].option.suffixes)


def present(verb: Verb, result: VerbResult, files: Mapping[str, Any], flags: Mapping[str, str]) -> ExitStatus:
    """Print a result or its JSON document, write its files, report its problems; the exit status of the command.

    ``flags`` are what the verb's parameters are called on the command line.
    """
    written, declared = Results(), options_of(verb.files)
    written.written += getattr(result, "written", ())
    target = files.get("json")
    if target == STANDARD_OUTPUT:
        sys.stdout.write(_json_text(result))
    else:
        if target is not None:
            written.write(Path(target), lambda path: write_atomically(path, _json_text(result).encode()))
        else:
            print("\n".join(result.lines()))
    for name, path in files.items():
        writer = declared[name].option.writer or WRITERS.get(name)
        if writer and path is not None:
            written.write(Path(path), partial(_call, result, writer))
    if target != STANDARD_OUTPUT:
        written.say()
    problems = result.problems()
    for line in problems:
        print(f"perilune: {call_by_flags(line, flags)}", file=sys.stderr)
    if written.failed:
        return ExitStatus.REFUSED
    return getattr(result, "problem_status", ExitStatus.NOT_MET) if problems else ExitStatus.MET


def _json_text(result: VerbResult) -> str:
    return json.dumps(result.to_json(), indent=1, allow_nan=False) + "\n"


def _call(result: VerbResult, method: str, path: Path) -> None:
    getattr(result, method)(path)
