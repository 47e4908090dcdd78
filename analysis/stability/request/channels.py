"""Channels of a loop's cut: the connectors that are excited, and the signals on either side of the cut."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ....common.errors import InputError, suggestion
from ...runtime.ssp.names import elements
from ...runtime.system.network import Network
from ...runtime.system.options import STEP_ROUNDING
from .declaration import LoopDeclaration

AXES = ("x", "y", "z")
Signals = Mapping[str, np.ndarray]


@dataclass(frozen=True)
class Channel:
    """One scalar signal that is cut.

    ``connectors`` are the excited connectors: a single one, or the magnitude and the three components of a direction,
    of which ``axis`` is excited. With ``rates``, the connectors of the direction's rate, the effective direction is the
    direction reached ``ahead`` (s) later. ``returned`` is the connector of the return signal, unless this is the cut
    itself. ``period`` is the loop's sample period in communication points.
    """

    name: str
    loop: str
    connectors: tuple[str, ...]
    axis: int | None
    returned: str | None
    period: int
    amplitude: float | None
    unit: str | None
    rates: tuple[str, ...] = ()
    ahead: float = 0.0

    @property
    def recorded(self) -> tuple[str, ...]:
        """All connectors that are read."""
        returned = () if self.returned is None else (self.returned,)
        return (*self.connectors, *self.rates, *returned)

    def _towards(self, signals: Signals) -> np.ndarray:
        """Return the effective direction [r, 3], of any length."""
        direction = np.column_stack([signals[name] for name in self.connectors[1:]])
        if self.rates:
            direction = direction + self.ahead * np.column_stack([signals[name] for name in self.rates])
        return direction

    def excitation(self, signals: Signals, added: np.ndarray) -> np.ndarray:
        """Return the excitation of each connector [r, connectors] that adds ``added`` [r] at the cut.

        ``signals`` are from the undisturbed simulation. To change one component of a vector, its magnitude and its
        direction are excited together.
        """
        if self.axis is None:
            return added[:, None]
        size = signals[self.connectors[0]]
        towards = self._towards(signals)
        length = np.linalg.norm(towards, axis=1)
        direction = towards / length[:, None]
        along = direction[:, self.axis] * added
        across = -direction * along[:, None]
        across[:, self.axis] += added
        return np.column_stack([along, across * (length / size)[:, None]])

    def injection_for(self, signals: Signals) -> np.ndarray:
        """Return the signal after the cut, including the excitation."""
        if self.axis is None:
            return signals[self.connectors[0]]
        towards = self._towards(signals)
        return signals[self.connectors[0]] * towards[:, self.axis] / np.linalg.norm(towards, axis=1)

    def return_signal(self, signals: Signals, excitation: np.ndarray) -> np.ndarray:
        """Return the return signal; ``excitation`` [r, connectors] is contained in ``signals``."""
        if self.returned is not None:
            return signals[self.returned]
        before = {name: signals[name] - excitation[:, index] for index, name in enumerate(self.connectors)}
        return self.injection_for({**signals, **before})


def channels_of(loop: LoopDeclaration, network: Network, step: float) -> list[Channel]:
    """Return the channels of a loop in a network with communication step ``step`` (s). Raises InputError."""
    where = f"loop {loop.name}"
    cut = _connectors(network, loop.cut, where)
    returned: list[str | None] = [*_connectors(network, loop.returned, where)] if loop.returned else []
    unit = network.nodes[cut[0]].unit
    base = Channel(
        name=loop.name,
        loop=loop.name,
        connectors=tuple(cut),
        axis=None,
        returned=None,
        period=_period(loop, network, step, where),
        amplitude=loop.amplitude,
        unit=unit.name if unit else None,
    )
    if loop.direction is not None:
        direction = _vector(network, loop.direction, where)
        rates = _vector(network, loop.direction_rate, where) if loop.direction_rate else []
        if len(cut) != 1:
            raise InputError(
                network.file,
                where,
                f"{loop.cut} is a vector, but a loop with a direction is cut at a scalar",
                "cut the scalar along the direction",
            )
        whole = replace(base, connectors=(*cut, *direction), rates=tuple(rates), ahead=loop.ahead)
        named = [replace(whole, name=f"{loop.name}.{name}", axis=axis) for axis, name in enumerate(AXES)]
    elif len(cut) == 1:
        named = [base]
    else:
        named = [replace(base, name=f"{loop.name}[{index}]", connectors=(name,)) for index, name in enumerate(cut, 1)]
    if not returned:
        return named
    if len(returned) != len(named):
        problem = f"{loop.returned} has {len(returned)} components, but the cut has {len(named)}"
        raise InputError(network.file, where, problem, f"name a signal with {len(named)} components")
    return [replace(channel, returned=source) for channel, source in zip(named, returned, strict=True)]


def _period(loop: LoopDeclaration, network: Network, step: float, where: str) -> int:
    """Return the sample period in communication points."""
    if loop.period is None:
        return 1
    period = round(loop.period / step)
    if period < 1 or abs(period * step - loop.period) > STEP_ROUNDING * loop.period:
        problem = f"period {loop.period:g} s is not a whole number of communication steps of {step:g} s"
        raise InputError(network.file, where, problem, "give a multiple of the step, or a step that divides the period")
    return period


def _vector(network: Network, name: str, where: str) -> list[str]:
    connectors = _connectors(network, name, where)
    if len(connectors) != len(AXES):
        raise InputError(
            network.file, where, f"{name} does not have three components", "name a vector of three components"
        )
    return connectors


def _connectors(network: Network, name: str, where: str) -> list[str]:
    """Return the Real connectors of a name: the connector itself, or all connectors of the vector with this name."""
    connectors = elements(name, network.nodes)
    if not connectors:
        known = [node.name for node in network.nodes.values() if node.component is not None]
        raise InputError(network.file, where, f"no connector {name}", suggestion(name, known))
    for item in connectors:
        node = network.nodes[item]
        if node.component is None or node.kind not in ("output", "input") or node.type_name != "Real":
            problem = f"{item} is not a Real input or output of a component"
            raise InputError(network.file, where, problem, "name a connector as component.connector")
    return connectors
