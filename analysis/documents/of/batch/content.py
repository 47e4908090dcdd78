"""Data common to several sections of a batch's document, each computed once on first use."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from ....campaigns.definition.campaign import Campaign, Metric
from ....campaigns.execute.campaign_result import CampaignResult
from ....campaigns.metric_limits import worst_trial
from ....campaigns.trial_columns import describe_metric
from ...common.colours import Look, look
from ..campaign.distributions import sort_metrics
from ..campaign.replays import Replay
from ..campaign.verdict_table import VerdictTable, verdict_table
from .replays import trials_to_replay
from .scatters import influence_on_success


@dataclass(frozen=True)
class BatchContent:
    """A batch with the looks of its variants, its metrics, verdicts, replays and influences."""

    batch: CampaignResult

    @property
    def campaign(self) -> Campaign:
        """The campaign of the batch."""
        return self.batch.plan.campaign

    @cached_property
    def metrics(self) -> list[Metric]:
        """The metrics of the campaign with their descriptions."""
        described = self.batch.provenance["metrics"]
        return [replace(each, description=describe_metric(described[each.name])) for each in self.campaign.metrics]

    @cached_property
    def styles(self) -> Mapping[str, Look]:
        """The look of each variant's lines."""
        return {variant: look(index) for index, variant in enumerate(self.batch.rows)}

    @cached_property
    def sorted_metrics(self) -> tuple[list[Metric], list[tuple[Metric, float]], list[Metric]]:
        """The metrics that vary, constant metrics with their values, and metrics without a finite value."""
        return sort_metrics(self.batch)

    @cached_property
    def verdicts(self) -> VerdictTable:
        """The verdicts on the variants, for metrics that vary and are not Boolean."""
        return verdict_table(
            self.batch.summary,
            [metric for metric in self.sorted_metrics[0] if not metric.expression.is_truth],
            self.campaign.judged_expressions(),
            lambda variant, metric, limits: worst_trial(self.batch.rows[variant], metric.name, limits.excess),
        )

    @cached_property
    def judged_metrics(self) -> Sequence[Metric]:
        """The metrics of success and requirements, or all metrics that vary if there are none."""
        return [each.metric for each in self.verdicts.metrics] or self.sorted_metrics[0]

    @cached_property
    def replays(self) -> list[Replay]:
        """The first failures and the worst trials."""
        return trials_to_replay(self.batch, self.verdicts)

    @cached_property
    def influences(self) -> Mapping[str, Mapping[str, float]]:
        """The influence of each dispersed input on success, for variants with failures and successes."""
        influences = {variant: influence_on_success(self.batch, variant) for variant in self.batch.rows}
        return {variant: values for variant, values in influences.items() if values}
