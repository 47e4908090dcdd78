"""Loop without a return signal: the component at which it ends, and whether a disturbance still grows."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from ...runtime.system.network import Network
from ...runtime.system.prepared import PreparedSystem
from ...runtime.system.schedule import origin
from ..loops.growth import WINDOWS, growth_to_overflow, steady_growth
from ..request.channels import Channel
from .bench import Bench, OverflowedError, StudyError

PERIODS = 4  # hyperperiods within which a component's outputs must respond
SMALL = 1e-6  # fraction of a signal's magnitude, as in the linearisation
NUMBERS = ("Real", "Integer", "Boolean", "Enumeration")  # types of outputs that can respond
ROUNDING = 1e-12  # fraction of an output's magnitude, below which a change is rounding


@dataclass(frozen=True)
class SilentEnd:
    """End of a signal path at the first ``component`` whose outputs do not respond; None if unknown.

    ``growth`` is the factor per sample by which an output departs from the undisturbed simulation, or None.
    """

    component: str | None
    growth: float | None

    @property
    def reason(self) -> str:
        """End of the loop as text."""
        if self.component is None:
            return "no signal returns"
        return f"no signal returns downstream of {self.component}"


def find_silent_end(
    prepared: PreparedSystem, bench: Bench, channel: Channel, peak: float, wave: np.ndarray, measured: bool
) -> SilentEnd:
    """Return the end of a silent loop, from simulations that record all outputs after the cut.

    ``wave`` [samples] with its peak ``peak`` is added for some periods to find growing outputs. If the loop was
    ``measured``, the same simulation shows which components respond; otherwise a simulation with a disturbance as small
    as in the linearisation does.
    """
    path = _path(prepared.network, channel)
    names = [name for group in path.outputs.values() for name in group]
    ear = Bench(prepared, bench.point, [channel], recorded=names)
    try:
        grown, responses = _disturb(ear, channel, np.tile(wave, 2 * WINDOWS), names)
        if not measured:
            length = PERIODS * ear.period // channel.period
            size = SMALL * (peak or 1.0)
            _, responses = _disturb(ear, channel, np.full(max(length, 1), size), names)
    finally:
        ear.close()
    return SilentEnd(None if responses is None else path.find_first_silent(responses), grown)


def _disturb(
    bench: Bench, channel: Channel, samples: np.ndarray, names: list[str]
) -> tuple[float | None, dict[str, bool] | None]:
    """Return the growth factor per sample relative to the undisturbed simulation, and whether each output responds."""
    added = np.repeat(samples, channel.period)
    last = bench.origin + added.size
    with suppress(StudyError):
        base = bench.fly(-1, last)
        here = {name: signal[bench.origin + 1 :] for name, signal in base.items()}
        excitation = np.zeros((added.size, len(bench.connectors)))
        excitation[:, bench.columns(channel)] = channel.excitation(here, added)
        injected = dict(zip(channel.connectors, channel.excitation(here, added).T, strict=True))
        overflowed = False
        try:
            disturbed = bench.fly(-1, last, excitation)
        except OverflowedError as error:
            disturbed, overflowed = error.signals, True
        rates: list[float | None] = []
        responses: dict[str, bool] = {}
        for name in names:
            signal = disturbed[name]
            deviation = (signal - base[name][: len(signal)])[bench.origin + 1 :]
            if name in injected:  # the excitation itself is not a response
                deviation = deviation - injected[name][: len(deviation)]
            deviation = deviation[:: channel.period]
            size = float(np.max(abs(base[name]), initial=0.0))
            responses[name] = bool(np.max(abs(deviation), initial=0.0) > ROUNDING * size)
            rates.append(
                growth_to_overflow(deviation) if overflowed else steady_growth(deviation[len(deviation) // 2 :])
            )
        return max((rate for rate in rates if rate is not None), default=None), responses
    return None, None


@dataclass(frozen=True)
class _Path:
    """Components from a cut to its return signal.

    ``first`` are the components that read the cut, ``readers`` are the components that read each output, and
    ``outputs`` are the outputs of all components on the path, by component.
    """

    first: set[str]
    readers: Mapping[str, set[str]]
    outputs: Mapping[str, list[str]]

    def find_first_silent(self, responses: Mapping[str, bool]) -> str | None:
        """Return the nearest component to the cut that the response reaches but that does not respond, or None."""
        queue, known = sorted(self.first & self.outputs.keys()), set[str]()
        while queue:
            component = queue.pop(0)
            known.add(component)
            responding = [name for name in self.outputs[component] if responses.get(name, False)]
            if not responding:
                return component
            reached = {reader for name in responding for reader in self.readers.get(name, ())}
            queue += sorted((reached & self.outputs.keys()) - known - set(queue))
        return None


def _path(network: Network, channel: Channel) -> _Path:
    """Return the path from a channel's cut to its return signal."""
    readers: dict[str, set[str]] = {}
    sources: dict[str, str | None] = {}
    for link in network.links():
        if link.target.component is not None and not link.is_parameter:
            source = origin(network, link)
            readers.setdefault(source.name, set()).add(link.target.component)
            sources[link.target.name] = source.component
    outputs: dict[str, list[str]] = {}
    for node in network.nodes.values():
        if node.component is not None and node.kind == "output" and node.type_name in NUMBERS:
            outputs.setdefault(node.component, []).append(node.name)
    first: set[str] = set()
    for connector in channel.connectors:  # an output, or an input, which its own component reads
        first |= readers.get(connector) or {connector.partition(".")[0]}
    back = channel.returned or channel.connectors[0]
    end = sources.get(back, back.partition(".")[0])
    drives = {
        name: {reader for output in group for reader in readers.get(output, ())} for name, group in outputs.items()
    }
    leading = {end}
    while more := {name for name, reached in drives.items() if reached & leading} - leading:
        leading |= more
    return _Path(first, readers, {name: group for name, group in outputs.items() if name in leading})
