"""How the components of a flight fared, by their statuses."""

from __future__ import annotations

import re

import numpy as np

from ...common.percent import short_percent
from ..system.names import split_name
from ..system.network import Network
from .results import Flight

STATUS = "status"  # output of components that say how they fare, 0 for good
MEANING = re.compile(r"(?:^|[,:] )(-?\d+):? (.+?)(?=, -?\d+:? |$)")  # "0 good, 1 clamped, 2 ..."


def status_lines(network: Network, flight: Flight) -> list[str]:
    """A line for every component that reported a status other than 0: the worst, for how long, and the last."""
    lines = []
    for name, values in flight.signals.items():
        component, variable = split_name(name, network.fmus)
        if variable != STATUS or not component or flight.types[name] != "Integer" or not values.any():
            continue
        worst, last = int(np.max(values)), int(values[-1])
        first = float(flight.time[np.argmax(values == worst)])
        fraction = np.count_nonzero(values == worst) / values.size
        meaning = status_meaning(network, name, worst)
        value = f"{worst} ({meaning})" if meaning else f"{worst}"
        words = f"{name}: {value} from t = {first:g} s, {_percent(fraction)} of the samples"
        lines.append(words if last == worst else f"{words}, {last} at the end")
    return lines


def _percent(share: float) -> str:
    return "all" if share == 1.0 else f"{short_percent(share)} %"


def status_meaning(network: Network, name: str, value: int) -> str:
    """What ``value`` of the connector ``component.status`` means, as its description lists it; else nothing."""
    component, variable = split_name(name, network.fmus)
    fmu = network.fmus.get(component)
    declared = fmu.variables.get(variable) if fmu is not None else None
    description = (declared.description or "") if declared is not None else ""
    meanings = {int(number): words for number, words in MEANING.findall(" ".join(description.split()))}
    return meanings.get(value, "").rstrip(".")


def with_meaning(network: Network, name: str, value: int) -> str:
    """``guidance.status 3, no solution``."""
    words = status_meaning(network, name, value)
    return f"{name} {value}, {words}" if words else f"{name} {value}"
