"""Quantities over time: bands of percentiles over flights, a panel per contender, one scale in all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from scipy.stats import chi2, norm

from ...campaigns.verdicts.order_statistics import quantiles
from ..campaign.recorded_names import RATIO
from ..common.panels import Panel, far, panel
from ..common.quantities import display_factor, display_unit, number
from ..common.style import FAILED, FAINT, Look, plain_ticks
from .recorded import ALL, Flight, Quantity, doubling

LEVELS = (5.0, 25.0, 50.0, 75.0, 95.0)  # %
MOST_TIMES = 300  # of a band
FEWEST = 0.25  # share of the flights; where fewer still fly the bands end
SINGLES, FAILURES = 4, 2  # successful and failed flights drawn one by one
STATES = 6  # of the filter whose normalised error square is monitored: position and velocity
REACH = 1.0  # widths of the expected band that are shown on either side of it at most
HEIGHT = 2.1  # in
FAINT_BAND = 0.09  # opacity of the 90 % bands where those of all variants overlap
History = tuple[np.ndarray, np.ndarray]  # times (s) and values


@dataclass(frozen=True)
class Bands:
    """Percentiles (LEVELS by rows) of a quantity at ``time`` (s) over ``flights`` flights, in SI.

    They are the successful ones, and where there is none the failed ones. ``singles`` are a few of
    them one by one, ``failed`` some others that failed.
    """

    time: np.ndarray
    percentiles: np.ndarray
    flights: int
    singles: list[History]
    failed: list[History]

    def finite_values(self) -> np.ndarray:
        """All finite values of the bands and of the single flights in them."""
        values = np.concatenate([self.percentiles.ravel(), *(row for _, row in self.singles)])
        return values[np.isfinite(values)]


def bands_of(quantity: Quantity, flights: Sequence[Flight]) -> Bands | None:
    """Percentiles over the flights that still fly at a time; None without a flight that has the quantity.

    Times are rows of the longest flight, which are rows of the others too as long as they fly; where not, a
    value is interpolated linearly, or held if it is a whole number or a truth. A command in the last row of a
    flight never acts and is left out. Errors over sigma are told over all flights, failed ones included.
    """
    good, bad = (
        [_history(quantity, flight) for flight in flights if flight.success == success and _has(flight, quantity)]
        for success in (True, False)
    )
    histories = good + bad if quantity.kind == "consistency" else good or bad
    if not histories:
        return None
    longest = max((time for time, _ in histories), key=lambda time: float(time[-1]))
    grid = longest[:: doubling(longest.size / MOST_TIMES)]
    values = np.stack([_resample(grid, time, row, quantity.held) for time, row in histories])
    flying = np.sum(np.isfinite(values), axis=0)
    enough = flying >= max(1.0, FEWEST * len(histories))
    percentiles = quantiles(values[:, enough], [level / 100.0 for level in LEVELS])
    failed = bad[:FAILURES] if good and quantity.kind != "consistency" else []
    return Bands(grid[enough], percentiles, len(histories), histories[:SINGLES], failed)


def _has(flight: Flight, quantity: Quantity) -> bool:
    return flight.time.size > 1 and set(quantity.names) <= set(flight.signals)


def _history(quantity: Quantity, flight: Flight) -> History:
    rows = slice(0, -1 if quantity.kind == "commands" and flight.is_whole else None)
    return flight.time[rows], quantity.values(flight.signals)[rows]


def _resample(grid: np.ndarray, time: np.ndarray, values: np.ndarray, held: bool) -> np.ndarray:
    """Values at the times of a grid; nan where the flight does not fly."""
    margin = 1e-9 * max(1.0, abs(time[-1]))
    inside = (grid >= time[0] - margin) & (grid <= time[-1] + margin)
    if held:
        samples = values[np.clip(np.searchsorted(time, grid + margin, side="right") - 1, 0, time.size - 1)]
    else:
        samples = np.interp(grid, time, values)
    return np.where(inside, samples, np.nan)


@dataclass(frozen=True)
class Frame:
    """What all panels of a quantity have in common: factor and unit shown, limits in SI, what is expected."""

    factor: float
    unit: str
    time: tuple[float, float]
    low: float
    high: float
    expected: tuple[float, ...]
    held: bool

    def dress(self, axes: Axes) -> None:
        """Limits, labels, and where the errors of a consistent filter would lie."""
        for value in self.expected:
            axes.axhline(self.factor * value, linewidth=0.9, **FAILED)
        start, end = self.time
        margin = 0.06 * (self.high - self.low) or 0.06 * abs(self.high) or 1.0
        axes.set_xlim(start, end + 0.02 * (end - start))
        axes.set_ylim(self.factor * (self.low - margin), self.factor * (self.high + margin))
        axes.set_xlabel("time, s")
        axes.set_ylabel(self.unit)
        plain_ticks(axes, x=5, y=5, whole_y=self.held)


def frame_of(quantity: Quantity, bands: Mapping[str, Bands]) -> Frame:
    """One scale for all, which failed flights may leave, and errors over sigma far beyond what is to be expected."""
    expected = expectation(quantity)
    everything = np.concatenate([band.finite_values() for band in bands.values()] + [np.asarray(expected)])
    factor, unit = display_factor(quantity.unit), display_unit(quantity.unit)
    if quantity.unit == "m":
        factor, unit = far(everything)
    low, high = float(everything.min()), float(everything.max())
    if expected:
        room = REACH * (expected[-1] - expected[0])
        low, high = max(low, expected[0] - room), min(high, expected[-1] + room)
    start = min(band.time[0] for band in bands.values())
    end = max(time[-1] for band in bands.values() for time, _ in [(band.time, None), *band.singles])
    return Frame(factor, unit, (float(start), float(end)), low, high, expected, quantity.held)


def band_panels(quantity: Quantity, bands: Mapping[str, Bands], looks: Mapping[str, Look], name: str) -> list[Panel]:
    """A panel per contender, all to one scale; one whose errors over sigma leave it says how far they go."""
    frame = frame_of(quantity, bands)
    panels = []
    for index, (label, band) in enumerate(bands.items()):

        def draw(axes: Axes, band: Bands = band, colour: str = looks[label].colour) -> None:
            _draw(axes, band, frame.factor, colour, quantity.held)
            frame.dress(axes)
            ends = (band.finite_values().min(), band.finite_values().max())
            if not all(frame.low <= value <= frame.high for value in ends):
                low, high = (number(frame.factor * float(value), 3) for value in ends)
                axes.set_title(f"clipped; full range {low} to {high}", loc="right", fontsize=8.0, color=FAINT)

        description = f"{quantity.label} of {label} over time: percentiles over {band.flights} flights"
        panels.append(panel(label, f"{name}-{index}", description, draw, HEIGHT))
    return panels


def _draw(axes: Axes, bands: Bands, factor: float, colour: str, held: bool) -> None:
    rows = factor * bands.percentiles
    style = "steps-post" if held else "default"
    for low, high, shade in ((0, 4, 0.18), (1, 3, 0.32)):
        axes.fill_between(
            bands.time, rows[low], rows[high], color=colour, alpha=shade, linewidth=0.0, step="post" if held else None
        )
    for time, values in bands.failed:
        axes.plot(time, factor * values, linewidth=0.6, alpha=0.45, zorder=0.9, drawstyle=style, **FAILED)
    for time, values in bands.singles:
        axes.plot(time, factor * values, color=FAINT, linewidth=0.6, drawstyle=style)
    axes.plot(bands.time, rows[2], color=colour, linewidth=1.8, drawstyle=style)


def expectation(quantity: Quantity) -> tuple[float, ...]:
    """Where LEVELS' outer percentiles and median of a consistent filter's errors would lie; empty for others."""
    variable = quantity.variable
    if variable == "normalised_error_square":
        return tuple(float(chi2.ppf(level / 100.0, STATES)) for level in LEVELS[::2])
    if variable.endswith(RATIO):
        return tuple(float(norm.ppf(level / 100.0)) for level in LEVELS[::2])
    return ()


def overlaid_bands(quantity: Quantity, bands: Mapping[str, Bands], looks: Mapping[str, Look], name: str) -> list[Panel]:
    """Medians with the bands of nine tenths, to the scale of the contenders' own panels; none of a single one.

    Bands of errors over sigma would hide each other, since all are to be the same.
    """
    if len(bands) < 2:
        return []
    frame = frame_of(quantity, bands)
    shaded = bands if quantity.kind != "consistency" else {}

    def draw(axes: Axes) -> None:
        for label, band in shaded.items():
            rows, style = frame.factor * band.percentiles, looks[label]
            axes.fill_between(
                band.time, rows[0], rows[-1], color=style.colour, alpha=FAINT_BAND, linewidth=0.0,
                step="post" if quantity.held else None,
            )  # fmt: skip
        for label, band in bands.items():
            median, style = frame.factor * band.percentiles[2], looks[label]
            steps = "steps-post" if quantity.held else "default"
            axes.plot(band.time, median, color=style.colour, linestyle=style.dashes, drawstyle=steps)
        frame.dress(axes)

    return [panel(f"{quantity.label}, {ALL}", name, f"Medians of {quantity.label} over time, {ALL}", draw, HEIGHT)]
