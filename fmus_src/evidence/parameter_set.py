"""Writer of parameter sets (.ssv) of SSP 1.0."""

from __future__ import annotations

from collections.abc import Mapping

from lxml import etree

PREFIXES = {"ssv": "SystemStructureParameterValues", "ssc": "SystemStructureCommon"}
NAMESPACES = {prefix: f"http://ssp-standard.org/SSP1/{name}" for prefix, name in PREFIXES.items()}
SSV = f"{{{NAMESPACES['ssv']}}}"
TYPES = {bool: "Boolean", int: "Integer", float: "Real"}


def write_parameter_set(name: str, parameters: Mapping[str, float | int | bool], description: str = "") -> bytes:
    """Return the content of an .ssv file: parameters by name, each in the unit of its variable."""
    root = etree.Element(f"{SSV}ParameterSet", nsmap=NAMESPACES, version="1.0", name=name)
    if description:
        root.set("description", description)
    parent = etree.SubElement(root, f"{SSV}Parameters")
    for parameter, number in parameters.items():
        text = str(number).lower() if isinstance(number, bool) else repr(number)
        entry = etree.SubElement(parent, f"{SSV}Parameter", name=parameter)
        etree.SubElement(entry, f"{SSV}{TYPES[type(number)]}", value=text)
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True, pretty_print=True)
