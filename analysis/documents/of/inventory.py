"""Document of an inventory: systems with their files, laws, searches, FMUs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..model import Document, Listing, Node

TITLES = 16  # columns of the titles of a system's files
BUILT = 15  # columns of the flavours that are built
LISTS = ("parameter_sets", "campaigns", "loops")  # lists of a system


def inventory_document(content: Mapping[str, Any], lists: Sequence[str] = LISTS) -> Document:
    """Return the document of an inventory from its JSON; ``lists`` are the keys of a system's lists to include."""
    nodes: list[Node] = []
    for name, system in content["systems"].items():
        rows = [[title.replace("_", " "), ", ".join(system[title]) or "none"] for title in lists]
        nodes.append(Listing(rows, name, (TITLES,)))
    for title in ("laws", "searches"):
        if content[title]:
            nodes.append(Listing([[title, ", ".join(content[title])]], columns=(TITLES + 2,)))
    fmus = content["fmus"]
    if fmus:
        rows = [[name, "+".join(fmu["built"]) or "not built", fmu["description"]] for name, fmu in fmus.items()]
        nodes.append(Listing(rows, "FMUs", (max(map(len, fmus)) + 2, BUILT)))
    return Document("Inventory", nodes, [], content)
