"""Comparison of two runs: the difference of each signal, its greatest value and time, and signals of only one run."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...common.errors import InputError
from ..runtime.ssp.conversions import unit_by_name
from .recorded_run import RecordedRun


@dataclass(frozen=True, eq=False)
class SignalDifference:
    """A signal of both runs: its values ``first`` and ``second`` ([n], in ``unit``) at the common times.

    ``copy_of`` names an earlier signal with the same values in both runs (such as the output that drives an input), and
    is empty if there is none. ``axis`` names the axis of a vector's element, as stated by the first run that states
    one.
    """

    name: str
    unit: str | None
    first: np.ndarray
    second: np.ndarray
    copy_of: str
    axis: str = ""

    @cached_property
    def difference(self) -> np.ndarray:
        """``second`` minus ``first``, [n]; infinite if only one is finite, 0 if both are NaN or the same infinity."""
        with np.errstate(invalid="ignore", over="ignore"):
            difference = self.second - self.first
        same = (self.first == self.second) | (np.isnan(self.first) & np.isnan(self.second))
        return np.where(same, 0.0, np.where(np.isnan(difference), np.inf, difference))

    @property
    def differs(self) -> bool:
        """True if any sample differs."""
        return self.greatest > 0.0

    @property
    def row(self) -> int:
        """The index of the sample with the greatest difference."""
        return int(np.argmax(np.abs(self.difference)))

    @property
    def greatest(self) -> float:
        """The greatest magnitude of the difference, in ``unit``."""
        return float(np.abs(self.difference[self.row]))

    @cached_property
    def relative(self) -> float:
        """The greatest difference divided by the greatest finite magnitude of both signals."""
        if self.greatest == 0.0:
            return 0.0
        finite = np.concatenate([each[np.isfinite(each)] for each in (self.first, self.second)])
        return self.greatest / float(np.max(np.abs(finite), initial=0.0) or 1.0)


@dataclass(frozen=True, eq=False)
class RunDifferences:
    """Differences of two runs at their common ``time`` (s, [n]); ``signals`` by falling relative difference.

    If ``resampled`` is true, the sample times of the runs differ, and the second run is resampled at the times of the
    first: Reals are interpolated linearly, Integers and Booleans keep their last value. ``only`` lists the signals that
    only the first run has, and those that only the second run has. ``unlike`` lists signals with units that cannot be
    converted, as (name, unit in the first run, unit in the second run).
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
        """The signals that differ, without copies of earlier signals."""
        return [each for each in self.signals if each.differs and not each.copy_of]

    def split(self, tolerance: float) -> tuple[list[SignalDifference], list[SignalDifference]]:
        """Return the signals with a relative difference above ``tolerance``, and the signals with a smaller difference.

        Signals without a difference and copies are omitted.
        """
        beyond = [each for each in self.differing if each.relative > tolerance]
        return beyond, self.differing[len(beyond) :]


def compare_runs(first: RecordedRun, second: RecordedRun) -> RunDifferences:
    """Return the differences of two runs; signals are matched by name and converted to the units of the first run.

    Raises InputError for runs without a common time or a common signal.
    """
    rows = (first.time >= second.time[0]) & (first.time <= second.time[-1])
    if not rows.any():
        raise InputError(
            second.file, "time", f"no time in common with {first.file}", "compare runs that overlap in time"
        )
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
    """Return factor and offset of a unit conversion: (1, 0) if a unit is unknown, None if the dimensions differ."""
    if unit == into or unit is None or into is None:
        return 1.0, 0.0
    source, target = (replace(unit_by_name(name), is_relative=is_relative) for name in (unit, into))
    return source.conversion_to(target) if source.is_convertible(target) else None


def _sample(run: RecordedRun, name: str, time: np.ndarray, *, hold: bool) -> np.ndarray:
    """Return a signal at times within its run: linearly interpolated or, with ``hold``, the latest sample."""
    values = run.signals[name]
    if hold:
        return values[np.searchsorted(run.time, time, side="right") - 1]
    return np.interp(time, run.time, values)
