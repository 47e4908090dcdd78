"""`perilune.diff` and `perilune diff`: two runs over each other, signal by signal."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Unpack

import numpy as np

from ...common.errors import InputError
from ...common.to_json import to_json
from ..campaigns.tables import align_columns
from ..differences.differences import RunDifferences, compare_runs
from ..differences.recorded_run import read_run
from ..options.declared.library import DIFF, LISTING, DiffOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..reports.common.quantities import number
from ..reports.differences.page import within_tolerance, write_differences_page

LISTED = 20  # signals that a terminal shows
NAMED = 6  # signals of one run alone


@dataclass(frozen=True, eq=False)
class Differences:
    """The differences of two runs: ``runs.signals`` by relative difference, each with its values in both.

    Those within the ``tolerance``, or `LISTING` without one, are summarised.
    """

    runs: RunDifferences
    tolerance: float | None

    def __repr__(self) -> str:
        signals = self.runs.signals
        return f"{type(self).__name__}({len(signals)} signals, {sum(each.differs for each in signals)} differ)"

    def lines(self) -> list[str]:
        """What `perilune diff` prints."""
        runs = self.runs
        differing, within = runs.split(self.listing)
        rows = [["signal", "largest difference", "relative", "at, s", "first", "second"]]
        for each in differing[:LISTED]:
            unit = f" {each.unit}" if each.unit else ""
            rows.append(
                [
                    each.name,
                    f"{number(each.greatest)}{unit}",
                    number(each.relative, 3),
                    number(float(runs.time[each.row])),
                    *(number(float(samples[each.row]), 9) for samples in (each.first, each.second)),
                ]
            )
        more = [f"and {len(differing) - LISTED} more"] if len(differing) > LISTED else []
        summary = [within_tolerance(within, self.listing)] if within else []
        return [*self.statements(), *(align_columns(rows) if differing else []), *more, *summary]

    @property
    def listing(self) -> float:
        """The relative difference up to which signals are summarised."""
        return LISTING if self.tolerance is None else self.tolerance

    def statements(self) -> list[str]:
        """What was compared, in sentences."""
        runs = self.runs
        identical = sum(not each.differs for each in runs.signals)
        copies = sum(bool(each.differs and each.copy_of) for each in runs.signals)
        words = [
            f"first: {runs.first.file}{f' ({runs.first.origin})' if runs.first.origin else ''}",
            f"second: {runs.second.file}{f' ({runs.second.origin})' if runs.second.origin else ''}",
            f"{len(runs.signals)} signals in both, {identical} identical and {copies} copies of others",
            f"{runs.time.size} samples from {number(float(runs.time[0]))} s to {number(float(runs.time[-1]))} s",
        ]
        if runs.resampled:
            words.append("sample times differ: the second run is interpolated at those of the first")
        for which, names in zip(("first", "second"), runs.only, strict=True):
            if names:
                more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
                words.append(f"only in the {which}: {', '.join(names[:NAMED])}{more}")
        words += [f"not compared: {name} is in {unit} and in {other}" for name, unit, other in runs.unlike]
        return words

    def problems(self) -> list[str]:
        """Signals beyond ``tolerance``, and signals that are not compared; nothing without a tolerance."""
        if self.tolerance is None:
            return []
        beyond, _ = self.runs.split(self.tolerance)
        lines = [f"{each.name}: differs by {number(each.relative, 3)} of its largest magnitude" for each in beyond]
        lines += [f"{name}: in one run only" for names in self.runs.only for name in names]
        return [*lines, *(f"{name}: units {unit} and {other}" for name, unit, other in self.runs.unlike)]

    def to_json(self) -> object:
        """All signals that both runs have, by relative difference, for other programs."""
        runs = self.runs
        rows = [
            {
                "signal": each.name, "unit": each.unit, "difference": each.greatest, "relative": each.relative,
                "copy_of": each.copy_of, "time": float(runs.time[each.row]), "first": _known(each.first[each.row]),
                "second": _known(each.second[each.row]),
            }
            for each in runs.signals
        ]  # fmt: skip
        return to_json(
            {
                "first": runs.first.file,
                "second": runs.second.file,
                "samples": int(np.size(runs.time)),
                "resampled": runs.resampled,
                "signals": rows,
                "only_first": runs.only[0],
                "only_second": runs.only[1],
                "unlike_units": [list(each) for each in runs.unlike],
            }
        )

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune diff --report`: one HTML file."""
        write_differences_page(self.runs, self.statements(), self.listing, Path(path))


def _known(sample: float) -> float | None:
    """A sample for JSON, which has no nan: None."""
    return None if np.isnan(sample) else float(sample)


@verb(DIFF)
def diff(first: FilePath, second: FilePath, **options: Unpack[DiffOptions]) -> Differences:
    """Put two runs over each other, signal by signal: `perilune diff`.

    ``first`` and ``second`` are tables of signals over time (.csv, .parquet) that `simulate` wrote, or another tool's.
    With ``tolerance`` a signal that differs by more than this fraction of its largest magnitude is a problem, and so is
    one that only one run has. Raises InputError.
    """
    tolerance = options["tolerance"]
    if tolerance is not None and not tolerance >= 0.0:  # nan neither
        raise InputError("`tolerance`", str(tolerance), "not a number of 0 or more", "give a fraction, as 1e-6")
    return Differences(compare_runs(read_run(Path(first)), read_run(Path(second))), tolerance)
