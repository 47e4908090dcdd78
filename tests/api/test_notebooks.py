"""Notebooks of the docs, run as a user runs them: in an empty folder, each by a separate kernel.

Truth: nbclient, which stops at an exception; the rule that every result with a picture shows it.
"""

from __future__ import annotations

import nbformat
import pytest
from nbclient import NotebookClient

from perilune.common.paths import ROOT

NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.ipynb"))
FIRST = "flight_and_guidance"  # which `make test` runs; the others `make long`
SHOWN = ("image/svg+xml", "text/html")


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize(
    "path",
    [pytest.param(path, marks=[] if path.stem == FIRST else [pytest.mark.slow]) for path in NOTEBOOKS],
    ids=lambda path: path.stem,
)
def test_it_runs_to_its_end(path, tmp_path):
    book = nbformat.read(path, 4)
    nbformat.validate(book)
    code = [cell for cell in book.cells if cell.cell_type == "code"]
    assert not any(cell.outputs or cell.execution_count for cell in code)  # results are computed, not stored
    NotebookClient(book, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    results = [output.data for cell in code for output in cell.outputs if output.output_type == "execute_result"]
    assert sum(any(kind in data for kind in SHOWN) for data in results) >= 3
    assert not any(output.get("name") == "stderr" for cell in code for output in cell.outputs)


def test_there_are_three():
    assert len(NOTEBOOKS) == 3
