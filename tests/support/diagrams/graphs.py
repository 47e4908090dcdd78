"""Graphs of systems made by hand or by hypothesis, without any FMU."""

from __future__ import annotations

from hypothesis import strategies

from perilune.analysis.reports.diagram.graph import Block, Edge, Port, PortKey, Side

KINDS = ("plants", "sensors", "guidance", "", "foreign FMU")
MAX_BLOCKS, MAX_PORTS = 7, 4


def block_of(name: str, inputs: dict[str, str], outputs: dict[str, str], path: str = "", kind: str = "") -> Block:
    """A block with scalar ports; the dictionaries are names with units."""
    path = path or name
    block = Block(path, name, kind, f"{name} model")
    for side, ports in ((Side.IN, inputs), (Side.OUT, outputs)):
        for port, unit in ports.items():
            block.ports[PortKey(path, side, port)] = Port(port, "", unit, [f"{path}.{port}"])
    return block


def connect(system: Block, source: tuple[str, str], target: tuple[str, str], change: str = "") -> None:
    """Add an edge between two blocks, each given with its port."""
    keys = PortKey(source[0], Side.OUT, source[1]), PortKey(target[0], Side.IN, target[1])
    ports = {key: port for block in system.all_blocks() for key, port in block.ports.items()}
    pair = tuple(ports[key].signals[0] for key in keys)
    for key in keys:
        ports[key].is_connected = True
    system.edges.append(Edge(*keys, (pair,), ("", ""), change))


@strategies.composite
def graphs(draw: strategies.DrawFn) -> Block:
    """A system of some blocks and any edges, loops of one block included; no port is driven twice."""
    count = draw(strategies.integers(1, MAX_BLOCKS))
    sizes = strategies.integers(0, MAX_PORTS)
    system = Block("", "any", "system")
    for number in range(count):
        ins, outs = draw(sizes), draw(sizes)
        name, kind = f"b{number}" * draw(strategies.integers(1, 6)), draw(strategies.sampled_from(KINDS))
        inputs, outputs = ({f"{side}{k}": "m" for k in range(size)} for side, size in (("u", ins), ("y", outs)))
        system.blocks.append(block_of(name, inputs, outputs, f"b{number}", kind))
    sources = [key for block in system.blocks for key in block.ports if key.side is Side.OUT]
    for block in system.blocks:
        for key in block.ports if sources else ():
            if key.side is Side.IN and draw(strategies.integers(0, 3)):
                source = draw(strategies.sampled_from(sources))
                connect(system, (source.block, source.name), (key.block, key.name))
    return system
