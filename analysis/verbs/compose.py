"""`perilune.compose` and `perilune compose`: conversion of a `system.toml` to an SSD, and of a system to its file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Unpack

from ...common.atomic import write_atomically
from ...common.errors import InputError
from ...common.targets import check_file
from ...fmus_src.export.ssp_package import DESCRIPTION
from ..compose.assembly import compose_document, folder_archive
from ..compose.files import add_mark, check_unedited, write_source
from ..compose.reconstruction import source_of
from ..compose.source import SystemSource, read_source
from ..compose.text import write_toml
from ..documents.figures.figure_reader import read_figures
from ..documents.model import Document
from ..documents.of.written_files import composition_document
from ..options.declared.library import COMPOSE, ComposeOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.ssp.archive import open_system
from ..runtime.ssp.ssd_reader import read_description
from ..runtime.system.options import SystemOptions
from ..runtime.system.prepared import prepare_system
from ..runtime.system.times import MissingStopTimeError
from ..stability.request.loop_declaration import read_declaration
from .common.documented import Documented


@dataclass(frozen=True)
class Composition(Documented):
    """Content of a `system.toml`, and the ``paths`` of written files."""

    source: SystemSource
    paths: tuple[Path, ...]

    @property
    def toml(self) -> str:
        """The text of the `system.toml`."""
        return write_toml(self.source)

    def document(self) -> Document:
        """Return a document with the written paths, or with the `system.toml` if nothing was written."""
        return composition_document(self.source.name, self.paths, self.toml)


@verb(COMPOSE)
def compose(what: FilePath, **options: Unpack[ComposeOptions]) -> Composition:
    """Write a system's SSD from its `system.toml`, or the `system.toml` of a system: `perilune compose`.

    ``what`` is the path of a .toml file, next to which SystemStructure.ssd is written, or a system, whose `system.toml`
    is the text ``toml`` of the result. ``output`` is the path at which this file is written, with its annotations; the
    files that it refers to are written with it if the folder is not the system's. An SSD that was edited is not
    overwritten, and nothing is written for a system that cannot be simulated. Raises InputError, with a line for each
    problem.
    """
    path, output = Path(what), options["output"]
    if path.suffix != ".toml":
        archive = open_system(path)
        source = source_of(archive)
        check_file("`output`", None if output is None else Path(output), (".toml",))
        if output is None:
            return Composition(source, ())
        layers = read_declaration(read_description(archive)).layers
        return Composition(source, tuple(write_source(source, archive, Path(output), layers)))
    if output is not None:
        problem = f"an SSD is written next to its system.toml, as {DESCRIPTION}"
        raise InputError("`output`", os.fspath(output), problem, "leave out `output`")
    target = path.parent / DESCRIPTION
    source, document = compose_file(path)
    check_unedited(target)
    write_atomically(target, document)
    return Composition(source, (target,))


def compose_file(path: Path) -> tuple[SystemSource, bytes]:
    """Return the content of a `system.toml` and its SSD, checked as `simulate` does. Raises InputError."""
    source, raw = read_source(path)
    return source, compose_source(source, path.parent, raw, path.name, {})


def compose_source(source: SystemSource, folder: Path, raw: bytes, file: str, files: Mapping[str, bytes]) -> bytes:
    """Return the SSD of a system in a folder, marked with its source; add ``files`` (by archive name) to the folder.

    ``raw`` is the content of ``file``, the `system.toml`. Raises InputError for a system that cannot be simulated.
    """
    document = add_mark(compose_document(source, folder_archive(folder, files)), file, raw)
    archive = folder_archive(folder, {**files, DESCRIPTION: document})
    # Inputs of the system may be driven over time by the option `input` of a simulation.
    options = SystemOptions(open_inputs="start" if "input" in source.connectors.values() else None)
    try:
        prepared = prepare_system(archive, options)
    except MissingStopTimeError as error:
        prepared = prepare_system(archive, options.replace(stop_time=error.earliest))
    read_figures(prepared)
    read_declaration(prepared.network.description)
    return document
