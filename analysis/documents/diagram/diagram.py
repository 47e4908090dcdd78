"""Structure of a system on a page: its block diagram, and tables of blocks and connections."""

from __future__ import annotations

import asyncio
from collections import defaultdict
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

from markupsafe import Markup

from ....common.visible import on_one_line, visible
from ...options.fault import Fault
from ...runtime.system.prepared import PreparedSystem
from ..common.page import PageTable, exact
from ..common.quantities import declared_unit, display_unit
from .drawing import draw
from .elk import MISSING, Engine, LayoutError
from .graph import DiagramBlock, Edge, PortKey
from .layout import lay_out
from .placement import Arrangement
from .reading import read_graph

Result = TypeVar("Result")
MAX_NAMED = 20  # outputs of a block without connection
MAX_BLOCKS, MAX_CONNECTIONS = 200, 500  # limits of a legible diagram; a vector is one connection

SHEET = 700.0  # px, width of a page in portrait format
BROAD = 1.6  # width over height from which a diagram is larger in landscape format


@dataclass(frozen=True)
class BlockDiagram:
    """A diagram, or the reason why there is none.

    ``system`` is its graph; ``is_broad`` prints it in landscape format.
    """

    system: DiagramBlock
    svg: Markup | None
    missing: str = ""
    is_broad: bool = False


def make_diagram(prepared: PreparedSystem, faults: Sequence[Fault] = ()) -> BlockDiagram:
    """Return the diagram of a prepared system, including the faults of its run. No FMU is loaded."""
    system = read_graph(prepared, faults)
    blocks = sum(1 for _ in system.all_blocks()) - 1
    parameters = sum(len(block.parameters) for block in system.all_blocks())
    connections = parameters + sum(1 for _ in system.all_edges())
    size = f"{blocks} blocks and {connections} connections"
    if blocks > MAX_BLOCKS or connections > MAX_CONNECTIONS:
        limits = f"at most {MAX_BLOCKS} and {MAX_CONNECTIONS} are drawn"
        return BlockDiagram(system, None, f"No block diagram: {size}; {limits}.")
    try:
        placement = _outside_loops(partial(_lay_out, system))
    except LayoutError as error:
        return BlockDiagram(system, None, f"No block diagram of {size}: {error}.")
    if placement is None:
        return BlockDiagram(system, None, MISSING)
    is_broad = placement.width > max(SHEET, BROAD * placement.height)
    return BlockDiagram(system, draw(system, placement), is_broad=is_broad)


def _lay_out(system: DiagramBlock) -> Arrangement | None:
    """Lay out a system; return None if the layout engine was not built. Raises LayoutError."""
    engine = Engine.load()
    if engine is None:
        return None
    with engine:
        return lay_out(system, engine)


def _outside_loops(call: Callable[[], Result]) -> Result:
    """Call a function, in a separate thread if an event loop runs (notebooks), and return its result."""
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return call()
    with ThreadPoolExecutor(1) as executor:
        return executor.submit(call).result()


def block_table(system: DiagramBlock) -> PageTable:
    """Return the blocks with their FMUs and their unconnected outputs, which are not drawn."""
    rows: list[list[Markup | str]] = []
    for block in system.all_blocks():
        if block is system:
            continue
        visible_ports = block.visible_ports()
        others = [_text(port.label) for key, port in block.ports.items() if key not in visible_ports]
        more = [f"and {len(others) - MAX_NAMED} more"] if len(others) > MAX_NAMED else []
        names = ", ".join([*others[:MAX_NAMED], *more])
        description = Markup('<span class="long">{}</span>').format(_text(block.description))
        rows.append([_text(block.path), _text(block.model), block.kind_label, description, names])
    return PageTable(("block", "FMU", "kind", "description", "other outputs"), rows, ())


def connection_table(system: DiagramBlock) -> PageTable:
    """Return the edges of the diagram: ends, number of connections, unit, conversion."""
    ports = {key: port for block in system.all_blocks() for key, port in block.ports.items()}
    rows = []
    for edge in system.all_edges():
        ends = [_text(f"{key.block}.{ports[key].label}" if key.block else ports[key].label) for key in _ends(edge)]
        rows.append([*ends, str(len(edge.pairs)), declared_unit(ports[edge.source].unit), _text(edge.note)])
    return PageTable(("from", "to", "elements", "unit", "on the way"), rows, (2,))


def parameter_table(prepared: PreparedSystem, system: DiagramBlock) -> PageTable:
    """Return the parameters that a system passes to its blocks, with their values; a dash if no value is set."""
    targets: dict[str, list[str]] = defaultdict(list)
    for block in system.all_blocks():
        for source, target in (pair for edge in block.parameters for pair in edge.pairs):
            targets[source].append(target)
    rows = []
    for name, given_to in targets.items():
        node = prepared.network.nodes[name]
        unit = node.unit.name if node.unit else None
        setting = exact(prepared.settings.nodes.get(name), unit, 6)
        rows.append([_text(name), setting, display_unit(unit), _text(", ".join(given_to))])
    return PageTable(("parameter", "value", "unit", "given to"), rows, (1,))


def _ends(edge: Edge) -> tuple[PortKey, PortKey]:
    return edge.source, edge.target


def _text(text: str) -> str:
    return on_one_line(visible(text))
