"""Writer of terminalsAndIcons/terminalsAndIcons.xml of FMI 3.0: groups of variables to be connected together.

The shared interface (slot) of a block, such as terminal_guidance, is a terminal with the connectors that the slot
declares; a bundle, such as ThrustCommand, is a terminal within the slot or the block. Terminals are connected by the
names of their members.
"""

from __future__ import annotations

from lxml import etree

from ...block import Block, snake_case
from ...bundles import Connectors
from ...variables import Input, Output
from .fmi3 import FMI_VERSION

FILE = "terminalsAndIcons/terminalsAndIcons.xml"
KIND = "org.perilune"
SIGNAL = "signal"


def terminals(block_class: type[Block]) -> bytes | None:
    """Return the document of a block, or None if it has neither a slot with connectors nor a bundle."""
    root = etree.Element("fmiTerminalsAndIcons", fmiVersion=FMI_VERSION)
    listed = etree.SubElement(root, "Terminals")
    known: set[str] = set()
    for owner in reversed(block_class.__mro__):
        if not issubclass(owner, Block) or owner is Block:
            continue
        new = [name for name in _connectors(owner) if name not in known]
        bundles = {name: bundle for name, bundle in owner.bundles.items() if set(bundle.names.values()) <= {*new}}
        known.update(new)
        parent = listed
        if owner.is_interface and new:
            parent = etree.SubElement(
                listed,
                "Terminal",
                name=owner.fmu_name,
                matchingRule="bus",
                description=owner.summary(),
            )
            bundled = {name for bundle in bundles.values() for name in bundle.names.values()}
            for name in new:
                if name not in bundled:
                    _add_member(parent, name, name)
        for name, bundle in bundles.items():
            _add_bundle(parent, name, bundle)
    if len(listed) == 0:
        return None
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)


def _connectors(owner: type[Block]) -> list[str]:
    """Return the names of a class's inputs and outputs, including inherited ones."""
    return [name for name, variable in owner.variables.items() if isinstance(variable, Input | Output)]


def _add_bundle(parent: etree._Element, name: str, bundle: Connectors) -> None:
    """Add a terminal whose members have the names of the bundle's ports, without the block's prefix."""
    kind = f"{KIND}.{snake_case(bundle.bundle.__name__)}"
    about = (bundle.bundle.__doc__ or "").strip().partition("\n")[0]
    terminal = etree.SubElement(
        parent, "Terminal", name=name, matchingRule="plug", terminalKind=kind, description=about
    )
    for member, variable in bundle.names.items():
        _add_member(terminal, member, variable)


def _add_member(terminal: etree._Element, member: str, variable: str) -> None:
    etree.SubElement(terminal, "TerminalMemberVariable", variableName=variable, memberName=member, variableKind=SIGNAL)
