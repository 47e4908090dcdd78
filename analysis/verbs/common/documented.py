"""Results that have a document: their text, view in a notebook, JSON and page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ....common.to_json import to_json
from ...documents.model import Document
from ...options.option import FilePath


class Documented:
    """Result of a verb, whose `document` has everything that is shown of it.

    It may have ``write(path)`` and other methods that write the files of its verb; a ``folder`` in which it is stored
    already; and ``problem_status``, the exit status of problems where it is not 1.
    """

    def document(self) -> Document:
        """Return the result as a document."""
        raise NotImplementedError

    def problems(self) -> Sequence[str]:
        """Return a line for each requirement that is not met and each simulation that did not complete."""
        return []

    def lines(self) -> list[str]:
        """Return the lines that the verb prints."""
        from ...documents.render.terminal import document_lines

        return document_lines(self.document())

    def to_json(self) -> object:
        """Return the result as strict JSON, for other programs."""
        json = self.document().json
        return to_json(json() if callable(json) else json)

    def report(self, path: FilePath) -> None:
        """Write the page of the verb's option `report`: one HTML file."""
        from ...documents.render.html import write_document

        write_document(self.document(), Path(path))

    def _repr_html_(self) -> str:
        from ...documents.render.notebook import document_view

        return document_view(self.document())
