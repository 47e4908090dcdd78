"""Comparison of the variants of stored batches: rates, metrics, and pairs of contenders on the same trials."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ....common.percent import percent
from ....common.to_json import to_json
from ..definition.campaign import Metric, TrialGroup
from ..definition.expressions import Expression
from ..folder.stored import StoredBatch
from ..plain_text import faults_line
from ..summary import CONFIDENCE, Rate, Summary, VariantSummary, success_rate, summarise, summary_rows
from ..summary_text import metric_lines, rate_lines, select_metrics
from ..tables import group_cells, group_headings
from ..trial_columns import describe_metrics
from ..trials import TrialTable
from .paired import PairedRates, PairedValues, compare_rates, compare_values

SUCCESS = "success"
NO_FAULTS = "without faults"


@dataclass(frozen=True)
class Contender:
    """A variant of a batch; the numbers ``batch`` and ``variant`` determine its colour and marker in figures."""

    label: str
    stored: StoredBatch
    name: str
    batch: int
    variant: int

    @property
    def trials(self) -> TrialTable:
        return self.stored.variants[self.name]


@dataclass(frozen=True)
class CampaignComparison:
    """Contenders by label and batches by folder name, all simulated with the same draws.

    ``reference`` names the variant with which the others are compared. ``notes`` report unintended differences between
    the batches, and the numbers of trials that crashed, hung or ran out of memory.
    """

    contenders: dict[str, Contender]
    batches: dict[str, StoredBatch]
    reference: str
    notes: tuple[str, ...] = ()

    @property
    def first(self) -> StoredBatch:
        """Batch in the first folder."""
        return next(iter(self.batches.values()))

    @cached_property
    def _grouping(self) -> StoredBatch | None:
        """First batch with a campaign that groups trials; its groups apply to all batches, as the draws are equal."""
        return next((batch for batch in self.batches.values() if batch.group is not None), None)

    @property
    def group(self) -> str | None:
        """Name of the drawn or derived value by which trials are grouped, or None."""
        return None if self._grouping is None else self._grouping.group

    @property
    def groups(self) -> list[TrialGroup]:
        return [] if self._grouping is None else self._grouping.groups

    @cached_property
    def metrics(self) -> list[Metric]:
        """Metrics of all batches in order of appearance, without metrics shown as rates."""
        return [metric for metric in self._all_metrics if metric.name not in self._truths]

    @cached_property
    def rates(self) -> list[Metric | None]:
        """Success (None), followed by the metrics that are true or false in every trial."""
        return [None, *(metric for metric in self._all_metrics if metric.name in self._truths)]

    @cached_property
    def _all_metrics(self) -> list[Metric]:
        metrics: dict[str, Metric] = {}
        for batch in self.batches.values():
            for metric in batch.metrics:
                metrics.setdefault(metric.name, metric)
        return list(metrics.values())

    @cached_property
    def _truths(self) -> set[str]:
        """Names of metrics with values 0 and 1 only, if declared as true or false, or dimensionless with both."""
        truths = set()
        for metric in self._all_metrics:
            facts = [batch.document["metrics"].get(metric.name) for batch in self.batches.values()]
            values = np.concatenate([self.values(label, metric.name) for label in self.contenders])
            values = values[np.isfinite(values)]
            declared = all(fact.get("truth") for fact in facts if fact is not None)
            if np.all((values == 0.0) | (values == 1.0)) and (
                declared or (metric.unit == "1" and np.unique(values).size == 2)
            ):
                truths.add(metric.name)
        return truths

    def values(self, label: str, metric: str) -> np.ndarray:
        """Return a metric in every trial of a contender; nan if the contender's batch does not have the metric."""
        trials = self.contenders[label].trials
        return np.asarray(trials.metrics.get(metric, np.full(len(trials), np.nan)), dtype=float)

    def outcomes(self, label: str, rate: Metric | None) -> np.ndarray:
        """Return True for each trial of a contender that the rate counts; non-finite metrics do not count."""
        if rate is None:
            return self.contenders[label].trials.success
        values = self.values(label, rate.name)
        return np.isfinite(values) & (values != 0.0)

    @cached_property
    def summary(self) -> Summary:
        """Summary of each contender and its groups, as of a variant in a batch, with ``rates`` by name."""
        grouping = self._grouping
        by = {} if grouping is None or grouping.group is None else {grouping.group: grouping.draws[grouping.group]}
        columns = {
            label: TrialTable.of(
                {
                    "status": contender.trials.statuses,
                    "success": contender.trials.success,
                    **{f"metric.{metric.name}": self.values(label, metric.name) for metric in self.metrics},
                    **{f"draw.{name}": values for name, values in by.items()},
                }
            ).described(describe_metrics(self.metrics))
            for label, contender in self.contenders.items()
        }
        members = {group.label: group.has(values) for group in self.groups for values in by.values()}

        def with_rates(label: str, entry: VariantSummary) -> VariantSummary:
            groups = {group: self._rates(label, members[group]) for group in entry.groups}
            return replace(
                entry,
                groups={group: replace(inner, rates=groups[group]) for group, inner in entry.groups.items()},
                rates=self._rates(label, slice(None)),
            )

        summary = summarise(columns, self.groups, self.group or "")
        return {label: with_rates(label, entry) for label, entry in summary.items()}

    def _rates(self, label: str, trials: slice | np.ndarray) -> dict[str, Rate]:
        return {name_of(rate): success_rate(self.outcomes(label, rate)[trials]) for rate in self.rates}

    @cached_property
    def pairs(self) -> list[tuple[str, str]]:
        """Labels (A, B) of contenders that differ in one respect: two variants of a batch, or a variant in two batches.

        B is the reference if the reference is one of the two, else the earlier contender.
        """
        pairs = []
        for first, second in itertools.combinations(self.contenders.values(), 2):
            if first.batch == second.batch and second.name == self.reference:
                pairs.append((first.label, second.label))
            elif first.batch == second.batch or first.name == second.name:
                pairs.append((second.label, first.label))
        return pairs

    def against_reference(self, pair: tuple[str, str]) -> bool:
        """Return True if B of a pair is the reference variant or, for a pair of batches, belongs to the first batch."""
        first, second = (self.contenders[label] for label in pair)
        return second.name == self.reference if first.batch == second.batch else second.batch == 0

    def compare_rates(self, pair: tuple[str, str], rate: Metric | None) -> PairedRates:
        return compare_rates(self.outcomes(pair[0], rate), self.outcomes(pair[1], rate))

    def pair_values(self, pair: tuple[str, str], metric: str, successful: bool) -> PairedValues:
        """Return the comparison of a metric of two contenders over all trials, or over trials successful for both."""
        a, b = (self.values(label, metric) for label in pair)
        if successful:
            both = self.outcomes(pair[0], None) & self.outcomes(pair[1], None)
            a, b = a[both], b[both]
        return compare_values(a, b)

    @property
    def has_faults(self) -> bool:
        """True if any batch has faults."""
        return any(batch.faults for batch in self.batches.values())

    @property
    def has_requirements(self) -> bool:
        """True if the campaign of any batch declares requirements."""
        return any(batch.has_requirements for batch in self.batches.values())

    def content(self) -> dict[str, object]:
        """Return the comparison as JSON: provenance of batches, summaries of contenders, statistics of pairs."""
        group: dict[str, object] = {} if self.group is None else {"group": self.group}
        return group | {
            "batches": {str(batch.folder): batch.provenance for batch in self.batches.values()},
            "notes": list(self.notes),
            "variants": to_json(self.summary),
            "pairs": [
                {
                    "a": pair[0],
                    "b": pair[1],
                    "rates": {name_of(rate): to_json(self.compare_rates(pair, rate)) for rate in self.rates},
                    "metrics": {m.name: to_json(self.pair_values(pair, m.name, True)) for m in self.metrics},
                    "metrics_all": {m.name: to_json(self.pair_values(pair, m.name, False)) for m in self.metrics},
                }
                for pair in self.pairs
            ],
        }

    @cached_property
    def judged_expressions(self) -> list[Expression]:
        """Expressions of success and requirements of all batches."""
        expressions = [each for batch in self.batches.values() for each in batch.judged_expressions()]
        return list(dict.fromkeys(expressions))

    @property
    def judged_names(self) -> set[str]:
        """Names used in success and requirements of all batches."""
        return set().union(*(expression.names for expression in self.judged_expressions))

    def text(self, metrics: Sequence[str] = ()) -> str:
        """Return the comparison for a terminal: rates with intervals, then metrics of the successful trials.

        ``metrics`` names the metrics to print, or is ``all``; by default the metrics of success and requirements are
        printed. Raises InputError for a metric that no batch has.
        """
        if metrics:
            named = select_metrics(metrics, [metric.name for metric in self._all_metrics], ())
            selected = [name for name in named if name not in self._truths]
        else:
            selected = select_metrics((), [metric.name for metric in self.metrics], self.judged_names)
        names = [name_of(rate) for rate in self.rates]
        rows = summary_rows(self.summary)
        level = f"({100 * CONFIDENCE:g} %)"  # metrics are over all trials, unlike in the summary of a batch
        heads = [f"{name} % {level}" if name == SUCCESS else f"{name} % of all {level}" for name in names]
        cells = [[*group_headings(self.group), "trials", *heads]]
        for row in rows:
            rates = [rate_text(row.entry.rates[name]) for name in names]
            cells.append([*group_cells(row, self.group), str(row.entry.trials), *rates])
        lines = metric_lines(rows, selected, self.group)
        table = [*rate_lines(cells, len(group_headings(self.group))), *(["", *lines] if lines else [])]
        return "\n".join([*table, *self._fault_lines(), *self.notes])

    def _fault_lines(self) -> list[str]:
        """Return the faults of every batch as lines; an empty list if no batch has faults."""
        lines = {name: faults_line(batch.faults) if batch.faults else NO_FAULTS for name, batch in self.batches.items()}
        if not self.has_faults:
            return []
        return list(lines.values()) if len(lines) == 1 else [f"{name}: {line}" for name, line in lines.items()]


def rate_text(rate: Rate, text: Callable[[float], str] = percent) -> str:
    """Format a rate with its interval in per cent, as in `CampaignComparison.text`."""
    low, high = rate.interval
    return f"{text(rate.rate)} ({text(low)} to {text(high)})"


def name_of(rate: Metric | None) -> str:
    return SUCCESS if rate is None else rate.name
