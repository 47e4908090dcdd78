"""Sections on recorded simulations: trajectories, final errors, commands and motion over time, estimation errors."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from ....cell import Inline, Quantity, Rich
from ....model import Group, Missing, Node, Note, Section, Text
from ....pictures import Figure, Figures
from ...campaign.recorded_names import LETTERS
from ..content import ComparisonContent
from ..sigma import is_over_sigma, sigma_rows, sigma_table
from ..variant_distributions import all_values, metric_figures, overlaid_figures, sort_metrics
from .end_figures import BULK, UNEVEN, dispersion_figures, overlaid_ends
from .ends import dispersion_table
from .history_nodes import constant_notes, histories_by_variant, overlaid_histories
from .missing import is_biased
from .trajectories import DRAWN
from .trajectory_figures import plan_figures, side_figures

SIGMA = "\N{GREEK SMALL LETTER SIGMA}"
OVER_TIME = ("commands", "motion", "other")


def missing_nodes(content: ComparisonContent, *keys: str) -> list[Node]:
    """Return statements on data that the results lack."""
    return [Missing(content.missing[key]) for key in keys if key in content.missing]


def trajectory_section(content: ComparisonContent) -> list[Section]:
    """Return the section of trajectories in side and plan view, and of missing data."""
    nodes = missing_nodes(content, "trajectories", "traces")
    if is_biased(content.comparison, content.flights.by_label):
        nodes.append(
            Missing(
                "the plotted flights are not the same trials in every variant, or are only failed trials: do not "
                "compare their spread"
            )
        )
    bundles = content.flights.bundles
    if bundles:
        nodes += [
            Group("Altitude vs. downrange", [Figures(partial(side_figures, bundles, content.styles))]),
            Group("Ground track", [Figures(partial(plan_figures, bundles, content.styles))]),
            _trajectory_note(content),
        ]
    return [Section("Trajectories", nodes)] if nodes else []


def _trajectory_note(content: ComparisonContent) -> Note:
    bundles = content.flights.bundles.values()
    radius = next((each.radius for each in bundles if each.radius is not None), None)
    axes = next((each.axes for each in bundles), LETTERS)
    over_ground = all(each.over_ground for each in bundles)
    downrange = (
        "along the horizontal line from a flight's start to its target (dotted)"
        if radius is None
        else f"along the ground to the target (dotted), over a sphere of {radius / 1000:.1f} km radius, as the "
        "recorded altitude shows it"
    )
    ground = (
        "; grey: the ground at altitude 0"
        if over_ground
        else ". No altitude is recorded: the side view shows an element of the position, not a height above the ground"
    )
    return Note(
        f"Up to {DRAWN} flights of each, the same trials in every panel, to the same scales; side views are not to "
        "scale. Dark and dashed: flights that failed, which may leave the frame. Downrange is "
        f"{downrange}{ground}. The ring is the target; {' and '.join(axes[:2])} are elements 1 and 2 of the position."
    )


def end_section(content: ComparisonContent) -> list[Section]:
    """Return the section of final errors, all variants in a figure per variable."""
    ends = content.ends
    nodes = missing_nodes(content, "ends")
    if any(len(each) > 1 for each in ends.values()):
        nodes += [overlaid_figures(partial(_overlaid, content), content.styles), Note(f"{OVERLAID} {ARROW}")]
    for variable, of_all in ends.items():
        signals = ", ".join(dict.fromkeys(each.signal for each in of_all.values()))
        targets = list(dict.fromkeys(each.target for each in of_all.values()))
        zero = f"zero, since no parameter of the system is called target_{variable}"
        nodes.append(Note(f"{signals} minus {', '.join(targets) if targets[0] else zero}, at the end of the flight."))
    return [Section("At the end", nodes)] if nodes else []


def _overlaid(content: ComparisonContent) -> list[Figure]:
    return [
        figure
        for variable, of_all in content.ends.items()
        for figure in overlaid_ends(of_all, content.styles, f"end-{variable}-all")
    ]


def time_sections(content: ComparisonContent) -> list[Section]:
    """Return the sections of commands and motion over time: all variants in one figure, and each variant."""
    histories = content.flights.of_kinds(*OVER_TIME)
    overlaid = overlaid_histories(histories, content.styles)
    each_variant = histories_by_variant(histories, content.styles)
    has_several = len(content.comparison.contenders) > 1
    nodes = missing_nodes(content, "commands")
    if histories:
        nodes += [_bands_text(content), *(overlaid if has_several else each_variant), *constant_notes(histories)]
    elif "trajectories" in content.missing:
        nodes.append(Missing("nothing is recorded over time"))
    sections = [Section("Commands and motion over time", nodes)]
    if has_several and each_variant:
        sections.append(Section("Commands and motion, each variant", each_variant, is_folded=True))
    return sections


def _bands_text(content: ComparisonContent) -> Text:
    numbers = {label: len(flights) for label, flights in content.flights.by_label.items()}
    counts: Rich
    if len(set(numbers.values())) == 1:
        counts = [Quantity(next(iter(numbers.values()))), " of each"]
    else:
        listed: list[list[Inline]] = [[", ", f"{label} ", Quantity(count)] for label, count in numbers.items()]
        counts = [inline for each in listed for inline in each][1:]
    return Text([
        "over the flights with a trace (",
        *counts,
        "): median of the successful ones, with 50 % and 90 % bands of the trials still active at a time, quantiles "
        "as in the tables. They end where fewer than a quarter are active. Grey: some individual flights; dark "
            "and dashed: some failed flights, which may leave the frame",
    ])  # fmt: skip


def ends_by_variant_section(content: ComparisonContent) -> list[Section]:
    """Return the section of each variant's final errors with statistics, folded if a figure shows all variants."""
    nodes: list[Node] = []
    for variable, of_all in content.ends.items():
        figures = partial(dispersion_figures, of_all, content.styles, f"end-{variable}")
        nodes.append(
            Group(
                f"Final {variable} about the target",
                [Figures(figures), dispersion_table(of_all, content.styles), Note(ENDS)],
            )
        )
    has_overlaid = any(len(each) > 1 for each in content.ends.values())
    return [Section("Ends of each variant", nodes, is_folded=has_overlaid)] if nodes else []


