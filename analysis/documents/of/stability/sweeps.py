"""Margins over parameters: figures, and the crossings of limits in each sweep."""

from __future__ import annotations

from ....stability.loops.margin_values import MarginQuantity
from ....stability.results.report import StabilityStudy
from ....stability.results.varied import SweepReport
from ...common.quantities import label_with_unit
from ...model import Fold, Group, Node, Note, Table
from ...pictures import Figures
from .figures import sweep_figure
from .study_cells import UNSTABLE_WORD, gain_margin, numbers, numeral, phase_margin, size


def sweep_nodes(report: StabilityStudy) -> list[Node]:
    """Return the nodes of all sweeps of a study."""
    return [
        Figures(
            lambda: [sweep_figure(sweep, report, f"sweep-{index + 1}") for index, sweep in enumerate(report.sweeps)]
        ),
        Note(
            "Dashed: limits. Dotted: where they are crossed. Hatched: unstable. A gain margin below 0 dB is a "
            "lower margin, a phase margin below 0 is a phase lead, and gaps have no margin."
        ),
        *(
            Group(
                sweep.name,
                [
                    crossing_table(sweep) if sweep.crossings else Note("No limit is crossed in this range."),
                    Fold(f"All {sweep.values.size} values of {sweep.parameter}", [value_table(sweep)]),
                ],
            )
            for sweep in report.sweeps
        ),
    ]


def value_table(sweep: SweepReport) -> Table:
    """Return the table of margins at each value of the parameter."""
    rows = [
        (
            numeral(float(value), sweep.unit),
            gain_margin(margins),
            phase_margin(margins),
            size(margins.size(MarginQuantity.MODULUS)),
        )
        for value, margins in zip(sweep.values, sweep.margins, strict=True)
    ]
    return Table(numbers(sweep.parameter, "gain margin, dB", "phase margin, deg", "modulus margin"), rows)


def crossing_table(sweep: SweepReport) -> Table:
    """Return the table of the parameter values at which limits are crossed."""
    rows = [
        (
            UNSTABLE_WORD if crossing.quantity is MarginQuantity.STABILITY else f"{crossing.quantity} misses its limit",
            "below" if crossing.below else "above",
            numeral(crossing.value, sweep.unit),
        )
        for crossing in sweep.crossings
    ]
    return Table(["what fails", "where", *numbers(label_with_unit(sweep.parameter, sweep.unit))], rows)
