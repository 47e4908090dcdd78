"""Figures of quantities over time: percentile bands over simulations, one figure per variant, on one scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ....chart.axes import linear_axis
from ....chart.lines import line
from ....chart.marks import band_areas, horizontal_line, note_above
from ....common.colours import FAINT, INK, Look
from ....common.panels import choose_length_unit
from ....common.quantities import display_factor, display_unit, number
from ....interactive.charts import NO_BOX, Area, Chart, Curve
from ....interactive.measures import FAILED_DASHES
from ....pictures import Figure
from .bands import Bands, expectation
from .recorded import ALL, FlightQuantity

REACH = 1.0  # largest range shown on either side of the expected band, over its width
HEIGHT = 2.1  # in
FAINT_BAND = 0.09  # opacity of 90 % bands in figures of all variants


@dataclass(frozen=True)
class QuantityFrame:
    """Scale common to all figures of a quantity: displayed factor and unit, limits in SI, expected percentiles."""

    factor: float
    unit: str
    time: tuple[float, float]
    low: float
    high: float
    expected: tuple[float, ...]
    held: bool

    def chart(self, curves: Sequence[Curve], areas: Sequence[Area], note: str = "") -> Chart:
        """Return the chart of ``curves``, with the range expected of a consistent filter's errors."""
        start, end = self.time
        margin = 0.06 * (self.high - self.low) or 0.06 * abs(self.high) or 1.0
        return Chart(
            NO_BOX,
            linear_axis((start, end + 0.02 * (end - start)), 5, label="time, s"),
            linear_axis((self.factor * (self.low - margin), self.factor * (self.high + margin)), 5, integer=self.held),
            curves=curves,
            areas=areas,
            rules=[horizontal_line(self.factor * at, INK, 0.9, FAILED_DASHES) for at in self.expected],
            notes=[note_above(note)] if note else [],
            title=self.unit,
        )


def frame_of(quantity: FlightQuantity, bands: Mapping[str, Bands]) -> QuantityFrame:
    """Return a common scale; failed simulations, and errors over sigma far beyond expectation, may exceed it."""
    expected = expectation(quantity)
    everything = np.concatenate([band.finite_values() for band in bands.values()] + [np.asarray(expected)])
    factor, unit = display_factor(quantity.unit), display_unit(quantity.unit)
    if quantity.unit == "m":
        factor, unit = choose_length_unit(everything)
    low, high = float(everything.min()), float(everything.max())
    if expected:
        room = REACH * (expected[-1] - expected[0])
        low, high = max(low, expected[0] - room), min(high, expected[-1] + room)
    start = min(band.time[0] for band in bands.values())
    end = max(time[-1] for band in bands.values() for time, _ in [(band.time, None), *band.singles])
    return QuantityFrame(factor, unit, (float(start), float(end)), low, high, expected, quantity.held)


def band_figures(
    quantity: FlightQuantity, bands: Mapping[str, Bands], styles: Mapping[str, Look], name: str
) -> list[Figure]:
    """Return a figure for each variant on one scale; a note states the range of a variant that exceeds it."""
    frame = frame_of(quantity, bands)
    return [
        Figure(
            label,
            f"{name}-{index}",
            f"{quantity.label} of {label} over time: percentiles over {band.flights} flights",
            band_chart(quantity, band, styles[label].colour, frame),
            HEIGHT,
            is_narrow=True,
            look=styles[label],
        )
        for index, (label, band) in enumerate(bands.items())
    ]


def band_chart(quantity: FlightQuantity, band: Bands, colour: str, frame: QuantityFrame) -> Chart:
    """Return the chart of a variant's median over time with 50 and 90 % bands, and some single simulations."""
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


def overlaid_bands(
    quantity: FlightQuantity, bands: Mapping[str, Bands], styles: Mapping[str, Look], name: str
) -> list[Figure]:
    """Return medians with 90 % bands of all variants, on the scale of their figures; none for a single variant.

    Bands of errors over sigma are omitted, since all should be equal and would hide each other.
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
    ]  # without names, which would take six lines at the cursor for six variants; the legend contains them
    words = f"Medians of {quantity.label} over time, {ALL}"
    chart = frame.chart(medians, areas)
    return [Figure(f"{quantity.label}, {ALL}", name, words, chart, HEIGHT, is_narrow=True)]
