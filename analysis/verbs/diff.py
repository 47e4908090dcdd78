"""`perilune.diff` and `perilune diff`: comparison of two runs, signal by signal."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Unpack

from ...common.errors import InputError
from ..differences.differences import RunDifferences, compare_runs
from ..differences.recorded_run import read_run
from ..documents.common.quantities import number
from ..documents.model import Document
from ..documents.of.differences import differences_document
from ..options.declared.library import DIFF, LISTING, DiffOptions
from ..options.option import FilePath
from ..options.verb import verb
from .common.documented import Documented


@dataclass(frozen=True, eq=False)
class Differences(Documented):
    """Differences of two runs: ``runs.signals`` in order of falling relative difference, with the values in both runs.

    Signals within ``tolerance`` (default: `LISTING`) are summarised.
    """

    runs: RunDifferences
    tolerance: float | None

    def __repr__(self) -> str:
        signals = self.runs.signals
        return f"{type(self).__name__}({len(signals)} signals, {sum(each.differs for each in signals)} differ)"

    def document(self) -> Document:
        """Return a document with the compared runs, the signals that differ, and the times of the differences."""
        return differences_document(self.runs, LISTING if self.tolerance is None else self.tolerance)

    def problems(self) -> list[str]:
        """Return a line for each signal beyond ``tolerance`` or not compared; no lines without a tolerance."""
        if self.tolerance is None:
            return []
        beyond, _ = self.runs.split(self.tolerance)
        lines = [f"{each.name}: differs by {number(each.relative, 3)} of its largest magnitude" for each in beyond]
        lines += [f"{name}: only one run has this signal" for names in self.runs.only for name in names]
        return [*lines, *(f"{name}: its units differ, {unit} and {other}" for name, unit, other in self.runs.unlike)]


@verb(DIFF)
def diff(first: FilePath, second: FilePath, **options: Unpack[DiffOptions]) -> Differences:
    """Compare two runs, signal by signal: `perilune diff`.

    ``first`` and ``second`` are tables of signals over time (.csv, .parquet), written by `simulate` or by another tool.
    With ``tolerance`` a signal is a problem if it differs by more than this fraction of its largest magnitude, or if
    only one run has it. Raises InputError.
    """
    tolerance = options["tolerance"]
    if tolerance is not None and not tolerance >= 0.0:  # rejects NaN, too
        raise InputError("`tolerance`", str(tolerance), "negative, or not a number", "give a fraction such as 1e-6")
    return Differences(compare_runs(read_run(Path(first)), read_run(Path(second))), tolerance)
