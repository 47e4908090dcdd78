"""What a batch leaves: a table of trials, a summary, files."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet

from .flyer import TrialResult
from .plan import BatchPlan
from .summary import TrialColumns, summarise, summary_text


@dataclass
class BatchResult:
    """All trials of all variants, in order of trial within each variant."""

    plan: BatchPlan
    trials: dict[str, list[TrialResult]]
    summary: dict[str, Any]
    provenance: dict[str, Any]

    def table(self) -> pyarrow.Table:
        """A row per variant and trial: variant, trial, draws, final values, metrics, status, success."""
        columns: dict[str, list] = {
            "variant": [],
            "trial": [],
            "status": [],
            "success": [],
            "message": [],
            "end_time": [],
        }
        draws = self.plan.draws.columns
        metrics = [metric.name for metric in self.plan.campaign.metrics]
        finals = self.plan.campaign.record.final
        drawn = {name: np.concatenate([values] * len(self.trials)) for name, values in draws.items()}
        rows = [(variant, row) for variant, found in self.trials.items() for row in found]
        for variant, row in rows:
            for name, value in zip(
                columns, (variant, row.trial, row.status, row.success, row.message, row.end_time), strict=True
            ):
                columns[name].append(value)
        arrays: dict[str, Any] = {**columns, **{f"draw.{name}": values for name, values in drawn.items()}}
        arrays |= {f"final.{name}": [row.final.get(name) for _, row in rows] for name in finals}
        arrays |= {f"metric.{name}": [row.metrics[name] for _, row in rows] for name in metrics}
        table = pyarrow.table(arrays)
        return table.replace_schema_metadata({"perilune": json.dumps(self.provenance)})

    def document(self) -> dict[str, Any]:
        """The machine-readable result: provenance and the summary of each variant."""
        return {**self.provenance, "variants": self.summary}

    def text(self) -> str:
        """The summary for a terminal."""
        return summary_text(self.summary)

    def write(self, folder: Path) -> None:
        """Write trials.parquet, draws.parquet, summary.json, and traces/ where the campaign keeps them."""
        folder.mkdir(parents=True, exist_ok=True)
        pyarrow.parquet.write_table(self.table(), folder / "trials.parquet")
        text = json.dumps(self.document(), indent=1, allow_nan=False)
        (folder / "summary.json").write_text(text + "\n", encoding="utf-8")
        for variant, found in self.trials.items():
            for row in found:
                if row.traces is not None:
                    path = folder / "traces" / variant / f"{row.trial:06d}.parquet"
                    path.parent.mkdir(parents=True, exist_ok=True)
                    pyarrow.parquet.write_table(pyarrow.table(row.traces), path)


def make_result(plan: BatchPlan, trials: dict[str, list[TrialResult]], provenance: dict[str, Any]) -> BatchResult:
    """Put trials in order and summarise them."""
    ordered = {name: sorted(found, key=lambda row: row.trial) for name, found in trials.items()}
    names = [metric.name for metric in plan.campaign.metrics]
    columns = {
        variant: TrialColumns(
            statuses=[row.status for row in found],
            success=np.array([row.success for row in found]),
            metrics={name: np.array([row.metrics[name] for row in found]) for name in names},
        )
        for variant, found in ordered.items()
    }
    return BatchResult(plan, ordered, summarise(columns, plan.campaign.metrics), provenance)
