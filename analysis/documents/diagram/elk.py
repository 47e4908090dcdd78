"""Layout engine: ELK, the Eclipse Layout Kernel, in V8. Lengths are in px.

V8 receives only sizes, sides and generated identifiers: no text of a system.
"""

from __future__ import annotations

import json
from typing import Any

from py_mini_racer import JSEvalException, JSTimeoutException, MiniRacer

from ..interactive.script_bundles import read_bundle

MISSING = (
    "No block diagram: the layout engine is not built (npm was not available). Run `make web`, then this command again."
)
STRAIGHTEST = 2000  # product of boxes and edges up to which lines are straightened, which takes some 3 s
FASTER = {"elk.layered.nodePlacement.strategy": "BRANDES_KOEPF"}
PATIENCE = 60.0  # s, time limit of one layout; 200 boxes with 500 edges take 4 to 13 s
MEMORY = 1 << 30  # bytes, memory limit of V8
OPTIONS = {
    "elk.algorithm": "layered",
    "elk.direction": "RIGHT",
    "elk.edgeRouting": "ORTHOGONAL",
    "elk.separateConnectedComponents": "false",
    "elk.padding": "[top=0,left=0,bottom=0,right=0]",
    "elk.spacing.nodeNode": "20",
    "elk.spacing.edgeNode": "10",
    "elk.spacing.edgeEdge": "6",
    "elk.layered.nodePlacement.strategy": "NETWORK_SIMPLEX",
    "elk.layered.spacing.nodeNodeBetweenLayers": "24",
    "elk.layered.spacing.edgeNodeBetweenLayers": "10",
    "elk.layered.spacing.edgeEdgeBetweenLayers": "5",
}


class LayoutError(Exception):
    """Failure of the engine to lay out a graph; the message states the reason."""


class Engine:
    """ELK, loaded once for several layouts; a context manager. ``script`` is the bundle of web/layout.ts."""

    def __init__(self, script: str) -> None:
        self.context = MiniRacer()
        self.context.eval(script)

    @classmethod
    def load(cls) -> Engine | None:
        """Return the engine, or None if its bundle was not built."""
        script = read_bundle("layout")
        return None if script is None else cls(script)

    def __enter__(self) -> Engine:
        return self

    def __exit__(self, *_: object) -> None:
        self.context.close()

    def lay_out(self, nodes: list[dict[str, Any]], edges: list[dict[str, Any]]) -> dict[str, Any]:
        """Return a graph in ELK's JSON with positions of nodes and ports, and points of edges, added.

        Raises LayoutError.
        """
        options = OPTIONS if len(nodes) * len(edges) <= STRAIGHTEST else OPTIONS | FASTER
        graph = json.dumps({"id": "root", "layoutOptions": options, "children": nodes, "edges": edges})
        try:
            return json.loads(self.context.call("layOut", graph, timeout_sec=PATIENCE, max_memory=MEMORY))
        except JSTimeoutException as error:
            self.context.eval("0")  # returns after the stopped call has ended
            raise LayoutError(f"it would take more than {PATIENCE:g} s") from error
        except JSEvalException as error:  # its text contains the engine's source
            raise LayoutError("it needs too much memory, or too deep a stack") from error
