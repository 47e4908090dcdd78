"""What a batch leaves: a table of trials, a summary, files."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet

from ..atomic import whole_file, write_atomically
from ..campaign.plan import BatchPlan
from .summary import summarise
from .tables import faults_line, summary_text
from .trials import Trials
from .verdicts import add_verdicts


@dataclass
class BatchResult:
    """All trials of all variants, in order of trial within each variant."""

    plan: BatchPlan
    trials: dict[str, Trials]
    summary: dict[str, Any]
    provenance: dict[str, Any]

    def table(self) -> pyarrow.Table:
        """A row per variant and trial: variant, trial, status, draws, the campaign's faults, final values, metrics."""
        found = list(self.trials.values())
        rows = sum(len(part.trial) for part in found)
        arrays: dict[str, Any] = {
            "variant": [name for name, part in self.trials.items() for _ in part.trial],
            "trial": np.concatenate([part.trial for part in found]),
            "status": [status for part in found for status in part.statuses],
            "success": np.concatenate([part.success for part in found]),
            "message": [part.messages.get(int(trial), "") for part in found for trial in part.trial],
            "end_time": np.concatenate([part.end_time for part in found]),
        }
        for name, values in self.plan.draws.columns.items():
            arrays[f"draw.{name}"] = np.resize(values, rows)  # the same for every variant
        for fault in self.plan.drawn_faults:
            arrays |= {name: np.resize(values, rows) for name, values in fault.columns().items()}
        for name in found[0].final:
            arrays[f"final.{name}"] = np.concatenate([part.final[name] for part in found])
        for name in found[0].metrics:
            arrays[f"metric.{name}"] = np.concatenate([part.metrics[name] for part in found])
        table = pyarrow.table(arrays)
        return table.replace_schema_metadata({"perilune": json.dumps(self.provenance)})

    @property
    def interrupted(self) -> bool:
        """Whether it was broken off: then it is a whole batch of the first trials."""
        return "planned_trials" in self.provenance

    def document(self) -> dict[str, Any]:
        """The machine-readable result: provenance and the summary of each variant."""
        return {**self.provenance, "variants": self.summary}

    def text(self) -> str:
        """The summary for a terminal."""
        found = summary_text(self.summary, self.plan.campaign.group)
        faults = self.plan.fault_texts()
        return f"{found}\n{faults_line(faults)}" if faults else found

    def write(self, folder: Path) -> None:
        """Write trials.parquet, draws.parquet, summary.json, and traces/ where the campaign keeps them.

        Every trace carries the batch's digest: a folder can hold traces of an earlier batch too.
        """
        batch = batch_digest(self.provenance)
        write_parquet(self.table(), folder / "trials.parquet")
        text = json.dumps(self.document(), indent=1, allow_nan=False)
        write_atomically(folder / "summary.json", f"{text}\n".encode())
        for variant, found in self.trials.items():
            for trial, traces in found.traces.items():
                path = trace_path(folder, variant, trial)
                metadata = {"perilune": json.dumps({"batch": batch, "variant": variant, "trial": trial})}
                write_parquet(pyarrow.table(traces).replace_schema_metadata(metadata), path)


def trace_path(folder: Path, variant: str, trial: int) -> Path:
    """Where a trial's trace lies; a variant named by the path of an FMU has that path's slashes replaced."""
    return folder / "traces" / variant.replace("/", "_") / f"{trial:06d}.parquet"


def write_parquet(table: pyarrow.Table, path: Path) -> None:
    """A table with a checksum on every page, so that a damaged file is found out when it is read."""
    with whole_file(path) as partial:
        pyarrow.parquet.write_table(table, partial, write_page_checksum=True)


def batch_digest(provenance: dict[str, Any]) -> str:
    """The SHA-256 that tells a batch from others: of its provenance as JSON with sorted keys."""
    return hashlib.sha256(json.dumps(provenance, sort_keys=True).encode()).hexdigest()


def make_result(plan: BatchPlan, trials: dict[str, Trials], provenance: dict[str, Any]) -> BatchResult:
    """The result with its summary; ``trials`` by variant, each in order of trial."""
    summary = summarise(trials, plan.campaign.metrics, plan.groups)
    add_verdicts(summary, plan.campaign.requirements, trials)
    return BatchResult(plan, trials, summary, provenance)
