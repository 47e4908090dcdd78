"""Documents of written files: exports, templates, composed systems, the documentation."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from ..cell import Code, CommandLine
from ..model import Document, Listing, Node, Text

if TYPE_CHECKING:  # templates need an engine that other verbs do not
    from ...authoring.block_template import CreatedFiles


def exported_document(paths: Iterable[Path], flavours: Iterable[str], platforms: Iterable[str], fmi: int) -> Document:
    """Return the document of exported files."""
    texts = list(map(str, paths))
    json = {"paths": texts, "flavours": list(flavours), "platforms": list(platforms), "fmi": fmi}
    return Document("Exported", _code(texts), [], json)


def new_files_document(written: CreatedFiles) -> Document:
    """Return the document of files written from templates: their paths, and the commands to run next."""
    nodes: list[Node] = [
        Text(f"written: {', '.join(map(str, written.paths))}"),
        Listing([[CommandLine(command)] for command in written.commands], "next:"),
    ]
    json = {"paths": [Path(path).as_posix() for path in written.paths], "next": written.commands}
    return Document("New files", nodes, [], json)


def composition_document(system: str, paths: Iterable[Path], toml: str) -> Document:
    """Return the document of a composed system: the written paths, or its `system.toml` if nothing was written."""
    json = {"system": system, "paths": [path.as_posix() for path in paths], "toml": toml}
    return Document(system, _code(map(str, paths)) or _code(toml.splitlines()), [], json)


def site_document(page: Path, is_opened: bool) -> Document:
    """Return the document of the documentation: the path of its first page."""
    return Document("Documentation", _code([str(page)]), [], {"page": str(page), "opened": is_opened})


def _code(lines: Iterable[str]) -> list[Text]:
    return [Text([Code(line)]) for line in lines]
