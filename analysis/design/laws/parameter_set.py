"""A law as a parameter set (.ssv) for the component that flies it."""

from __future__ import annotations

from lxml import etree

from ...runtime.ssp.documents import NAMESPACES
from .law import EXP_SATURATIONS, Law


def law_parameters(law: Law, component: str) -> dict[str, int | float]:
    """The law as values of ``component``'s parameters matrix, q and exp_saturation, by name."""
    values: dict[str, int | float] = {}
    for row, entries in enumerate(law.matrix, 1):
        for column, entry in enumerate(entries, 1):
            values[f"{component}.matrix[{row},{column}]"] = entry
    for place, value in enumerate(law.q, 1):
        values[f"{component}.q[{place}]"] = value
    values[f"{component}.exp_saturation"] = EXP_SATURATIONS.index(law.exp_saturation)
    return values


def parameter_set(law: Law, component: str) -> bytes:
    """The content of an .ssv file with the whole law, zeros of the matrix included."""
    space = f"{{{NAMESPACES['ssv']}}}"
    root = etree.Element(f"{space}ParameterSet", nsmap={"ssv": NAMESPACES["ssv"], "ssc": NAMESPACES["ssc"]})
    root.set("version", "1.0")
    root.set("name", law.name)
    if law.description:
        root.set("description", law.description)
    parameters = etree.SubElement(root, f"{space}Parameters")
    for name, value in law_parameters(law, component).items():
        parameter = etree.SubElement(parameters, f"{space}Parameter", name=name)
        kind = "Integer" if isinstance(value, int) else "Real"
        etree.SubElement(parameter, f"{space}{kind}", value=repr(value))
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True, pretty_print=True)
