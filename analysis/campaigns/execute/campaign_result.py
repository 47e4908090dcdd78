"""Result of a batch: table of trials, summary, files."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Self

import pyarrow

from ....common.atomic import write_atomically
from ....common.to_json import to_json
from ..definition.plan import BatchPlan
from ..folder.campaign_folder import CampaignFolder
from ..folder.lock import lock_folder
from ..folder.numbering import Numbering, shard_size
from ..folder.provenance import CampaignProvenance
from ..folder.shard_files import SUMMARY, clear, trial_table, write_draws
from ..plain_text import assumption_lines, faults_line
from ..plotted_sample import PlottedSample, select_trials
from ..summary import Summary, summarise
from ..summary_text import select_metrics, summary_text
from ..trial_columns import Column, describe_column, with_metadata
from ..trials import TrialTable
from .folder import remove_temporary_files
from .loaded_campaign import LoadedCampaign


@dataclass
class CampaignResult:
    """All trials of all variants; ``rows`` are in order of trial, in memory or read from a folder.

    ``folder`` is the path of the campaign's folder as stated by the user, or None.
    """

    plan: BatchPlan
    rows: Mapping[str, TrialTable]
    provenance: CampaignProvenance
    folder: Path | None = None

    def __post_init__(self) -> None:
        self.rows = {variant: trials.described(self._describe) for variant, trials in self.rows.items()}

    def _describe(self, name: str) -> Column:
        return describe_column(name, self.provenance)

    @classmethod
    def finish(cls, campaign: LoadedCampaign, rows: Mapping[str, TrialTable], **more: Any) -> Self:
        """Return the result of a campaign with ``rows`` by variant, and complete its folder with the summary.

        Trials after those in ``rows`` are removed from the campaign. ``more`` contains further fields of a derived
        class.
        """
        campaign = campaign.of_first(len(next(iter(rows.values()))))
        result = cls(campaign.plan, rows, campaign.provenance, campaign.user_folder, **more)
        if campaign.folder is not None:
            with lock_folder(campaign.folder):
                result.write_summary(campaign.folder)
                remove_temporary_files(campaign.folder)
        return result

    @cached_property
    def summary(self) -> Summary:
        """Success rates, statistics of metrics and verdicts on requirements, by variant."""
        campaign = self.plan.campaign
        return summarise(
            self.rows,
            self.plan.groups,
            campaign.group or "",
            requirements=campaign.requirements,
            until_decided=self.plan.until_decided,
        )

    @cached_property
    def trials(self) -> dict[str, TrialTable]:
        """All trials by variant in memory, with traces."""
        return {variant: rows.whole() for variant, rows in self.rows.items()}

    @cached_property
    def plotted(self) -> dict[str, PlottedSample]:
        """Samples for figures, by variant."""
        campaign = self.plan.campaign
        metrics = [metric.name for metric in campaign.metrics]
        return {variant: select_trials(rows, campaign.input_names(), metrics) for variant, rows in self.rows.items()}

    def table(self) -> pyarrow.Table:
        """Return a row for each variant and trial, with unit, kind and meaning in the metadata of each column's field.

        Columns are variant, trial, status, draws, the campaign's faults, final values and metrics.
        """
        table = trial_table(self.plan, self.trials)
        schema = with_metadata(table.schema, self._describe).with_metadata({"perilune": json.dumps(self.provenance)})
        return pyarrow.Table.from_arrays(table.columns, schema=schema)

    def content(self) -> dict[str, object]:
        """Return the result as JSON: provenance, and the summary of each variant."""
        return {**self.provenance, "variants": to_json(self.summary)}

    def text(self, metrics: Sequence[str] = ()) -> str:
        """Return the summary for a terminal, with these metrics or ``all`` metrics.

        The default is the metrics of success and requirements. Raises InputError for a metric that the campaign does
        not have.
        """
        faults, campaign = self.plan.fault_texts(), self.plan.campaign
        selected = select_metrics(metrics, [metric.name for metric in campaign.metrics], campaign.judged_names())
        lines = [summary_text(self.summary, campaign.group, selected), *([faults_line(faults)] if faults else [])]
        return "\n".join([*lines, *assumption_lines(self.provenance.get("assumptions", ()))])

    def write(self, folder: Path) -> None:
        """Write trials/, draws.parquet, summary.json, and traces/ if the campaign records them.

        Every file contains the batch's digest, since traces of an earlier batch may be in the folder.
        """
        stored = CampaignFolder(folder, self.provenance)
        numbering = Numbering(self.plan.campaign.trials, shard_size(self.plan.campaign.trials))
        with lock_folder(folder, alone=True):
            write_draws(self.plan, folder, numbering.size)
            clear(folder)
            for shard in range(numbering.count):
                part = {variant: trials.part(numbering.of(shard)) for variant, trials in self.trials.items()}
                stored.write(shard, self.plan, part)
            self.write_summary(folder)

    def write_summary(self, folder: Path) -> None:
        """Write summary.json, which completes the folder once all shards are stored."""
        text = json.dumps(self.content(), indent=1, allow_nan=False)
        write_atomically(folder / SUMMARY, f"{text}\n".encode())
