"""XML documents from outside, read with care: no DOCTYPE, valid against their schema, lines kept; SSP 2.0 as 1.0.

What is new in 2.0 is refused by name, but for what nothing flies by. Namespaces are those of 1.0, and every document of
1.0 is one of 2.0 (SSP 2.0, release notes). fmpy has no schema of 2.0: a document without anything new is checked
against that of 1.0.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import fmpy
from lxml import etree

from ...common.bounds import XML_BYTES, XML_TAGS
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
    XML_BYTES.check(len(data), file, "")
    XML_TAGS.check(data.count(b"<"), file, "")
    if b"<!DOCTYPE" in data.upper():
        raise refusal
    parser = _parser()
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        raise InputError(file, f"line {error.lineno}", f"not well-formed XML: {error.msg}", "fix the XML") from error
    if root.getroottree().docinfo.internalDTD is not None:  # in an encoding in which the bytes look otherwise
        raise refusal
    return root


def _parser(schema: etree.XMLSchema | None = None) -> etree.XMLParser:
    return etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False, schema=schema)


MOST_VIOLATIONS = 100  # of which lxml looks for the place, each time among all elements before it


def check_violations(schema: etree.XMLSchema, document: bytes, file: str) -> bool:
    """Whether a document, which is well-formed, violates a schema; raises InputError for very many violations."""
    parser = _parser(schema)
    try:
        etree.fromstring(document, parser)
    except etree.XMLSyntaxError as error:
        number = len(parser.error_log)
        if number > MOST_VIOLATIONS:
            problem = f"{number} violations of its schema; the first: {error.msg}"
            raise InputError(file, "", problem, "correct the file") from error
        return True
    return False


def check_schema(element: etree._Element, kind: str, file: str) -> None:
    """Validate an element against the SSP 1.0 schema ``kind`` (ssd, ssv, ssm or ssb)."""
    schema = _schema(kind)
    # A copy: an inline parameter set is validated as a document of its own.
    if check_violations(schema, etree.tostring(element, with_tail=False), file) and not schema.validate(
        etree.ElementTree(element)
    ):
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
