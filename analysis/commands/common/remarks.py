"""What a command says of a system beside its result: FMUs that are out of date, inputs that nobody set."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable

from ...runtime.system.stale import stale_fmus
from ...verbs.common.notes import note_lines
from .options import system_options


def say_stale(options: argparse.Namespace, others: Iterable[str] = ()) -> None:
    """A line on standard error for every file that is newer than the FMUs built of it, which fly here."""
    for line in stale_fmus(options.system, system_options(options), others):
        print(f"perilune: {line}", file=sys.stderr)


__all__ = ["note_lines", "say_stale"]
