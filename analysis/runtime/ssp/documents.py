"""XML documents from untrusted sources: no DOCTYPE, validated against the schema of their version, with line numbers.

SSP 1.0 and 2.0 have the same namespaces; the attribute ``version`` selects the schema. The schemas of version 2.0 are
distributed with pyssp_standard, whose code is not imported.
"""

from __future__ import annotations

import importlib.util
from functools import cache
from pathlib import Path

import fmpy
from lxml import etree

from ....common.bounds import XML_BYTES, XML_TAGS
from ....common.errors import InputError

VERSIONS = ("1.0", "2.0")
STANDARD = "http://ssp-standard.org/"


@cache
def schema_folder(version: str) -> Path:
    """Return the folder with the schemas of an SSP version."""
    if version == "1.0":
        return Path(fmpy.__file__).parent / "ssp" / "schema"
    package = importlib.util.find_spec("pyssp_standard")
    assert package is not None  # a dependency
    assert package.origin is not None
    return Path(package.origin).parent / "resources" / "ssp2"


def version_of(root: etree._Element, file: str) -> str:
    """Return the SSP version of a document or of a nested document. Raises InputError for unsupported versions."""
    version = root.get("version", "")
    if not root.tag.startswith(f"{{{STANDARD}"):
        return VERSIONS[0]  # the schema rejects documents that are not SSP
    if version not in VERSIONS:
        problem = f"SSP version {version or '(none)'} is not supported"
        raise InputError(file, f"version (line {root.sourceline})", problem, 'write version="1.0" or version="2.0"')
    return version


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
def _schema(kind: str, version: str) -> etree.XMLSchema:
    return etree.XMLSchema(etree.parse(schema_folder(version) / SCHEMA_FILES[kind]))


def parse_xml(data: bytes, file: str) -> etree._Element:
    """Return the root element of an XML document; a DOCTYPE is rejected before anything is parsed."""
    refusal = InputError(file, "DOCTYPE", "a document type declaration is not accepted", "remove the <!DOCTYPE ...>")
    XML_BYTES.check(len(data), file, "")
    XML_TAGS.check(data.count(b"<"), file, "")
    if b"<!DOCTYPE" in data.upper():
        raise refusal
    parser = _parser()
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        raise InputError(file, f"line {error.lineno}", f"not well-formed XML: {error.msg}", "fix the XML") from error
    if (
        root.getroottree().docinfo.internalDTD is not None
    ):  # a DOCTYPE in another encoding, which the search for bytes misses
        raise refusal
    return root


def _parser(schema: etree.XMLSchema | None = None) -> etree.XMLParser:
    return etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False, schema=schema)


MOST_VIOLATIONS = 100  # lxml locates each violation by counting all elements before it


def check_violations(schema: etree.XMLSchema, document: bytes, file: str) -> bool:
    """Return True if a well-formed document violates a schema. Raises InputError for too many violations."""
    parser = _parser(schema)
    try:
        etree.fromstring(document, parser)
    except etree.XMLSyntaxError as error:
        number = len(parser.error_log)
        if number > MOST_VIOLATIONS:
            problem = f"{number} violations of the schema, the first of them: {error.msg}"
            raise InputError(file, "", problem, "correct the file") from error
        return True
    return False


def check_schema(element: etree._Element, kind: str, file: str) -> None:
    """Validate an element against the schema ``kind`` (ssd, ssv, ssm or ssb) of its version."""
    version = version_of(element, file)
    schema = _schema(kind, version)
    # A copy: an inline parameter set is validated as a separate document.
    if check_violations(schema, etree.tostring(element, with_tail=False), file) and not schema.validate(
        etree.ElementTree(element)
    ):
        first = schema.error_log[0]
        message = first.message
        for prefix, namespace in NAMESPACES.items():
            message = message.replace(f"{{{namespace}}}", f"{prefix}:")
        raise InputError(
            file, f"line {first.line}", f"not valid SSP {version}: {message}", f"see the SSP {version} schema"
        )


def read_document(data: bytes, kind: str, file: str) -> etree._Element:
    """Return the root element of a valid SSP document of the ``kind``."""
    root = parse_xml(data, file)
    check_schema(root, kind, file)
    return root


def signatures(root: etree._Element) -> list[str]:
    """Return a note on each signature in a document (SSP 2.0). Signatures are not verified."""
    return [
        f"Signature (line {element.sourceline}): {element.get('role')}, {element.get('type')}: not verified"
        for element in root.iter(f"{{{NAMESPACES['ssc']}}}Signature")
    ]


def child(element: etree._Element, name: str) -> etree._Element | None:
    """Return the first child with a prefixed name such as ``ssd:Connectors``."""
    return element.find(name, NAMESPACES)


def children(element: etree._Element | None, name: str) -> list[etree._Element]:
    """Return all children with a prefixed name; an empty list for a missing element."""
    return [] if element is None else element.findall(name, NAMESPACES)


def tag(element: etree._Element) -> str:
    """Return the local name of an element, or "" for comments and processing instructions."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
