"""Block diagram of a system on a page."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

from markupsafe import Markup

from ...options.fault import Fault
from ...runtime.system.prepared import PreparedSystem
from .drawing import draw
from .elk import MISSING, Engine, LayoutError
from .graph import DiagramBlock
from .graph_reader import read_graph
from .layout import lay_out
from .placement import Arrangement

Result = TypeVar("Result")
MAX_BLOCKS, MAX_CONNECTIONS = 200, 500  # limits of a legible diagram; a vector counts as one connection

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
