"""What the exit status of a command says; docs/command_line.md has it verb by verb."""

from __future__ import annotations

from enum import IntEnum

from .targets import Results


class ExitStatus(IntEnum):
    """Of any verb."""

    MET = 0  # done, and everything that was to hold does
    NOT_MET = 1  # done, and something is violated, withheld or not evaluated, or a flight did not finish
    REFUSED = 2  # wrong input, or a result could not be written


def exit_status(files: Results, *met: bool) -> ExitStatus:
    """The status of a command that has done its work: ``files`` are its results, ``met`` all that was to hold."""
    if files.failed:
        return ExitStatus.REFUSED
    return ExitStatus.MET if all(met) else ExitStatus.NOT_MET
