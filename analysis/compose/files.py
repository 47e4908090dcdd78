"""Composed files on disk: an SSD records its source file, and a file that was edited by hand is never overwritten."""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from ...common.atomic import write_atomically
from ...common.bounds import ARCHIVE_BYTES, XML_BYTES
from ...common.errors import InputError
from ...common.regular import read_input
from ...fmus_src.export.ssp_package import SYSTEM_FILE
from ..runtime.ssp.archive import SystemArchive, open_system
from ..runtime.system.options import Layer
from .document import fmu_source, set_source
from .source import ANNOTATIONS_FILE, SystemSource, read_source
from .text import write_toml

OTHERWISE = "and is not overwritten"
MARK = re.compile(
    rb"<!-- Written by perilune compose from [^\n]*, SHA-256 (?P<source>[0-9a-f]{64}): change that file\."
    rb" SHA-256 of what follows: (?P<rest>[0-9a-f]{64}) -->\n"
)


def add_mark(document: bytes, file: str, raw: bytes) -> bytes:
    """Return an SSD with a comment after its first line: its source file and the SHA-256 of both."""
    declaration, _, body = document.partition(b"\n")
    name = file.replace("--", "- -").encode()
    digests = [hashlib.sha256(each).hexdigest().encode() for each in (raw, body)]
    mark = b"<!-- Written by perilune compose from %s, SHA-256 %s: change that file." % (name, digests[0])
    return b"%s\n%s SHA-256 of what follows: %s -->\n%s" % (declaration, mark, digests[1], body)


def check_unedited(path: Path, option: str = "") -> None:
    """Reject overwriting an SSD that `add_mark` did not mark, or that was edited since. Raises InputError."""
    if not os.path.lexists(path):
        return
    content = read_input(path, "move this file away", XML_BYTES)
    match = MARK.search(content)
    if match is None:
        remedy = f"move this file away; perilune compose {path.parent} --output FILE.toml writes it as a system.toml"
        raise InputError(path, option, f"was not written by perilune compose, {OTHERWISE}", remedy)
    if hashlib.sha256(content[match.end() :]).hexdigest().encode() != match["rest"]:
        problem = f"was edited since perilune compose wrote it, {OTHERWISE}"
        raise InputError(path, option, problem, "make the change in the system.toml and move the file away")


def check_unedited_source(path: Path, ssd: Path, raw: bytes) -> None:
    """Reject overwriting a `system.toml` that was edited since the SSD was composed from it. Raises InputError."""
    if not os.path.lexists(path):
        return
    content = read_input(path, "move this file away", XML_BYTES)
    match = MARK.search(read_input(ssd, "move this file away", XML_BYTES)) if os.path.lexists(ssd) else None
    digest = hashlib.sha256(content).hexdigest().encode()
    if content != raw and (match is None or match["source"] != digest):
        problem = f"was edited since perilune compose read it, {OTHERWISE}"
        raise InputError(path, "", problem, "move this file away, or write to another folder")


def report_changed_source(system: str | Path) -> list[str]:
    """Return a message if a `system.toml` or its annotations changed since the SSD was composed, else an empty list.

    Raises InputError if the system cannot be read.
    """
    archive = open_system(system)
    file = archive.path / SYSTEM_FILE
    match = MARK.search(archive.read(archive.description, "system")) if file.is_file() else None
    if match is None:
        return []
    try:
        raw = read_source(file)[1]
    except InputError:
        raw = b""
    if hashlib.sha256(raw).hexdigest().encode() == match["source"]:
        return []
    path = os.path.relpath(file) if file.is_relative_to(Path.cwd()) else str(file)
    problem = f"this file or its annotations have changed since {archive.description} was composed from it"
    return [f"{path}: {problem}; perilune compose {path}"]


def write_source(source: SystemSource, archive: SystemArchive, path: Path, layers: Iterable[Layer] = ()) -> list[Path]:
    """Write a system's `system.toml` and its annotations to another folder, with all files they refer to.

    ``layers`` are the compositions in its annotations, whose parameter sets and FMUs are written as well. Returns the
    paths of the written files. Files with other content are never overwritten. Raises InputError and OSError.
    """
    contents = {path: write_toml(source).encode()}
    if source.annotations:
        contents[path.with_name(ANNOTATIONS_FILE)] = source.annotations
    if path.parent.resolve() != archive.path:
        contents |= {path.parent / name: content for name, content in _list_files(source, archive, layers).items()}
    write_new(contents, "`output`")
    return list(contents)


def write_new(contents: Mapping[Path, bytes], option: str = "") -> None:
    """Write all files or none; files with other content are never overwritten. Raises InputError and OSError."""
    for path, content in contents.items():
        if os.path.lexists(path) and read_input(path, "move this file away", ARCHIVE_BYTES) != content:
            raise InputError(
                option or path, str(path) if option else "", f"already exists, {OTHERWISE}", "move this file away"
            )
    for path, content in contents.items():
        write_atomically(path, content)


def _list_files(source: SystemSource, archive: SystemArchive, layers: Iterable[Layer]) -> dict[str, bytes]:
    """Return the content of the parameter sets and FMUs in a system's folder or archive, by path."""
    layers = list(layers)
    fmus = [each.fmu for each in source.components.values()] + [fmu for each in layers for fmu in each.use.values()]
    sources = {path: path for path in map(fmu_source, fmus) if archive.is_own_file(path)}
    sources |= {name: set_source(name) for name in source.parameter_sets}
    further = {name: set_source(name) for each in layers for name in each.parameters}
    sources |= {name: path for name, path in further.items() if archive.is_own_file(path)}
    return {path: archive.read(name, name) for path, name in sources.items()}
