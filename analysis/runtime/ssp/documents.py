"""XML documents from outside, read with care: no DOCTYPE, valid against their schema, lines kept."""

from __future__ import annotations

from functools import cache

from lxml import etree

from ...common.errors import InputError
from .versions import SCHEMAS, in_version_1

NAMESPACES = {
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
    "ssm": "http://ssp-standard.org/SSP1/SystemStructureParameterMapping",
    "ssb": "http://ssp-standard.org/SSP1/SystemStructureSignalDictionary",
}
SCHEMA_FILES = {
    "ssd": "SystemStructureDescription.xsd",
    "ssv": "SystemStructureParameterValues.xsd",
    "ssm": "SystemStructureParameterMapping.xsd",
    "ssb": "SystemStructureSignalDictionary.xsd",
}


@cache
def _schema(kind: str) -> etree.XMLSchema:
    return etree.XMLSchema(etree.parse(SCHEMAS / SCHEMA_FILES[kind]))


def parse_xml(data: bytes, file: str) -> etree._Element:
    """Root element of an XML document; a DOCTYPE is refused before anything else is looked at."""
    refusal = InputError(file, "DOCTYPE", "a document type declaration is not accepted", "remove the <!DOCTYPE ...>")
    if b"<!DOCTYPE" in data.upper():
        raise refusal
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False)
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        raise InputError(file, f"line {error.lineno}", f"not well-formed XML: {error.msg}", "fix the XML") from error
    if root.getroottree().docinfo.internalDTD is not None:  # in an encoding in which the bytes look otherwise
        raise refusal
    return root


def check_schema(element: etree._Element, kind: str, file: str) -> None:
    """Validate an element against the SSP 1.0 schema ``kind`` (ssd, ssv, ssm or ssb)."""
    schema = _schema(kind)
    # A copy: an inline parameter set is validated as a document of its own.
    if not schema.validate(etree.ElementTree(element)):
        first = schema.error_log[0]
        message = first.message
        for prefix, namespace in NAMESPACES.items():
            message = message.replace(f"{{{namespace}}}", f"{prefix}:")
        raise InputError(file, f"line {first.line}", f"not valid SSP 1.0: {message}", "see the SSP 1.0 schema")


def read_document(data: bytes, kind: str, file: str) -> etree._Element:
    """Root element of a valid SSP document of the given kind."""
    root = parse_xml(data, file)
    in_version_1(root, file)
    check_schema(root, kind, file)
    return root


def child(element: etree._Element, name: str) -> etree._Element | None:
    """The first child with a prefixed name such as ``ssd:Connectors``."""
    return element.find(name, NAMESPACES)


def children(element: etree._Element | None, name: str) -> list[etree._Element]:
    """All children with a prefixed name; none of an absent element."""
    return [] if element is None else element.findall(name, NAMESPACES)


def tag(element: etree._Element) -> str:
    """Local name of an element, empty for comments and processing instructions."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
