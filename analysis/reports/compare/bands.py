"""Quantities over time: bands of percentiles over flights, a panel per contender, one scale in all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2, norm

from ...campaigns.verdicts.order_statistics import quantiles
from ..campaign.recorded_names import RATIO
from ..chart.axes import linear_axis
from ..chart.lines import line
from ..chart.marks import band_areas, level, note_above
from ..chart.panel import chart_panel
from ..common.colours import FAINT, INK, Look
from ..common.panels import Panel, far
from ..common.quantities import display_factor, display_unit, number
from ..interactive.charts import NO_BOX, Area, Chart, Curve
from ..interactive.measures import FAILED_DASHES
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

    def chart(self, curves: Sequence[Curve], areas: Sequence[Area], note: str = "") -> Chart:
        """Return the chart of ``curves``, and where the errors of a consistent filter would lie."""
        start, end = self.time
        margin = 0.06 * (self.high - self.low) or 0.06 * abs(self.high) or 1.0
        return Chart(
            NO_BOX,
            linear_axis((start, end + 0.02 * (end - start)), 5, label="time, s"),
            linear_axis((self.factor * (self.low - margin), self.factor * (self.high + margin)), 5, integer=self.held),
            curves=curves,
            areas=areas,
            rules=[level(self.factor * at, INK, 0.9, FAILED_DASHES) for at in self.expected],
            notes=[note_above(note)] if note else [],
        )


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


def band_panels(quantity: Quantity, bands: Mapping[str, Bands], styles: Mapping[str, Look], name: str) -> list[Panel]:
    """Return a panel per contender, all to one scale; a note states the range of one that exceeds it."""
    frame = frame_of(quantity, bands)
    return [
        chart_panel(
            label,
            f"{name}-{index}",
            f"{quantity.label} of {label} over time: percentiles over {band.flights} flights",
            band_chart(quantity, band, styles[label].colour, frame),
            HEIGHT,
            title=frame.unit,
        )
        for index, (label, band) in enumerate(bands.items())
    ]


def band_chart(quantity: Quantity, band: Bands, colour: str, frame: Frame) -> Chart:
    """Return the median of a contender's flights over time with the bands of 50 and 90 %, and some flights."""
    rows, steps = frame.factor * band.percentiles, quantity.held
    areas = [
        area
        for low, high, opacity in ((0, 4, 0.18), (1, 3, 0.32))
        for area in band_areas(band.time, rows[low], rows[high], colour, opacity, steps=steps)
    ]
    failed = [
        line(time, frame.factor * numbers, INK, width=0.6, dashes=FAILED_DASHES, opacity=0.45, steps=steps)
        for time, numbers in band.failed
    ]
    singles = [line(time, frame.factor * numbers, FAINT, width=0.6, steps=steps) for time, numbers in band.singles]
    median = line(band.time, rows[2], colour, width=1.8, steps=steps, name="median", unit=frame.unit)
    ends = (float(band.finite_values().min()), float(band.finite_values().max()))
    is_clipped = not all(frame.low <= end <= frame.high for end in ends)
    low, high = (number(frame.factor * end, 3) for end in ends)
    note = f"clipped; full range {low} to {high}" if is_clipped else ""
    return frame.chart([*failed, *singles, median], areas, note)


def expectation(quantity: Quantity) -> tuple[float, ...]:
    """Where LEVELS' outer percentiles and median of a consistent filter's errors would lie; empty for others."""
    variable = quantity.variable
    if variable == "normalised_error_square":
        return tuple(float(chi2.ppf(level / 100.0, STATES)) for level in LEVELS[::2])
    if variable.endswith(RATIO):
        return tuple(float(norm.ppf(level / 100.0)) for level in LEVELS[::2])
    return ()


def overlaid_bands(
    quantity: Quantity, bands: Mapping[str, Bands], styles: Mapping[str, Look], name: str
) -> list[Panel]:
    """Medians with the bands of nine tenths, to the scale of the contenders' own panels; none of a single one.

    Bands of errors over sigma would hide each other, since all are to be the same.
    """
    if len(bands) < 2:
        return []
    frame, steps = frame_of(quantity, bands), quantity.held
    rows = {label: frame.factor * band.percentiles for label, band in bands.items()}
    areas = [
        area
        for label, band in bands.items()
        if quantity.kind != "consistency"
        for area in band_areas(
            band.time, rows[label][0], rows[label][-1], styles[label].colour, FAINT_BAND, steps=steps
        )
    ]
    medians = [
        line(band.time, rows[label][2], styles[label].colour, dashes=styles[label].lengths, steps=steps)
        for label, band in bands.items()
    ]  # without names: at the cursor, those of six variants would take six lines; the legend has them
    description = f"Medians of {quantity.label} over time, {ALL}"
    return [
        chart_panel(
            f"{quantity.label}, {ALL}", name, description, frame.chart(medians, areas), HEIGHT, title=frame.unit
        )
    ]
