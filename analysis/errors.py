"""The error that wrong input ends in: one line that says where, what and what to do."""

from __future__ import annotations

import difflib
import os
import warnings
from collections.abc import Iterable


class InputError(ValueError):
    """Input that is wrong: a file, an option, a name.

    ``file`` is where the input came from (a path, or an option such as ``--require``),
    ``element`` the part of it that is wrong, ``problem`` what is wrong and ``remedy`` what to
    do. The command line prints it as one line and exits with status 2.
    """

    def __init__(self, file: str | os.PathLike[str], element: str, problem: str, remedy: str) -> None:
        # all four go to args, so that the error survives pickling between worker processes
        super().__init__(os.fspath(file), element, problem, remedy)
        self.file = os.fspath(file)
        self.element = element
        self.problem = problem
        self.remedy = remedy

    def __str__(self) -> str:
        place = ": ".join(part for part in (self.file, self.element, self.problem) if part)
        return " ".join(f"{place}; {self.remedy}".split())


def warn_in_one_line() -> None:
    """Let warnings of this process be a line each, as errors are, without the place in the source."""
    warnings.formatwarning = lambda message, *_: f"perilune: {message}\n"


def suggestion(name: str, known: Iterable[str], most: int = 12) -> str:
    """A remedy for an unknown name: the known ones, the ``most`` nearest when there are many."""
    names = sorted(known)
    if not names:
        return "there is none to choose from here"
    if len(names) <= most:
        return f"use one of {', '.join(names)}"
    near = difflib.get_close_matches(name, names, n=most, cutoff=0.3)
    if not near:
        return f"use one of {', '.join(names[:most])} and {len(names) - most} more"
    return f"the nearest of {len(names)} known names: {', '.join(near)}"
