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
from .common.campaigns import commands_of, read_campaign
from .common.studies import Stored, conditions, results_folder, store_result

if TYPE_CHECKING:  # plots are imported where they are drawn: matplotlib takes as long as all the rest
    from matplotlib.figure import Figure as Plot


@dataclass(frozen=True, eq=False, repr=False)
class SensitivityResult(Stored, study.SensitivityResult):
    """Sobol' indices of metrics and success: `of` gives those of one, ``ranks`` the rank correlations."""

    def document(self) -> Document:
        """Return the indices and rank correlations with their conditions."""
        return sensitivity_document(self, self.folder)

    def write(self, folder: FilePath) -> None:
        """Write sensitivity.json, flights.parquet and draws.parquet."""
        super().write(Path(folder))

    def plot(self, *metrics: str) -> Plot:
        """Plot total and first-order indices with their intervals, a panel for each metric; by default all.

        Raises KeyError for a metric that has no indices, ValueError where none has any.
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
    """Compute Sobol' indices of a campaign's metrics and of its success: `perilune sensitivity`.

    ``base`` is a power of two, 32 or more: that many times the number of dispersed inputs and 3 are simulated, or the
    number and 2 where no noise is random. The noise of all components is one input in addition to the dispersed ones.
    Jointly normal draws are refused. ``hold``, ``noise_trial`` and ``compare`` are as in `rare`; ``output`` is a folder
    for sensitivity.json, flights.parquet and draws.parquet. The rest is as in `batch`. Raises InputError.
    """
    folder = results_folder(options)
    plan = read_campaign(system, campaign, options)
    with chdir(Path.cwd()):  # an FMU may change the folder
        result = study.sensitivity(
            plan, base, **conditions(options), tell=lambda cost: print(f"perilune: {cost}", file=sys.stderr)
        )
    return store_result(SensitivityResult, replace(result, commands=commands_of(plan)), folder)
