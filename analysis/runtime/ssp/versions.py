"""SSP 2.0 read as far as it is SSP 1.0: what is new in it is refused by name, but for what nothing flies by.

Namespaces are those of 1.0, and every document of 1.0 is one of 2.0 (SSP 2.0, release notes). fmpy has no schema of
2.0: a document without anything new is checked against that of 1.0.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import fmpy
from lxml import etree

from ...common.errors import InputError

SCHEMAS = Path(fmpy.__file__).parent / "ssp" / "schema"
STANDARD = "http://ssp-standard.org/"
COMMON = f"{STANDARD}SSP1/SystemStructureCommon"
WITHOUT_EFFECT = ("MetaData", "Signature")  # where a document comes from and who vouches for it
ATTRIBUTES = {  # of 1.0's elements, with values that are new
    "kind": ("local", "constant", "structuralParameter", "localClock", "inputClock", "outputClock"),
    "implementation": ("ScheduledExecution",),
}


def in_version_1(root: etree._Element, file: str) -> None:
    """Make a document of a version that is read one of 1.0, in place; raises InputError naming what 1.0 has not."""
    version = root.get("version", "")
    if version.startswith("1.") or not root.tag.startswith(f"{{{STANDARD}"):
        return  # what is no SSP at all is the schema's to say
    if not version.startswith("2."):
        problem = f"SSP version {version or '(none)'} is not read"
        raise InputError(file, f"version (line {root.sourceline})", problem, 'write version="1.0"')
    for name in WITHOUT_EFFECT:
        for element in list(root.iter(f"{{{COMMON}}}{name}")):
            element.getparent().remove(element)
    for element in root.iter(etree.Element):
        name = etree.QName(element)
        if not (name.namespace or "").startswith(STANDARD):
            continue
        if name.localname not in _names():
            raise _new(file, element, name.localname)
        for attribute, values in ATTRIBUTES.items():
            if element.get(attribute) in values:
                raise _new(file, element, f'{attribute}="{element.get(attribute)}"')
        if name.localname == etree.QName(root).localname or element.get("version", "").startswith("2."):
            element.set("version", "1.0")


def _new(file: str, element: etree._Element, what: str) -> InputError:
    remedy = "write it as SSP 1.0 has it (numbers are Real or Integer)"
    return InputError(file, f"{what} (line {element.sourceline})", "is new in SSP 2.0 and not supported", remedy)


@cache
def _names() -> frozenset[str]:
    """Names of all elements of SSP 1.0."""
    names: set[str] = set()
    for path in sorted(SCHEMAS.glob("*.xsd")):
        if path.stem.endswith("11"):
            continue  # a draft of 1.1, which no document names
        for element in etree.parse(path).iter("{http://www.w3.org/2001/XMLSchema}element"):
            if element.get("name"):
                names.add(element.get("name", ""))
    return frozenset(names)
