"""OspModelDescription.xml: groups of variables that a single connection joins."""

from __future__ import annotations

import itertools
import posixpath
from pathlib import PurePosixPath

from lxml import etree

from .....common.errors import InputError
from .....common.zips import open_zip, read_entry
from ..archive import SystemArchive
from ..documents import parse_xml
from ..fmu_description import DESCRIPTION

SUFFIX = "_OspModelDescription.xml"


def read_groups(archive: SystemArchive, source: str, element: str) -> dict[str, list[str]]:
    """Return the names of variables by group, for the FMU ``source`` to which ``element`` refers.

    The file is searched as libcosim does: under the name of the FMU's model, first in the folder of the system's
    description, then in the folder of the FMU; and under the FMU's file name. Raises InputError.
    """
    candidates = list(dict.fromkeys(_candidates(archive, source, element)))
    file = next((file for file in candidates if archive.has(file)), candidates[0])
    groups = parse_xml(archive.read(file, element), file).findall("{*}VariableGroups//*[@name]")
    return {group.get("name", ""): [_variable(each, file) for each in group.iter("{*}Variable")] for group in groups}


def _variable(element: etree._Element, file: str) -> str:
    """Return the FMU's variable to which a Variable of a group refers."""
    ref = element.get("ref")
    if ref is None:
        where = f"Variable (line {element.sourceline})"
        raise InputError(file, where, "has no ref, the name of the FMU's variable", 'write ref="..."')
    return ref


def _candidates(archive: SystemArchive, source: str, element: str) -> list[str]:
    names = [PurePosixPath(source).stem]
    if archive.is_own_file(source):
        names.insert(0, _model_name(archive.read(source, element), source))
    folders = ("", posixpath.dirname(source))
    return [posixpath.join(folder, f"{name}{SUFFIX}") for name, folder in itertools.product(names, folders)]


def _model_name(fmu: bytes, label: str) -> str:
    description = read_entry(open_zip(fmu, label), DESCRIPTION, label)
    return str(parse_xml(description, f"{label}!{DESCRIPTION}").get("modelName", ""))
