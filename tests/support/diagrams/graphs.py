"""Graphs of systems without FMUs, hand-written or generated at random."""

from __future__ import annotations

from hypothesis import strategies

from perilune.analysis.documents.diagram.graph import DiagramBlock, DiagramPort, Edge, PortKey, Side

KINDS = ("plants", "sensors", "guidance", "", "foreign FMU")
MAX_BLOCKS, MAX_PORTS = 7, 4


def block_of(
    name: str, inputs: dict[str, str], outputs: dict[str, str], path: str = "", kind: str = ""
) -> DiagramBlock:
    """Return a block with scalar ports; the dictionaries are names with units."""
    path = path or name
    block = DiagramBlock(path, name, kind, f"{name} model")
    add_ports(block, inputs, outputs)
    return block


def add_ports(block: DiagramBlock, inputs: dict[str, str], outputs: dict[str, str]) -> None:
    """Give a block scalar ports."""
    for side, ports in ((Side.IN, inputs), (Side.OUT, outputs)):
        for port, unit in ports.items():
            name = f"{block.path}.{port}" if block.path else port
            block.ports[PortKey(block.path, side, port)] = DiagramPort(port, "", unit, [name])


def connect(system: DiagramBlock, source: tuple[str, str], target: tuple[str, str], change: str = "") -> None:
    """Add an edge between two blocks inside a system, each named with its port."""
    join(system, PortKey(source[0], Side.OUT, source[1]), PortKey(target[0], Side.IN, target[1]), change)


def join(system: DiagramBlock, source: PortKey, target: PortKey, change: str = "") -> None:
    """Add an edge between two ports, of the system or of blocks inside it."""
    blocks = {block.path: block for block in system.all_blocks()}
    pair = blocks[source.block].ports[source].signals[0], blocks[target.block].ports[target].signals[0]
    sources = [edge.source for edge in system.edges if edge.target._replace(entry=0) == target]
    entry = blocks[target.block].add_entry(target, len(dict.fromkeys(sources)))
    if source in sources:
        entry = next(edge.target for edge in system.edges if edge.source == source and edge.target[:3] == target[:3])
    for key in (source, entry):
        blocks[key.block].ports[key].is_connected = True
    system.edges.append(Edge(source, entry, (pair,), ("", ""), change))


@strategies.composite
def graphs(draw: strategies.DrawFn) -> DiagramBlock:
    """Draw a system of some blocks, one of which may be a system, and any edges, loops of one block included."""
    system = draw(levels(""))
    if system.blocks and draw(strategies.booleans()):
        number = draw(strategies.integers(0, len(system.blocks) - 1))
        inner = draw(levels(f"b{number}"))
        outer = system.blocks[number]
        inner.name = outer.name
        system.edges = [edge for edge in system.edges if {edge.source, edge.target}.isdisjoint(outer.ports)]
        system.blocks[number] = inner
        others = [key for block in system.blocks if block is not inner for key in block.ports if not key.entry]
        for key in [key for key in inner.ports if not key.entry]:
            opposite = [other for other in others if other.side is not key.side]
            if opposite and draw(strategies.booleans()):
                other = draw(strategies.sampled_from(opposite))
                join(system, *((other, key) if key.side is Side.IN else (key, other)))
    return system


@strategies.composite
def levels(draw: strategies.DrawFn, path: str) -> DiagramBlock:
    """Draw a system with connectors, blocks and edges inside, some of several sources."""
    sizes = strategies.integers(0, MAX_PORTS)
    system = DiagramBlock(path, "any", "system")
    add_ports(system, *({f"{side}{k}": "m" for k in range(draw(sizes))} for side in ("in", "out")))
    for number in range(draw(strategies.integers(1, MAX_BLOCKS))):
        inputs, outputs = ({f"{side}{k}": "m" for k in range(draw(sizes))} for side in ("u", "y"))
        name, kind = f"b{number}" * draw(strategies.integers(1, 6)), draw(strategies.sampled_from(KINDS))
        inner_path = f"{path}.b{number}" if path else f"b{number}"
        system.blocks.append(block_of(name, inputs, outputs, inner_path, kind))
    inner = [key for block in system.blocks for key in block.ports]
    sources = [key for key in inner if key.side is Side.OUT] + [key for key in system.ports if key.side is Side.IN]
    targets = [key for key in inner if key.side is Side.IN] + [key for key in system.ports if key.side is Side.OUT]
    for target in targets if sources else ():
        count = draw(strategies.sampled_from([0, 1, 1, 1, 2]))
        chosen = strategies.lists(strategies.sampled_from(sources), min_size=1, max_size=2, unique=True)
        for source in draw(chosen)[:count]:
            join(system, source, target)
    return system
