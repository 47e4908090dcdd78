"""`perilune.sensitivity`: influence of dispersed inputs on a campaign's metrics."""

from __future__ import annotations

import sys
from contextlib import chdir
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

from ...common.errors import suggestion
from ..documents.model import Document
from ..documents.of.studies.sensitivity import sensitivity_document
from ..documents.of.studies.sensitivity_figures import index_figures
from ..options.declared.studies import SENSITIVITY, SensitivityOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..studies import sensitivity as study
from .common.campaign_options import commands_of, read_campaign
from .common.studies import StoredResult, conditions, results_folder, store_result

if TYPE_CHECKING:  # imported where needed: matplotlib is slow to import
    from matplotlib.figure import Figure as Plot


@dataclass(frozen=True, eq=False, repr=False)
class SensitivityResult(StoredResult, study.SensitivityOutcome):
    """Sobol' indices of metrics and success, and rank correlations; `of` returns the indices of one metric."""

    def document(self) -> Document:
        """Return a document with indices, rank correlations and conditions."""
        return sensitivity_document(self, self.folder)

    def write(self, folder: FilePath) -> None:
        """Write sensitivity.json, flights.parquet and draws.parquet."""
        super().write(Path(folder))

    def plot(self, *metrics: str) -> Plot:
        """Plot total and first-order indices with confidence intervals, a panel for each metric; by default all.

        Raises KeyError for a metric without indices, ValueError if no metric has any.
        """
        for name in metrics:
            if name not in self.with_indices:
                raise KeyError(f"no indices of {name}; {suggestion(name, self.with_indices)}")
        if not self.with_indices:
            raise ValueError("no metric has indices")
        from ..documents.render.notebook import plot_figures

        return plot_figures(index_figures(self, metrics or self.with_indices))


@verb(SENSITIVITY)
def sensitivity(
    system: FilePath, campaign: FilePath, base: int, **options: Unpack[SensitivityOptions]
) -> SensitivityResult:
    """Compute Sobol' indices of a campaign's metrics and success: `perilune sensitivity`.

    ``base`` is a power of two, at least 32. For k dispersed inputs ``base`` * (k + 3) trials are simulated, or ``base``
    * (k + 2) without random noise; the noise of all components counts as one further input. Jointly normal inputs are
    rejected. ``hold``, ``noise_trial`` and ``compare`` are as in `rare`; ``output`` is a folder for sensitivity.json,
    flights.parquet and draws.parquet. Other options are as in `batch`. Raises InputError.
    """
    folder = results_folder(options)
    plan = read_campaign(system, campaign, options)
    with chdir(Path.cwd()):  # an FMU may change the folder
        result = study.sensitivity(
            plan, base, **conditions(options), tell=lambda cost: print(f"perilune: {cost}", file=sys.stderr)
        )
    return store_result(SensitivityResult, replace(result, commands=commands_of(plan)), folder)
