"""Errors of wrong input, in one line that states place, problem and remedy; exit statuses of commands."""

from __future__ import annotations

import difflib
import os
import re
import warnings
from collections.abc import Iterable, Mapping
from enum import IntEnum
from typing import Any


class ExitStatus(IntEnum):
    """Exit status of any verb."""

    MET = 0  # completed, and everything that was checked holds
    NOT_MET = 1  # completed, but something is violated, withheld or not evaluated, or a simulation did not finish
    REFUSED = 2  # wrong input, or a result could not be written


PARAMETER = re.compile(r"`(\w+)`")  # the name of a parameter in a message


class InputError(ValueError):
    """Error raised for wrong input, such as a file, an option or a name.

    ``file`` is the origin of the input (a path, or a parameter such as `` `require` ``), ``element`` is its wrong
    element, ``problem`` describes the error and ``remedy`` the correction. In all four texts, parameters of Perilune's
    functions are in backquotes: Python shows their names, the command line the corresponding options. The command line
    prints the error as one line and exits with status 2.
    """

    def __init__(self, file: str | os.PathLike[str], element: str, problem: str, remedy: str) -> None:
        # all four go to args, so that the error survives pickling between worker processes
        super().__init__(os.fspath(file), element, problem, remedy)
        self.file = os.fspath(file)
        self.element = element
        self.problem = problem
        self.remedy = remedy

    def __str__(self) -> str:
        return self.line({})

    def line(self, flags: Mapping[str, str]) -> str:
        """Return the error in one line, each parameter replaced by its name in ``flags``, or else by its own name."""
        return name_by_flags(self.text, flags)

    def lines(self, flags: Mapping[str, str]) -> list[str]:
        """Return the lines that the command line prints: one line, or one per problem for `SeveralProblemsError`."""
        return [self.line(flags)]

    @property
    def text(self) -> str:
        """The error in one line, with parameters in backquotes."""
        location = ": ".join(_shorten(part) for part in (self.file, self.element, self.problem) if part)
        # texts of other libraries may end with a full stop
        ended = location if location.endswith("..") else location.removesuffix(".")
        return " ".join(f"{ended}; {_shorten(self.remedy)}".split())


LONGEST = 1000  # characters of each text of a line, whose names and values may come from a file


def _shorten(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."


class SeveralProblemsError(InputError):
    """Several problems with one input, one line each."""

    def __init__(self, *texts: str) -> None:
        ValueError.__init__(self, *texts)
        self.texts = texts

    @property
    def text(self) -> str:
        """All lines, with parameters in backquotes."""
        return "\n".join(self.texts)

    def lines(self, flags: Mapping[str, str]) -> list[str]:
        """Return one line for each problem."""
        return [name_by_flags(text, flags) for text in self.texts]


def name_by_flags(text: str, flags: Mapping[str, str]) -> str:
    """Return a message with each parameter replaced by its name in ``flags``, or else by its own name."""
    return PARAMETER.sub(lambda match: flags.get(match[1], match[1]), text)


class EndedError(RuntimeError):
    """Error that ends work early for a reason other than its input, such as an interruption; has an exit ``status``."""

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message, status)
        self.message = message
        self.status = status

    def __str__(self) -> str:
        return self.message


class UnwrittenError(OSError):
    """Error raised if a result cannot be written to the folder of `output`; ``result`` is the result in memory."""

    def __init__(self, error: OSError, result: Any) -> None:
        super().__init__(error.errno, error.strerror or str(error), error.filename)
        self.result = result


def _flag(match: re.Match[str]) -> str:
    return f"--{match[1].replace('_', '-')}"


def warn_in_one_line() -> None:
    """Print each warning of this process in one line, like errors, without its place in the source."""
    warnings.formatwarning = lambda message, *_: f"perilune: {PARAMETER.sub(_flag, str(message))}\n"


FEW, NEAREST, ALL = (
    6,
    4,
    12,
)  # numbers of names shown: all of up to FEW, otherwise the NEAREST ones, or up to ALL if none is near
LEAST_SIMILARITY = 0.6  # least ratio of difflib, which is 1 for equal texts


def suggestion(name: str, known: Iterable[str]) -> str:
    """Return a remedy for an unknown name: the most similar names, or all if there are few or none is similar."""
    names = sorted(set(known), key=_natural)
    if not names:
        return "none is available"
    likeness = {
        other: 1.0 if name and other.startswith(name) else difflib.SequenceMatcher(None, other, name).ratio()
        for other in names
    }
    ranked = sorted(
        names, key=lambda other: -likeness[other]
    )  # a stable sort, which keeps the order of equally similar names
    near = [other for other in ranked if likeness[other] >= LEAST_SIMILARITY][:NEAREST]
    if len(names) <= FEW:
        return f"use one of {', '.join(near + [other for other in names if other not in near])}"
    if near:
        return f"the nearest of {len(names)} known names: {', '.join(near)}"
    displayed = names if len(names) <= ALL else names[:NEAREST]
    more = f" and {len(names) - len(displayed)} more" if len(displayed) < len(names) else ""
    return f"use one of {', '.join(displayed)}{more}"


def _natural(name: str) -> list[tuple[int, str]]:
    """Return a sort key that puts x[2] before x[10]."""
    return [(int(part), "") if part.isdigit() else (-1, part) for part in re.split(r"(\d+)", name)]
