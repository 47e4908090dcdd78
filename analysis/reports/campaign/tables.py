"""Rows and headings of the tables on pages of a campaign: variants, requirements, correlations, statuses, replays."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from markupsafe import Markup

from ...campaigns.definition.campaign import Campaign, Metric
from ...campaigns.draws.declared import input_names
from ...campaigns.execute.evaluation import worst_statuses
from ...campaigns.execute.results import BatchResult
from ...campaigns.requirement_verdicts import RequirementVerdict
from ...campaigns.statistics import QUANTILES, STATISTICS
from ...campaigns.summary import Summary, SummaryRow, summary_rows
from ...campaigns.tables import bound_text, requirement_rows, unevaluated_text
from ...campaigns.trials import TrialTable
from ...commands.campaigns import replay_command, replay_of_folder
from ...studies.sobol import rank_correlations
from ..common.page import exact
from ..common.quantities import display_unit, in_display_unit, number
from .verdict_table import JudgedMetric, VerdictRow, VerdictTable

HEADINGS = {name: f"{QUANTILES[name]} %" if name in QUANTILES else name for name in STATISTICS}


def variant_rows(summary: Summary) -> list[SummaryRow]:
    """A row per variant, over all its trials."""
    return [row for row in summary_rows(summary) if row.group is None]


def group_rows(summary: Summary) -> list[SummaryRow]:
    """A row per variant and group of its trials, groups of a variant together."""
    return [row for row in summary_rows(summary) if row.group is not None]


class RequirementRow(NamedTuple):
    """A requirement of a variant: its verdict in the summary; as text its bound, or the metrics that no trial has."""

    variant: str
    name: str
    description: str
    verdict: RequirementVerdict
    bound: str


def verdict_rows(summary: Summary, campaign: Campaign) -> list[RequirementRow]:
    """A row per requirement and variant, variants of a requirement together."""
    described = {requirement.name: requirement.description for requirement in campaign.requirements}
    units = {metric.name: metric.unit for metric in campaign.metrics}
    return [
        RequirementRow(variant, name, described[name], verdict, _bound(verdict, units))
        for variant, name, verdict in requirement_rows(summary)
    ]


def _bound(result: RequirementVerdict, units: Mapping[str, str]) -> str:
    if result.unevaluated or result.bound is None:
        return unevaluated_text(result)
    unit = units[result.bound.metric]
    return bound_text(result, f"{number(in_display_unit(result.bound.value, unit))} {display_unit(unit)}".strip())


MOST_INPUTS = 3  # of a metric


class Driver(NamedTuple):
    """A metric of a variant, and its most correlated inputs: their names and rank correlations."""

    variant: str
    metric: str
    inputs: list[tuple[str, float]]


def drivers(result: BatchResult) -> list[Driver]:
    """A row for each metric of each variant that has a rank correlation, the largest first."""
    names = input_names(result.plan.campaign)
    rows = []
    for variant, sample in result.plotted.items():
        trials = sample.first
        draws = {name: trials.draws[name] for name in names}
        for metric, correlations in rank_correlations(draws, trials.metrics).items():
            known = [(name, rho) for name, rho in correlations.items() if rho is not None]
            known.sort(key=lambda item: -abs(item[1]))
            if known:
                rows.append(Driver(variant, metric, known[:MOST_INPUTS]))
    return rows


class ComponentStatus(NamedTuple):
    """The highest status that a signal of a variant reported, in ``occurrences`` of ``trials``."""

    variant: str
    signal: str
    status: int
    occurrences: int
    trials: int


def component_statuses(result: BatchResult) -> list[ComponentStatus]:
    """Counts by variant, signal and status; none if no trial reported two, as the termination statuses suffice then."""
    if not any(len(worst_statuses(text)) > 1 for entry in result.summary.values() for text in entry.statuses):
        return []
    rows = []
    for variant, entry in result.summary.items():
        counts: Counter[tuple[str, int]] = Counter()
        for text, trials in entry.statuses.items():
            counts.update(dict.fromkeys(worst_statuses(text).items(), trials))
        rows += [ComponentStatus(variant, *status, count, entry.trials) for status, count in sorted(counts.items())]
    return rows


def draw_rows(campaign: Campaign) -> list[tuple[str, str, str]]:
    """Return name, distribution and arguments of dispersed parameters, then derived ones, and tables of lookups."""
    rows = []
    for draw in campaign.draws:
        distribution = draw.distribution
        rows.append((", ".join(draw.names), distribution.keyword.replace("_", " "), distribution.describe()))
    rows += [(name, "derived", " ".join(formula.text.split())) for name, formula in campaign.derived.items()]
    return rows + [(each.name, "lookup", f"{each.column} of {each.file}") for each in campaign.lookups]


def fmu_rows(fmus: dict[str, dict[str, str]]) -> list[tuple[str, str, str]]:
    """Component, variants and SHA-256 of every FMU, variants with the same FMU in one row."""
    variants_of: dict[tuple[str, str], list[str]] = {}
    for variant, components in fmus.items():
        for component, digest in components.items():
            variants_of.setdefault((component, digest), []).append(variant)
    return [
        (component, "all" if len(variants) == len(fmus) else ", ".join(variants), digest)
        for (component, digest), variants in sorted(variants_of.items(), key=lambda item: item[0][0])
    ]


FAILURES = 3  # of a variant, the first ones


@dataclass(frozen=True)
class Replay:
    """A trial of a variant, the reasons to replay it, and the command that does."""

    variant: str
    trial: int
    reasons: list[Markup]
    command: str
    anchor: str = ""


def trials_to_replay(result: BatchResult, table: VerdictTable) -> list[Replay]:
    """The first failures of each variant, and its worst trials of metrics with limits; rows have anchors."""
    worst = {row.variant: worst_reasons(row, table.metrics) for row in table.rows}
    replays = _replays(result, lambda result, variant: _failures(result, variant) + worst[variant])
    return with_anchors(replays)


def with_anchors(replays: Sequence[Replay]) -> list[Replay]:
    """Return rows with an anchor each, no two of one variant and trial."""
    return [replace(each, anchor=f"replay-{number}") for number, each in enumerate(replays)]


def anchors_of(replays: Iterable[Replay]) -> dict[tuple[str, int], str]:
    """Return the anchors of rows by variant and trial."""
    return {(each.variant, each.trial): each.anchor for each in replays}


def worst_reasons(row: VerdictRow, metrics: Sequence[JudgedMetric]) -> list[tuple[int, Markup]]:
    """Return the worst trials of a variant, each with the metric and its value there."""
    return [
        (cell.trial, _reason(Markup("worst "), judged.metric, cell.worst))
        for judged, cell in zip(metrics, row.numbers, strict=True)
        if cell.trial is not None
    ]


def _reason(which: Markup, metric: Metric, value: float | None) -> Markup:
    return Markup("{}{}: {} {}").format(which, metric.name, exact(value, metric.unit), display_unit(metric.unit))


def extremes_to_replay(result: BatchResult) -> list[Replay]:
    """The trials with the maximum of a metric of a variant, each once."""
    return _replays(result, _extremes)


def _replays(result: BatchResult, choose: Callable[[BatchResult, str], list[tuple[int, Markup]]]) -> list[Replay]:
    replays: list[Replay] = []
    for variant in result.plan.campaign.variants():
        reasons: dict[int, list[Markup]] = {}
        for trial, reason in choose(result, variant.name):
            reasons.setdefault(trial, []).append(reason)
        for trial, texts in reasons.items():
            if result.folder is None:
                command = replay_command(result.plan, variant, trial)
            else:
                command = replay_of_folder(result.folder, result.rows, variant.name, trial)
            replays.append(Replay(variant.name, trial, texts, command))
    return replays


def _failures(result: BatchResult, variant: str) -> list[tuple[int, Markup]]:
    failures: list[tuple[int, Markup]] = []
    for part in result.rows[variant].parts("trial", "success", "status"):
        for row in np.flatnonzero(~part["success"])[: FAILURES - len(failures)]:
            failures.append((int(part["trial"][row]), Markup("{}").format(part["status"][row])))
        if len(failures) == FAILURES:
            break
    return failures


def _extremes(result: BatchResult, variant: str) -> list[tuple[int, Markup]]:
    """The trial with the maximum of each metric, unless several trials have it."""
    extremes = []
    for metric in result.plan.campaign.metrics:
        maximum, trials = _maximum(result.rows[variant], f"metric.{metric.name}")
        if len(trials) == 1:
            extremes.append((trials[0], _reason(Markup(), metric, maximum)))
    return extremes


def _maximum(rows: TrialTable, column: str) -> tuple[float, list[int]]:
    """The maximum of a column, nan counting as minus infinity, and up to two of the trials that have it."""
    maximum, trials = -np.inf, list[int]()
    for part in rows.parts("trial", column):
        values = np.where(np.isnan(part[column]), -np.inf, part[column])
        if values.max() > maximum:
            maximum, trials = float(values.max()), []
        trials += part["trial"][np.flatnonzero(values == maximum)[: 2 - len(trials)]].tolist()
    return maximum, trials
