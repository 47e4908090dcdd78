"""A loop's cut as channels: which connectors a signal is added to, and what is read on either side of the cut."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from analysis.cosim.network import Network
from analysis.errors import InputError, suggestion

from .declaration import Loop

AXES = ("x", "y", "z")
Signals = Mapping[str, np.ndarray]


@dataclass(frozen=True)
class Channel:
    """One scalar signal that is cut.

    ``connectors`` are those that a signal is added to: one, or the size and the three components of a direction,
    of which ``axis`` is added to. ``returned``: the connector that comes back where it is not the cut itself.
    ``period``: how often the loop passes the cut, in communication points.
    """

    name: str
    loop: str
    connectors: tuple[str, ...]
    axis: int | None
    returned: str | None
    period: int
    amplitude: float | None
    unit: str | None

    @property
    def recorded(self) -> tuple[str, ...]:
        return self.connectors if self.returned is None else (*self.connectors, self.returned)

    def excitation(self, signals: Signals, added: np.ndarray) -> np.ndarray:
        """What to add to each connector [r, connectors], so that the cut gains ``added`` [r].

        ``signals`` are those of the flight without it: along them a vector's size and direction change together.
        """
        if self.axis is None:
            return added[:, None]
        size = signals[self.connectors[0]]
        direction = np.column_stack([signals[name] for name in self.connectors[1:]])
        along = direction[:, self.axis] * added
        across = -direction * along[:, None]
        across[:, self.axis] += added
        return np.column_stack([along, across / size[:, None]])

    def injected(self, signals: Signals) -> np.ndarray:
        """The signal behind the cut, with what was added."""
        if self.axis is None:
            return signals[self.connectors[0]]
        return signals[self.connectors[0]] * signals[self.connectors[1 + self.axis]]

    def back(self, signals: Signals, excitation: np.ndarray) -> np.ndarray:
        """The signal that comes back; ``excitation`` [r, connectors] is what was added to get ``signals``."""
        if self.returned is not None:
            return signals[self.returned]
        before = {name: signals[name] - excitation[:, place] for place, name in enumerate(self.connectors)}
        return self.injected(before)


def channels_of(loop: Loop, network: Network, step: float) -> list[Channel]:
    """The channels of a loop in a network with communication step ``step`` (s). Raises InputError."""
    where = f"loop {loop.name}"
    period = 1
    if loop.period is not None:
        period = round(loop.period / step)
        if period < 1 or abs(period * step - loop.period) > 1e-9 * loop.period:
            problem = f"period {loop.period:g} s is no whole number of communication steps of {step:g} s"
            raise InputError(network.file, where, problem, "give a period or a step that fits")
    cut = _connectors(network, loop.cut, where)
    returned = _connectors(network, loop.returned, where) if loop.returned else [None] * len(cut)
    unit = _unit(network, cut[0])

    def channel(name: str, connectors: tuple[str, ...], axis: int | None, back: str | None) -> Channel:
        return Channel(name, loop.name, connectors, axis, back, period, loop.amplitude, unit)

    if loop.direction is not None:
        direction = _connectors(network, loop.direction, where)
        if len(cut) != 1 or len(direction) != 3:
            problem = f"{loop.cut} times {loop.direction} are {len(cut)} times {len(direction)} connectors"
            raise InputError(network.file, where, problem, "give a size and a direction of three components")
        backs = returned if len(returned) == 3 else [None] * 3
        if loop.returned and len(returned) != 3:
            raise InputError(network.file, where, f"{loop.returned} has not three components", "name a vector")
        return [channel(f"{loop.name}.{name}", (*cut, *direction), axis, backs[axis]) for axis, name in enumerate(AXES)]
    if len(returned) != len(cut):
        problem = f"{loop.returned} has {len(returned)} components, {loop.cut} {len(cut)}"
        raise InputError(network.file, where, problem, "name a signal with as many")
    if len(cut) == 1:
        return [channel(loop.name, (cut[0],), None, returned[0])]
    return [
        channel(f"{loop.name}[{place}]", (name,), None, back)
        for place, (name, back) in enumerate(zip(cut, returned, strict=True), 1)
    ]


def _connectors(network: Network, name: str, where: str) -> list[str]:
    """The Real connectors that a name stands for: its own, or those of the vector of this name."""
    found = [name] if name in network.nodes else []
    while not found or f"{name}[{len(found) + 1}]" in network.nodes:
        element = f"{name}[{len(found) + 1}]"
        if found == [name] or element not in network.nodes:
            break
        found.append(element)
    known = [node.name for node in network.nodes.values() if node.component is not None]
    if not found:
        raise InputError(network.file, where, f"no connector {name}", suggestion(name, known))
    for item in found:
        node = network.nodes[item]
        if node.component is None or node.kind not in ("output", "input") or node.type_name != "Real":
            problem = f"{item} is no Real input or output of a component"
            raise InputError(network.file, where, problem, "name one as component.connector")
    return found


def _unit(network: Network, name: str) -> str | None:
    unit = network.nodes[name].unit
    return unit.name if unit else None
