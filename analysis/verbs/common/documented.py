"""Results that are shown as documents: in the terminal, in a notebook, as JSON and as a page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ....common.to_json import to_json
from ...documents.model import Document
from ...options.option import FilePath


class Documented:
    """Result of a verb; its `document` contains everything that is shown.

    Optional members: ``write(path)`` and other methods that write output files; ``folder``, in which the result is
    already stored; ``problem_status``, the exit status if there are problems (default: 1).
    """

    def document(self) -> Document:
        """Return the result as a document."""
        raise NotImplementedError

    def problems(self) -> Sequence[str]:
        """Return a line for each requirement that is not met, and for each simulation that did not complete."""
        return []

    def lines(self) -> list[str]:
        """Return the lines that the verb prints."""
        from ...documents.render.terminal import document_lines

        return document_lines(self.document())

    def to_json(self) -> object:
        """Return the result as values of strict JSON (no NaN or infinity), for other programs."""
        json = self.document().json
        return to_json(json() if callable(json) else json)

    def report(self, path: FilePath) -> None:
        """Write the page of the option `report`, one HTML file."""
        from ...documents.render.html import write_document

        write_document(self.document(), Path(path))

    def _repr_html_(self) -> str:
        from ...documents.render.notebook import document_view

        return document_view(self.document())
