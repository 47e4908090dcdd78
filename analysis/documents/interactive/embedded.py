"""Data embedded in a page for its scripts, as one JSON document."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import Field, fields, is_dataclass
from typing import Any

import numpy as np
from markupsafe import Markup

from .charts import PICTURE, Chart
from .columns import Coarse, Columns
from .script_bundles import policy, read_bundle


class Embedded:
    """Data for the scripts of one page: columns, charts of its figures, further documents by name."""

    def __init__(self) -> None:
        self._columns = Columns()
        self._figures: list[Any] = []
        self._documents: dict[str, Any] = {}
        self._bundles: dict[str, str] = {}
        self._requests = False

    def add_figure(self, charts: Sequence[Chart]) -> int | None:
        """Add a figure and return its number, which its element refers to.

        The result is None if scripts are missing, or if the figure has marks of trials and the page no document of
        trials.
        """
        if not charts or not self.use("curves"):
            return None
        if "trials" not in self._documents and any(chart.dots for chart in charts):
            return None
        self._figures.append(self._plain(charts))
        return len(self._figures) - 1

    def add_document(self, name: str, bundle: str, document: Any) -> bool:
        """Add a document that the script ``bundle`` reads, and return True; False if this was not built."""
        if not self.use(bundle):
            return False
        self._documents[name] = self._plain(document)
        return True

    def use(self, bundle: str) -> bool:
        """Add a script to the page; return False if it was not built."""
        if bundle not in self._bundles and (text := read_bundle(bundle)) is not None:
            self._bundles[bundle] = text
        return bundle in self._bundles

    def allow_requests(self) -> None:
        """Permit requests from the page's scripts to its server."""
        self._requests = True

    def policy(self) -> str:
        """Return the page's Content-Security-Policy."""
        return policy(self._bundles.values(), requests=self._requests)

    def elements(self) -> Markup:
        """Return the document and the scripts as elements for the end of a page; empty if there are no scripts."""
        if not self._bundles:
            return Markup("")
        document = {**self._columns.document(), "figures": self._figures, **self._documents}
        # A browser interprets "<" before scripts read the JSON; non-ASCII characters are escaped by default.
        text = json.dumps(document, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
        content = f'<script type="application/json" id="page-data">{text}</script>\n'
        scripts = "".join(f"<script>{script}</script>\n" for script in self._bundles.values())
        return Markup(content + scripts)

    def _plain(self, node: Any) -> Any:
        """Return a node as JSON: arrays become column numbers; empty fields that are `is_optional` are omitted."""
        if isinstance(node, np.ndarray):
            return self._columns.add(node)
        if isinstance(node, Coarse):
            return self._columns.add(node.numbers, coarse=True)
        if is_dataclass(node):
            entries = [(each, getattr(node, each.name)) for each in page_fields(type(node))]
            return {
                each.name: self._plain(entry) for each, entry in entries if not (is_optional(each) and _is_empty(entry))
            }
        if isinstance(node, dict):
            return {name: self._plain(entry) for name, entry in node.items()}
        if isinstance(node, list | tuple):
            return [self._plain(entry) for entry in node]
        return node


def page_fields(declared: type) -> list[Field[Any]]:
    """Return the fields of a dataclass that pages include."""
    return [each for each in fields(declared) if each.metadata != PICTURE]


def is_optional(declared: Field[Any]) -> bool:
    """Return True if a field is empty by default, and a page therefore omits it when empty."""
    return _is_empty(declared.default)


def _is_empty(entry: Any) -> bool:
    return entry is None or entry is False or (isinstance(entry, str | list | tuple) and not entry)
