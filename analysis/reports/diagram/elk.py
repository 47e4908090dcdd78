"""The layout engine: ELK, the Eclipse Layout Kernel, in V8. Lengths in px."""

from __future__ import annotations

import json
from typing import Any

from py_mini_racer import MiniRacer

from ....fmus_src.paths import BUILD

BUNDLE = BUILD / "web" / "bundles" / "layout.js"  # which build_web.py makes of web/layout.ts
MISSING = "No block diagram: the bundle that lays it out is not built. Run `make web` where npm is available."
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


def is_available() -> bool:
    """Whether the bundle is built."""
    return BUNDLE.is_file()


class Engine:
    """ELK loaded once, for several layouts; a context."""

    def __init__(self) -> None:
        self.context = MiniRacer()
        self.context.eval(BUNDLE.read_text(encoding="utf-8"))

    def __enter__(self) -> Engine:
        return self

    def __exit__(self, *_: object) -> None:
        self.context.close()

    def lay_out(self, nodes: list[dict[str, Any]], edges: list[dict[str, Any]]) -> dict[str, Any]:
        """A graph of ELK's JSON with the positions of its nodes and ports, and the points of its edges."""
        graph = {"id": "root", "layoutOptions": OPTIONS, "children": nodes, "edges": edges}
        return json.loads(self.context.call("layOut", json.dumps(graph)))
