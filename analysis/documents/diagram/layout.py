"""Layout of a system: forward edges by ELK, feedback edges below, nested systems first. Lengths are in px."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import Any

from .elk import Engine
from .graph import DiagramBlock, Edge, PortKey, Side
from .lanes import join_rows
from .order import order_blocks
from .placement import Arrangement, PlacedBlock, Point, Route, Terminal
from .rows import columns_of, cut_into_rows
from .shapes import HEADER, LINE, MARGIN, TERMINAL, Label, port_label, shape_of

ARROW = 12.0  # width of a terminal's arrow, next to its label
INNER = 14.0  # distance between a system's frame and its content


def lay_out(system: DiagramBlock, engine: Engine) -> Arrangement:
    """Lay out a whole system. Raises LayoutError."""
    return _System(engine, system, is_whole=True).placement()


class _System:
    def __init__(self, engine: Engine, system: DiagramBlock, *, is_whole: bool) -> None:
        self.engine = engine
        self.system = system
        self.is_whole = is_whole
        self.notes = _notes(system)
        self.nodes: dict[int, dict[str, Any]] = {}  # nodes by identity of their box
        self.ids: dict[PortKey, str] = {}

    def placement(self) -> Arrangement:
        """Lay out the system, in several rows if it would be wider than a page."""
        boxes: list[PlacedBlock | Terminal] = [self.block(block) for block in self.system.blocks]
        boxes += self.terminals()
        forward, back = self.split()
        whole = self.arrange(boxes, forward)
        rows = self.rows(whole)
        if len(rows) == 1:
            return join_rows([whole], back)
        homes = {key: number for number, row in enumerate(rows) for box in row for key in box.ports}
        inside = [[edge for edge in forward if homes[edge.source] == homes[edge.target] == number]
                  for number in range(len(rows))]  # fmt: skip
        placements = [self.arrange(row, edges) for row, edges in zip(rows, inside, strict=True)]
        between = [edge for edge in forward if homes[edge.source] != homes[edge.target]]
        return join_rows(placements, [*between, *back])

    def rows(self, whole: Arrangement) -> list[list[PlacedBlock | Terminal]]:
        """Return the boxes of each row; a nested system is a single row with terminals at both sides.

        A terminal of the whole system is in the row of the first block that it is connected to.
        """
        columns = columns_of(whole.blocks)
        if not self.is_whole or not columns:
            return [whole.boxes]
        numbers = {key: number for number, column in enumerate(columns) for box in column.boxes for key in box.ports}
        ends = [(route.edge.source, route.edge.target) for route in whole.routes]
        arcs = [(numbers[source], numbers[target]) for source, target in ends if {source, target} <= numbers.keys()]
        cut = cut_into_rows(columns, arcs)
        rows = [[box for number in row for box in columns[number].boxes] for row in cut]
        for terminal in whole.terminals:
            others = [key for pair in ends if terminal.key in pair for key in pair if key in numbers]
            rows[next((k for k, row in enumerate(cut) if others and numbers[others[0]] in row), 0)].append(terminal)
        return rows

    def arrange(self, boxes: Sequence[PlacedBlock | Terminal], edges: Sequence[Edge]) -> Arrangement:
        """Lay out boxes and the edges between them from left to right."""
        lines = [
            {"id": f"e{number}", "sources": [self.ids[edge.source]], "targets": [self.ids[edge.target]]}
            for number, edge in enumerate(edges)
        ]
        result = self.engine.lay_out([self.nodes[id(box)] for box in boxes], lines)
        placement = Arrangement(result["width"], result["height"])
        for node, box in zip(result["children"], boxes, strict=True):
            box.x, box.y, box.width, box.height = (node[name] for name in ("x", "y", "width", "height"))
            points = {port["id"]: (node["x"] + port["x"], node["y"] + port["y"]) for port in node["ports"]}
            if isinstance(box, PlacedBlock):
                box.ports = {key: points[self.ids[key]] for key in box.shape.labels}
                placement.blocks.append(box)
            else:
                box.point = points[self.ids[box.key]]
                placement.terminals.append(box)
        for edge, line in zip(edges, result["edges"], strict=True):
            (section,) = line["sections"]
            bends = [section["startPoint"], *section.get("bendPoints", []), section["endPoint"]]
            placement.routes.append(Route(edge, [(bend["x"], bend["y"]) for bend in bends]))
        return placement

    def block(self, block: DiagramBlock) -> PlacedBlock:
        """Place a block and add its node; a nested system is laid out first."""
        shape = shape_of(block, self.notes)
        node: dict[str, Any] = {"id": f"b{len(self.nodes)}"}
        placed = PlacedBlock(block, shape, 0.0, 0.0, shape.width, shape.height, {})
        positions: dict[PortKey, Point] = {}
        if block.blocks:
            placed.inner = _System(self.engine, block, is_whole=False).placement()
            head = HEADER + shape.foot
            placed.width = max(shape.width, placed.inner.width)
            placed.height = head + placed.inner.height + INNER
            placed.origin = ((placed.width - placed.inner.width) / 2.0, head)
            for terminal in placed.inner.terminals:
                x = 0.0 if terminal.key.side is Side.IN else placed.width
                positions[terminal.key] = (x, terminal.point[1] + head)
            node |= {"width": placed.width, "height": placed.height}
            node["layoutOptions"] = {"elk.portConstraints": "FIXED_POS"}
        else:
            node["layoutOptions"] = {
                "elk.portConstraints": "FIXED_SIDE",
                "elk.portAlignment.default": "BEGIN",
                "elk.nodeSize.constraints": "[PORTS, MINIMUM_SIZE]",
                "elk.nodeSize.minimum": f"({shape.width}, {shape.height})",
            }
            margins = f"[top={HEADER + LINE / 2.0},left=0,bottom={shape.foot + LINE / 2.0},right=0]"
            node["individualSpacings"] = {
                "elk.spacing.portPort": str(LINE),
                "elk.spacing.portsSurrounding": margins,
            }
        node["ports"] = [self.port(key, positions.get(key)) for key in shape.labels]
        self.nodes[id(placed)] = node
        return placed

    def port(self, key: PortKey, position: Point | None = None) -> dict[str, Any]:
        self.ids[key] = f"p{len(self.ids)}"
        port: dict[str, Any] = {"id": self.ids[key], "width": 0, "height": 0}
        port["layoutOptions"] = {"elk.port.side": "WEST" if key.side is Side.IN else "EAST"}
        return port if position is None else port | {"x": position[0], "y": position[1]}

    def terminals(self) -> list[Terminal]:
        """Return the system's connectors: at its frame, or anywhere in the whole system, which has no frame."""
        visible = self.system.visible_ports()
        labels = {key: self.terminal_label(key) for key in visible}
        widths = {side: max((labels[key].width for key in visible if key.side is side), default=0.0) for side in Side}
        terminals = []
        for key, port in visible.items():
            width = (labels[key].width if self.is_whole else widths[key.side]) + ARROW + MARGIN
            terminals.append(Terminal(key, port, labels[key], 0.0, 0.0, width, TERMINAL, (0.0, 0.0)))
            inside = PortKey(key.block, Side.OUT if key.side is Side.IN else Side.IN, key.name)
            point = (width if key.side is Side.IN else 0.0, TERMINAL / 2.0)
            self.ids[key] = f"p{len(self.ids)}"
            node: dict[str, Any] = {"id": f"t{len(terminals)}", "width": width, "height": TERMINAL}
            node["ports"] = [self.port(inside, point) | {"id": self.ids[key]}]
            node["layoutOptions"] = {"elk.portConstraints": "FIXED_POS"}
            if not self.is_whole:
                layer = "FIRST_SEPARATE" if key.side is Side.IN else "LAST_SEPARATE"
                node["layoutOptions"]["elk.layered.layering.layerConstraint"] = layer
            self.nodes[id(terminals[-1])] = node
        return terminals

    def terminal_label(self, key: PortKey) -> Label:
        port = self.system.ports[key]
        note = self.notes.get(key, "")
        return port_label(PortKey(key.block, Side.OUT, key.name), port, "") if not note else port_label(key, port, note)

    def split(self) -> tuple[list[Edge], list[Edge]]:
        """Return the edges from left to right, and the feedback edges."""
        numbers = {block.path: number for number, block in enumerate(self.system.blocks)}
        inner = [edge for edge in self.system.edges if edge.source.block in numbers and edge.target.block in numbers]
        arcs = [(numbers[edge.source.block], numbers[edge.target.block]) for edge in inner]
        positions = order_blocks(len(numbers), arcs)
        back = {
            edge for edge, (source, target) in zip(inner, arcs, strict=True) if positions[source] >= positions[target]
        }
        edges = self.system.edges
        return [edge for edge in edges if edge not in back], [edge for edge in edges if edge in back]


def _notes(system: DiagramBlock) -> dict[PortKey, str]:
    """Return the notes at the ports that edges enter; a port with several entries names their source blocks."""
    names = {block.path: block.name for block in system.blocks} | {system.path: ""}
    shared = {edge.target._replace(entry=0) for edge in system.edges if edge.target.entry}
    notes: dict[PortKey, list[str]] = defaultdict(list)
    for edge in system.edges:
        origin = names[edge.source.block] if edge.target._replace(entry=0) in shared else ""
        notes[edge.target].append(" ".join(filter(None, (origin, edge.note))))
    return {key: "; ".join(filter(None, texts)) for key, texts in notes.items()}
