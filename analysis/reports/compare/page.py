"""The page that compares variants on the same trials: rates, pairs, trajectories, ends, commands, what is missing."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...campaigns.compare.comparison import Comparison, name_of
from ...campaigns.definition.campaign import Metric
from ...campaigns.judged import MetricLimits, worst_row
from ...campaigns.summary import SummaryRow
from ..campaign.recorded_names import CONSISTENCY, DIRECTIONS, KNOWN, LETTERS, AxisNames, names_of_record, variable_of
from ..campaign.tables import HEADINGS, anchors_of, fmu_rows, group_rows, variant_rows
from ..campaign.verdict_table import axis_start, verdict_table
from ..common.colours import Look
from ..common.page import write_page
from ..common.panels import Panel, swatch
from .bands import band_panels, bands_of, expectation, overlaid_bands
from .differences import significant_differences
from .dispersions import BULK, UNEVEN, UNITS, Dispersion, dispersion, dispersion_panels, ends_of, overlaid_ends
from .metrics import (
    LIMITS,
    MASS,
    NORMAL,
    all_values,
    distribution_panel,
    is_over_sigma,
    looks_of,
    make_distribution,
    sigma_rows,
    sort_metrics,
)
from .recorded import Flight, Quantity, quantities, read_flights, trials_with_traces
from .tables import metric_pairs, rate_pairs, trials_to_replay
from .trajectories import DRAWN, bundle_of, plan_panels, side_panels

KINDS = ("commands", "motion", "consistency", "other")


@dataclass(frozen=True)
class History:
    """A quantity over time: panels, all contenders in one and each, or its value where it is the same throughout."""

    quantity: Quantity
    together: list[Panel]
    panels: list[Panel]
    constant: float | None
    expected: tuple[float, ...]


@dataclass(frozen=True)
class End:
    """Final positions or velocities: all contenders in a panel, a panel of each to one scale, rows of the table."""

    what: str
    unit: str
    signal: str
    axes: AxisNames
    targets: list[str]
    together: list[Panel]
    panels: list[Panel]
    rows: dict[str, Dispersion]


def write_comparison_page(comparison: Comparison, path: Path, command: str) -> None:
    """Write one self-contained HTML page; the same results and command give the same bytes."""
    analyses = looks_of(comparison)
    flights = _flights(comparison)
    bundles = {
        label: bundle
        for label, flight in flights.items()
        if (bundle := bundle_of(comparison.contenders[label], flight)) is not None
    }
    histories = _histories(comparison, flights, analyses)
    ends = [end for variable in UNITS if (end := _end(comparison, variable, analyses)) is not None]
    displayed = make_distribution(comparison)
    plotted, still, empty = sort_metrics(displayed)
    errors = {metric: all_values(comparison, metric) for metric in comparison.metrics if is_over_sigma(metric)}
    first = comparison.first.document
    rows, grouped = variant_rows(comparison.summary), group_rows(comparison.summary)
    paired = [metric for metric in comparison.metrics if metric in plotted]
    rate_groups = rate_pairs(comparison)
    metric_groups = metric_pairs(comparison, paired, successful=True)
    verdicts = verdict_table(
        comparison.summary, paired, comparison.judged_expressions, lambda *each: _worst(comparison, *each)
    )
    judged = [each.metric for each in verdicts.metrics] or plotted
    replays = trials_to_replay(comparison, verdicts)
    write_page(
        path,
        Path(__file__).with_name("comparison.html"),
        title=f"{first['system']}: {len(comparison.contenders)} variants on the same trials",
        command=command,
        comparison=comparison,
        first=first,
        summary=comparison.summary,
        looks=[(swatch(style), label) for label, style in analyses.items()],
        swatches={label: swatch(style) for label, style in analyses.items()},
        rows=rows,
        group_rows=grouped,
        statistics=HEADINGS,
        rates=[(name_of(rate), rate, _axis_start(rows, name_of(rate))) for rate in comparison.rates],
        group_rates=[(name_of(rate), rate, _axis_start(grouped, name_of(rate))) for rate in comparison.rates],
        verdicts=verdicts,
        sentences=significant_differences(comparison, rate_groups, metric_groups),
        rate_pairs=rate_groups,
        metric_pairs=metric_groups,
        metric_pairs_all=metric_pairs(comparison, paired, successful=False),
        side=side_panels(bundles, analyses) if bundles else [],
        plan=plan_panels(bundles, analyses) if bundles else [],
        radius=next((bundle.radius for bundle in bundles.values() if bundle.radius is not None), None),
        plan_axes=next((bundle.axes for bundle in bundles.values()), LETTERS),
        over_ground=all(bundle.over_ground for bundle in bundles.values()),
        flights={label: len(flight) for label, flight in flights.items()},
        most_drawn=DRAWN,
        ends=ends,
        uneven=UNEVEN,
        bulk=BULK,
        distributions=[distribution_panel(metric, displayed[metric], analyses) for metric in judged],
        other_distributions=[
            distribution_panel(metric, displayed[metric], analyses) for metric in plotted if metric not in judged
        ],
        still=still,
        empty=empty,
        histories={kind: [flight for flight in histories if flight.quantity.kind == kind] for kind in KINDS},
        over_sigma=[metric.name for metric in errors],
        sigma_rows=sigma_rows(comparison),
        sigma_distributions=[
            distribution_panel(metric, errors[metric], analyses) for metric in sort_metrics(errors)[0]
        ],
        limits=[(limit, NORMAL[limit]) for limit in LIMITS],
        missing=missing_parts(
            comparison,
            flights,
            trajectories=bool(bundles),
            kinds={flight.quantity.kind for flight in histories},
            ends={end.what for end in ends},
        ),
        biased=is_biased(comparison, flights),
        replays=replays,
        anchors=anchors_of(replays),
        draws=[
            (name, float(values.min()), float(values.mean()), float(values.max()))
            for name, values in comparison.first.draws.items()
        ],
        fmus=[fmu_rows(batch.document["fmus"]) for batch in comparison.batches.values()],
    )


def _axis_start(rows: Iterable[SummaryRow], rate: str) -> float:
    return axis_start(row.entry.rates[rate].interval for row in rows)


def _worst(comparison: Comparison, label: str, metric: Metric, limits: MetricLimits) -> tuple[int, float]:
    """The worst trial of a contender, and the metric there."""
    values = comparison.values(label, metric.name)
    row, _ = worst_row(values, limits.excess)
    return int(comparison.contenders[label].trials.trial[row]), float(values[row])


def _flights(comparison: Comparison) -> dict[str, list[Flight]]:
    """The flights with traces that are shown, by contender."""
    trials = trials_with_traces(comparison.contenders.values())
    return {
        label: read_flights(contender, trials[label], names_of_record(contender.stored.document))
        for label, contender in comparison.contenders.items()
    }


def _histories(comparison: Comparison, flights: Mapping[str, list[Flight]], looks: Mapping[str, Look]) -> list[History]:
    by_label = {
        quantity.label: quantity for batch in comparison.batches.values() for quantity in quantities(batch.document)
    }
    histories = []
    for index, quantity in enumerate(by_label.values()):
        bands = {label: bands_of(quantity, retained) for label, retained in flights.items()}
        displayed = {label: band for label, band in bands.items() if band is not None and band.time.size}
        if not displayed:
            continue
        values = np.concatenate([band.finite_values() for band in displayed.values()])
        if values.size and np.ptp(values) == 0.0:  # the same throughout in all flights
            histories.append(History(quantity, [], [], float(values[0]), expectation(quantity)))
            continue
        together = overlaid_bands(quantity, displayed, looks, f"history{index}-all")
        panels = band_panels(quantity, displayed, looks, f"history{index}")
        histories.append(History(quantity, together, panels, None, expectation(quantity)))
    return histories


def _end(comparison: Comparison, variable: str, looks: Mapping[str, Look]) -> End | None:
    ends = {
        label: point
        for label, contender in comparison.contenders.items()
        if (point := ends_of(contender, variable)) is not None
    }
    if not ends:
        return None
    return End(
        what=variable,
        unit=UNITS[variable],
        signal=", ".join(dict.fromkeys(point.signal for point in ends.values())),
        axes=next(iter(ends.values())).axes,
        targets=list(dict.fromkeys(point.target for point in ends.values())),
        together=overlaid_ends(ends, looks, UNITS[variable], f"end-{variable}-all"),
        panels=dispersion_panels(ends, looks, UNITS[variable], f"end-{variable}"),
        rows={label: dispersion(point) for label, point in ends.items()},
    )


PATH = frozenset(KNOWN) - {*DIRECTIONS, *CONSISTENCY}  # what tells that something is under way


def missing_parts(
    comparison: Comparison,
    flights: Mapping[str, list[Flight]],
    *,
    trajectories: bool,
    kinds: Collection[str],
    ends: Collection[str],
) -> dict[str, str]:
    """By section, what the results lack and what the campaign must record for it.

    ``kinds`` are those of the quantities over time that there are, ``ends`` what final values there are of. Of what
    goes nowhere, such as an attitude, no trajectory, thrust, end or propellant is missed.
    """
    reasons = {}
    retained = {
        variable_of(batch.document, name) for batch in comparison.batches.values() for name in batch.document["signals"]
    }
    goes = not retained or bool(retained & PATH)  # without any signal it may go somewhere
    has_mass = any(metric.unit == MASS for metric in comparison.metrics) or any(
        variable_of(contender.stored.document, name) == "mass"
        for contender in comparison.contenders.values()
        for name in contender.trials.final
    )
    if not any(flights.values()):
        remedy = "give the campaign's [record] the keys every, signals and trials"
        reasons["trajectories"] = f"No trajectories and no commands over time: no flight has a trace; {remedy}."
    else:
        if goes and not trajectories:
            reasons["trajectories"] = "No trajectories: no position[1], [2] and [3] in m is among the recorded signals."
        if goes and "commands" not in kinds:
            words = "thrust_acceleration, thrust or thrust_direction"
            reasons["commands"] = f"No commands: no {words} is among the recorded signals."
        without = [label for label, traced in flights.items() if not traced]
        if without:
            reasons["traces"] = f"No flight has a trace: {', '.join(without)}."
    lacking = [variable for variable in UNITS if variable not in ends]
    if goes and lacking:
        words = " and ".join(lacking)
        reasons["ends"] = f"No dispersion of the final {words}: [record] final does not keep its three elements."
    if goes and not has_mass:
        reasons["propellant"] = "No propellant: no metric is in kg, and [record] final does not keep a mass."
    if "consistency" not in kinds and not any(is_over_sigma(metric) for metric in comparison.metrics):
        reasons["consistency"] = "No normalised estimation errors: no metric's name ends in _over_sigma."
    return reasons


def is_biased(comparison: Comparison, flights: Mapping[str, list[Flight]]) -> bool:
    """Whether what is shown over time is not the same trials of every contender, or failed ones only."""
    trials = {tuple(flight.trial for flight in retained) for retained in flights.values() if retained}
    records = [batch.document["record"] for batch in comparison.batches.values()]
    return len(trials) > 1 or any(record["every"] is None and record["traces"] == "failures" for record in records)