OVERLAID = (
    f"Ellipses: 3{SIGMA} of the sample covariance of a variant's successful trials about their mean, the cross; they "
    "contain 98.9 % of a bivariate normal distribution."
)
ARROW = (
    "An arrow at the edge points to the farthest trial or ellipse outside of the panel; its length has no scale. "
    "The text above it states how many are outside, and the distance of the farthest from the target."
)
ENDS = (
    f"Table, ellipses (1, 2 and 3{SIGMA} of the sample covariance, about the mean, which "
    "is the cross) and dots: successful trials. Grey crosses: failed ones. All panels have one scale. It contains the "
    f"successful trials and ellipses of all variants, but reaches at most to {UNEVEN:g} times the distance along x and "
    f"y within which {100 * BULK:g} % of the successful trials of the least dispersed variant end. {ARROW} At least 50 "
    f"and 99 % of the successful trials end within the miss distances of these columns. The 1, 2 and 3{SIGMA} ellipses "
    "contain 39.3, 86.5 and 98.9 % of a bivariate normal distribution."
)


def error_section(content: ComparisonContent) -> list[Section]:
    """Return the section of errors over the filter's standard deviation, at the end and over time."""
    compared, styles = content.comparison, content.styles
    nodes = missing_nodes(content, "consistency")
    rows = sigma_rows(compared)
    if rows:
        nodes += [sigma_table(rows, styles), Note(CONSISTENT), *_error_distributions(content)]
    histories = content.flights.of_kinds("consistency")
    if histories:
        nodes += [
            *overlaid_histories(histories, styles),
            *constant_notes(histories),
            *histories_by_variant(histories, styles),
            Note(
                "Over all flights with a trace, failed ones included. Dashed: where the median and the ends of the "
                "wider band would lie for a consistent filter (normal; chi-square of six for the normalised error "
                "square)."
            ),
        ]
    return [Section("Normalised estimation errors", nodes, is_folded=True)]


CONSISTENT = (
    "Trials whose value is finite and not 0, which stands for no covariance. A consistent filter's errors at a fixed "
    "time are normal with deviation 1. Bold: the 95 % interval does not contain the normal share."
)


def _error_distributions(content: ComparisonContent) -> Sequence[Node]:
    compared, styles = content.comparison, content.styles
    errors = {metric: all_values(compared, metric) for metric in compared.metrics if is_over_sigma(metric)}
    varying, _, _ = sort_metrics(errors)
    if not varying:
        return []
    return [
        overlaid_figures(partial(metric_figures, errors, varying, styles), styles),
        Note(
            "Cumulative over all trials; a curve that ends below 100 % has trials without such a value. Dashed: the "
            "normal distribution."
        ),
    ]
