"""Two runs over each other: by how much each signal differs, where, and which signals only one of them has."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...common.errors import InputError
from ..runtime.ssp.conversions import unit_by_name
from .recorded_run import RecordedRun


@dataclass(frozen=True, eq=False)
class SignalDifference:
    """A signal that both runs have: ``first`` and ``second``, [n], at the common times, in ``unit``.

    ``copy_of`` is an earlier signal with the same values in both, as an input has those of an output; else empty.
    ``axis`` is the name of the axis that an element is along, of the first run that knows one.
    """

    name: str
    unit: str | None
    first: np.ndarray
    second: np.ndarray
    copy_of: str
    axis: str = ""

    @cached_property
    def difference(self) -> np.ndarray:
        """Second less first, [n]; infinite where only one is finite, 0 where both are the same infinity or nan."""
        with np.errstate(invalid="ignore", over="ignore"):
            difference = self.second - self.first
        same = (self.first == self.second) | (np.isnan(self.first) & np.isnan(self.second))
        return np.where(same, 0.0, np.where(np.isnan(difference), np.inf, difference))

    @property
    def differs(self) -> bool:
        """True if it differs anywhere."""
        return self.greatest > 0.0

    @property
    def row(self) -> int:
        """Row of the greatest difference."""
        return int(np.argmax(np.abs(self.difference)))

    @property
    def greatest(self) -> float:
        """The greatest magnitude of the difference."""
        return float(np.abs(self.difference[self.row]))

    @cached_property
    def relative(self) -> float:
        """The greatest difference over the greatest magnitude of both."""
        if self.greatest == 0.0:
            return 0.0
        finite = np.concatenate([each[np.isfinite(each)] for each in (self.first, self.second)])
        return self.greatest / float(np.max(np.abs(finite), initial=0.0) or 1.0)


@dataclass(frozen=True, eq=False)
class RunDifferences:
    """Two runs at the ``time`` (s, [n]) that both have; ``signals`` in order of their relative difference.

    Where ``resampled`` is true their samples are not at the same times: the second is interpolated at those of the
    first, linearly or, for Integers and Booleans, held. ``only`` are signals that one run has, the first's before the
    second's; ``unlike`` are (name, unit, unit) of signals whose units cannot be converted.
    """

    first: RecordedRun
    second: RecordedRun
    time: np.ndarray
    resampled: bool
    signals: list[SignalDifference]
    only: tuple[list[str], list[str]]
    unlike: list[tuple[str, str, str]]

    @property
    def differing(self) -> list[SignalDifference]:
        """The signals that differ, without copies."""
        return [each for each in self.signals if each.differs and not each.copy_of]

    def split(self, tolerance: float) -> tuple[list[SignalDifference], list[SignalDifference]]:
        """Return the signals that differ by more than a relative ``tolerance``, and by less, without copies."""
        beyond = [each for each in self.differing if each.relative > tolerance]
        return beyond, self.differing[len(beyond) :]


def compare_runs(first: RecordedRun, second: RecordedRun) -> RunDifferences:
    """Return the differences of two runs, matched by the names of signals, units converted into the first's.

    Raises InputError for runs without a common time or a common signal.
    """
    rows = (first.time >= second.time[0]) & (first.time <= second.time[-1])
    if not rows.any():
        raise InputError(second.file, "time", f"no time in common with {first.file}", "compare runs that overlap")
    common = [name for name in first.signals if name in second.signals]
    if not common:
        raise InputError(second.file, "", f"no signal in common with {first.file}", "compare runs of one system")
    time = first.time[rows]
    resampled = not np.array_equal(first.time, second.time)
    differences: list[SignalDifference] = []
    unlike: list[tuple[str, str, str]] = []
    originals: dict[tuple[bytes, bytes], str] = {}
    for name in common:
        unit, other = first.units.get(name), second.units.get(name)
        line = _conversion(other, unit, is_relative=name in first.relative | second.relative)
        if line is None:
            unlike.append((name, str(unit), str(other)))
            continue
        is_discrete = name in first.discrete and name in second.discrete
        sampled = _sample(second, name, time, hold=is_discrete) if resampled else second.signals[name]
        values = sampled if line == (1.0, 0.0) else line[0] * sampled + line[1]
        of_first = first.signals[name][rows]
        original = originals.setdefault((of_first.tobytes(), values.tobytes()), name)
        copy_of = "" if original == name else original
        axis = first.axes.get(name) or second.axes.get(name, "")
        differences.append(SignalDifference(name, unit or other, of_first, values, copy_of, axis))
    only = ([name for name in first.signals if name not in second.signals],
            [name for name in second.signals if name not in first.signals])  # fmt: skip
    ordered = sorted(differences, key=lambda each: -each.relative)
    return RunDifferences(first, second, time, resampled, ordered, only, unlike)


def _conversion(unit: str | None, into: str | None, *, is_relative: bool) -> tuple[float, float] | None:
    """Return factor and offset from a unit into another; 1 and 0 where one is unknown, None for other dimensions."""
    if unit == into or unit is None or into is None:
        return 1.0, 0.0
    source, target = (replace(unit_by_name(name), is_relative=is_relative) for name in (unit, into))
    return source.conversion_to(target) if source.fits(target) else None


def _sample(run: RecordedRun, name: str, time: np.ndarray, *, hold: bool) -> np.ndarray:
    """Return a signal at times within its run."""
    values = run.signals[name]
    if hold:
        return values[np.searchsorted(run.time, time, side="right") - 1]
    return np.interp(time, run.time, values)
