"""Data common to several sections of a comparison's document, each computed once on first use."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ....campaigns.compare.campaign_comparison import CampaignComparison
from ....campaigns.compare.paired import PairedRates, PairedValues
from ....campaigns.definition.campaign import Metric
from ....campaigns.metric_limits import MetricLimits, worst_row
from ...common.colours import Look
from ..campaign.replays import Replay
from ..campaign.verdict_table import VerdictTable, verdict_table
from .flights.ends import UNITS, Ends, ends_of
from .flights.histories import FlightHistories
from .flights.missing import missing_statements
from .pairs import PairGroup, metric_pairs, rate_pairs
from .variant_distributions import looks_of, metric_distributions, sort_metrics
from .variant_replays import trials_to_replay


@dataclass(frozen=True)
class ComparisonContent:
    """A comparison with its recorded simulations, pairs, verdicts and the looks of its variants."""

    comparison: CampaignComparison

    @cached_property
    def styles(self) -> Mapping[str, Look]:
        """The look of each variant's lines."""
        return looks_of(self.comparison)

    @cached_property
    def flights(self) -> FlightHistories:
        """The simulations with recorded signals."""
        return FlightHistories(self.comparison)

    @cached_property
    def ends(self) -> dict[str, dict[str, Ends]]:
        """The final errors by variable and variant."""
        ends = {
            variable: {label: ends_of(contender, variable) for label, contender in self.comparison.contenders.items()}
            for variable in UNITS
        }
        known = {
            variable: {label: each for label, each in of_all.items() if each is not None}
            for variable, of_all in ends.items()
        }
        return {variable: of_all for variable, of_all in known.items() if of_all}

    @cached_property
    def missing(self) -> Mapping[str, str]:
        """The statements on data that the results lack, by section."""
        return missing_statements(
            self.comparison,
            self.flights.by_label,
            trajectories=bool(self.flights.bundles),
            kinds={each.quantity.kind for each in self.flights.histories},
            ends=self.ends,
        )

    @cached_property
    def distributions(self) -> Mapping[Metric, Mapping[str, np.ndarray]]:
        """The metrics of successful trials by variant."""
        return metric_distributions(self.comparison)

    @cached_property
    def sorted_metrics(self) -> tuple[list[Metric], list[tuple[Metric, float]], list[Metric]]:
        """The metrics that vary, constant metrics with their values, and metrics without a finite value."""
        return sort_metrics(self.distributions)

    @cached_property
    def paired(self) -> list[Metric]:
        """The metrics that vary and in which pairs are compared."""
        return [metric for metric in self.comparison.metrics if metric in self.sorted_metrics[0]]

    @cached_property
    def rate_groups(self) -> list[PairGroup[PairedRates]]:
        """The pairs of variants by rate."""
        return rate_pairs(self.comparison)

    @cached_property
    def metric_groups(self) -> list[PairGroup[PairedValues]]:
        """The pairs of variants by metric, over the trials in which both succeed."""
        return metric_pairs(self.comparison, self.paired, successful=True)

    @cached_property
    def verdicts(self) -> VerdictTable:
        """The verdicts on the variants."""
        compared = self.comparison
        return verdict_table(compared.summary, self.paired, compared.judged_expressions, self._worst)

    def _worst(self, label: str, metric: Metric, limits: MetricLimits) -> tuple[int, float]:
        """Return the worst trial of a variant, and the metric in it."""
        values = self.comparison.values(label, metric.name)
        row, _ = worst_row(values, limits.excess)
        return int(self.comparison.contenders[label].trials.trial[row]), float(values[row])

    @cached_property
    def judged_metrics(self) -> list[Metric]:
        """The metrics of success and requirements, or all metrics that vary if there are none."""
        return [each.metric for each in self.verdicts.metrics] or self.sorted_metrics[0]

    @cached_property
    def replays(self) -> list[Replay]:
        """The trials to inspect."""
        return trials_to_replay(self.comparison, self.verdicts)
