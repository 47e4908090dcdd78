"""Terminals of an FMU of FMI 3.0: groups of variables that are connected together, by the name of the terminal."""

from __future__ import annotations

from lxml import etree

from ....common.zips import open_zip, read_entry
from ..ssp.documents import parse_xml

TERMINALS = "terminalsAndIcons/terminalsAndIcons.xml"


def read_terminals(content: bytes, label: str) -> dict[str, list[str]]:
    """Return the variables of each terminal by its name; a nested terminal has a dotted name. Raises InputError."""
    archive = open_zip(content, label)
    if TERMINALS not in archive.namelist():
        return {}
    root = parse_xml(read_entry(archive, TERMINALS, label), f"{label}!{TERMINALS}")
    terminals: dict[str, list[str]] = {}
    for terminal in root.iterfind("Terminals/Terminal"):
        _add(terminal, "", terminals)
    return terminals


def _add(terminal: etree._Element, prefix: str, terminals: dict[str, list[str]]) -> None:
    name = f"{prefix}{terminal.get('name', '')}"
    members = terminal.iterfind("TerminalMemberVariable")
    terminals[name] = [member.get("variableName", "") for member in members]
    for inner in terminal.iterfind("Terminal"):
        _add(inner, f"{name}.", terminals)
