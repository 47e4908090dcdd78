"""Conversion of the files in an .ssp from SSP 1.0 to SSP 2.0."""

from __future__ import annotations

import io
import posixpath
import zipfile
from collections.abc import Collection, Mapping
from copy import deepcopy
from functools import cache
from urllib.parse import unquote

from lxml import etree

from ..dimensions import Shape
from ..documents import parse_xml
from ..fmu_description import DESCRIPTION
from .descriptions import convert_description
from .element_values import merge_values
from .fmu_arrays import arrays_of_fmu, enumerations_of_fmu
from .trees import to_version_2

OTHERS = (".ssm", ".ssb")


def convert_package(files: Mapping[str, bytes], label: str) -> dict[str, bytes]:
    """Return the files of a package by name, with documents converted to SSP 2.0; ``label`` is its name in errors.

    Raises InputError for a document that is not XML.
    """

    @cache
    def fmu(source: str) -> etree._Element:
        name = _name(source, files)
        if name is None:
            return etree.Element("none")
        with zipfile.ZipFile(io.BytesIO(files[name])) as archive:
            return parse_xml(archive.read(DESCRIPTION), f"{label}!{name}!{DESCRIPTION}")

    def arrays_of(source: str) -> Mapping[str, Shape]:
        return arrays_of_fmu(fmu(source))

    def enumerations_of(source: str) -> Collection[str]:
        return enumerations_of_fmu(fmu(source))

    converted = dict(files)
    by_set: dict[
        str, list[Mapping[str, Shape]]
    ] = {}  # arrays to which the names of a parameter set may refer, for each binding
    whole: list[Mapping[str, Shape]] = []
    for name in files:
        if name.endswith(".ssd") and "/" not in name:
            read = parse_xml(files[name], f"{label}!{name}")
            root, (system, *bound) = convert_description(read, arrays_of, enumerations_of)
            converted[name] = _write(root)
            whole.append(system.arrays)
            for each in bound:
                by_set.setdefault(_name(each.source, files) or "", []).append(each.arrays)
    for name in files:
        if name.endswith((".ssv", *OTHERS)):
            root = deepcopy(parse_xml(files[name], f"{label}!{name}"))
            to_version_2(root)
            if name.endswith(".ssv"):
                merge_values(root, _in_all(by_set.get(name, whole)))
            converted[name] = _write(root)
    return converted


def _name(source: str, files: Mapping[str, bytes]) -> str | None:
    """Return the name of the package's file to which a source refers, or None."""
    names = (posixpath.normpath(source), posixpath.normpath(unquote(source)))
    return next((name for name in names if name in files), None)


def _in_all(meanings: list[Mapping[str, Shape]]) -> dict[str, Shape]:
    """Return the arrays on which all bindings of a parameter set agree."""
    first, *others = meanings or [{}]
    return {name: shape for name, shape in first.items() if all(other.get(name) == shape for other in others)}


def _write(root: etree._Element) -> bytes:
    return etree.tostring(root.getroottree(), encoding="UTF-8", xml_declaration=True) + b"\n"
