"""A campaign's folder from Python: `open_results`, and what it gives with tables and plots."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure as Plot

from ..campaigns.folder.folder import read_folder
from ..campaigns.folder.opened import OpenedResults
from ..reports.common.notebook import Grid, notebook_view
from ..runtime.flight.results import require_pandas
from .options.option import FilePath
from .plot_results import distributions


class StoredResults(OpenedResults):
    """A campaign's folder as it was when it was opened; what is asked for is read then, and no more.

    ``columns`` are unit and meaning by name, ``trials`` how many the campaign has of each variant and ``flown`` how
    many of them are there, ``provenance`` what the numbers depend on.
    """

    def __repr__(self) -> str:
        there = f"{self.flown} of {self.trials}" if self.flown < self.trials else f"{self.trials}"
        return f"{type(self).__name__}({self.provenance['system']}, {there} trials: {', '.join(self.variants)})"

    def to_pandas(self, columns: Sequence[str] | None = None) -> Any:
        """All ``columns``, or some, as a pandas.DataFrame, a row per variant and trial; needs pandas."""
        require_pandas()
        return self.arrow(columns).to_pandas()

    def plot(self, *metrics: str) -> Plot:
        """How metrics are distributed over all trials, variant beside variant; of none named all that vary.

        Raises KeyError for a metric that the campaign does not have, and ValueError where there is none to draw.
        """
        return distributions({"": self}, metrics or None)

    def _repr_html_(self) -> str:
        rows = [(name, column.unit or "", column.meaning) for name, column in self.columns.items()]
        there = f"{self.flown} of {self.trials} trials of {', '.join(self.variants)}"
        named = " --configuration NAME" if len(self.variants) > 1 else ""
        repeated = f"a trial again: perilune replay {shlex.quote(str(self.source.folder))} TRIAL{named}"
        words = [f"{Path(self.provenance['campaign']).name}: {there}", str(self.source.folder), repeated]
        return notebook_view(self.provenance["system"], words, [Grid(("column", "unit", "meaning"), rows)], None)


def open_results(folder: FilePath) -> StoredResults:
    """Open the folder that `batch` wrote to its ``output``, whole or still flying: nothing of the trials is read yet.

    A campaign that still flies gives the trials that are there: open it again for more. Raises InputError for a folder
    that is none; a damaged shard, and one of another campaign, are named when they are read.
    """
    return StoredResults(read_folder(Path(folder)))
