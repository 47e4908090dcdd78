"""Document of a stored campaign in a notebook: its columns, and the command that replays a trial."""

from __future__ import annotations

import shlex
from pathlib import PurePath

from ....campaigns.folder.opened import OpenedResults
from ...model import Document, Table, Text


def stored_document(results: OpenedResults) -> Document:
    """Return the document of a campaign's folder: number of trials, and columns with units and meanings."""
    rows = [(name, column.unit or "", column.meaning) for name, column in results.columns.items()]
    trials = f"{results.flown} of {results.trials} trials of {', '.join(results.variants)}"
    named = " --configuration NAME" if len(results.variants) > 1 else ""
    folder = str(results.source.folder)
    words = [
        Text(f"{PurePath(results.provenance['campaign']).name}: {trials}"),
        Text(folder),
        Text(f"replay of a trial: perilune replay {shlex.quote(folder)} TRIAL{named}"),
    ]
    return Document(
        results.provenance["system"], [*words, Table(("column", "unit", "meaning"), rows)], [], results.provenance
    )
