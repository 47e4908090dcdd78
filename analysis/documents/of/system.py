"""The document of a system for a page: block diagram, blocks, connections, parameters."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path

from ....common.visible import on_one_line, visible
from ...runtime.system.prepared import PreparedSystem
from ..cell import Cell, Code, Head, Quantity
from ..common.quantities import declared_unit, display_unit
from ..diagram.diagram import BlockDiagram, make_diagram
from ..diagram.graph import DiagramBlock
from ..model import Document, KeyNumbers, Missing, Node, Note, Section, Table
from ..pictures import Blocks

MAX_NAMED = 20  # unconnected outputs of a block that are named


def system_document(prepared: PreparedSystem) -> Document:
    """Return the document of a prepared system; the diagram shares a sheet of paper with the header."""
    diagram = make_diagram(prepared)
    name, file = prepared.archive.name, Path(prepared.network.file).name
    key_numbers: dict[str, Cell] = {
        "communication step": Quantity(prepared.step, "s"),
        "end": Quantity(prepared.start + prepared.steps * prepared.step, "s", 6),
        "algorithm": prepared.algorithm,
    }
    parameters = parameter_table(prepared, diagram.system)
    return diagram_document(
        name, file if prepared.archive.is_fmu else f"{name}/{file}", key_numbers, diagram, parameters
    )


def diagram_document(
    name: str, file: str, key_numbers: Mapping[str, Cell], diagram: BlockDiagram, parameters: Table
) -> Document:
    """Return the document of a system from its diagram, with ``key_numbers`` next to the number of blocks."""
    blocks, connections = block_table(diagram.system), connection_table(diagram.system)
    connected: Sequence[Node] = [
        connections,
        Note(
            "Units are those of the connectors. If the last column is empty, values are passed unchanged, "
            "element by element."
        ),
    ]
    sections = [
        Section("Block diagram", [Blocks(diagram)], style="whole sheet" if diagram.is_broad else "whole"),
        Section("Blocks", [blocks]),
        Section("Connections", connected if connections.rows else [Missing("nothing is connected")]),
        *([Section("Parameters of the system", [parameters])] if parameters.rows else []),
    ]
    summary: list[Node] = [Note([Code(file)]), KeyNumbers([("blocks", len(blocks.rows)), *key_numbers.items()])]
    return Document(name, summary, sections, {})


def block_table(system: DiagramBlock) -> Table:
    """Return the table of blocks with their FMUs and their unconnected outputs, which are not drawn."""
    rows: list[Sequence[Cell]] = []
    for block in system.all_blocks():
        if block is system:
            continue
        visible_ports = block.visible_ports()
        others = [_text(port.label) for key, port in block.ports.items() if key not in visible_ports]
        more = [f"and {len(others) - MAX_NAMED} more"] if len(others) > MAX_NAMED else []
        names = ", ".join([*others[:MAX_NAMED], *more])
        rows.append((_text(block.path), _text(block.model), block.kind_label, _text(block.description), names))
    return Table(("block", "FMU", "kind", Head("description", column="sentences"), "other outputs"), rows)


def connection_table(system: DiagramBlock) -> Table:
    """Return the table of the diagram's edges: ends, number of connections, unit, conversion."""
    ports = {key: port for block in system.all_blocks() for key, port in block.ports.items()}
    rows: list[Sequence[Cell]] = []
    for edge in system.all_edges():
        ends = (edge.source, edge.target)
        names = [_text(f"{key.block}.{ports[key].label}" if key.block else ports[key].label) for key in ends]
        rows.append((*names, len(edge.pairs), declared_unit(ports[edge.source].unit), _text(edge.note)))
    return Table(("from", "to", "elements", "unit", "on the way"), rows)


def parameter_table(prepared: PreparedSystem, system: DiagramBlock) -> Table:
    """Return the table of parameters that a system passes to its blocks, with values, or a dash if none is set."""
    targets: dict[str, list[str]] = defaultdict(list)
    for block in system.all_blocks():
        for source, target in (pair for edge in block.parameters for pair in edge.pairs):
            targets[source].append(target)
    rows: list[Sequence[Cell]] = []
    for name, fed in targets.items():
        node = prepared.network.nodes[name]
        unit = node.unit.name if node.unit else None
        setting = prepared.settings.nodes.get(name)
        value = setting if isinstance(setting, str) else Quantity(setting, unit, 6, is_bare=True)
        rows.append((_text(name), value, display_unit(unit), _text(", ".join(fed))))
    return Table(("parameter", Head("value", column="numbers"), "unit", "given to"), rows)


def _text(text: str) -> str:
    return on_one_line(visible(text))
