"""What a component's status means, in the words of its FMU."""

from __future__ import annotations

import re

from .names import parted
from .network import Network

STATUS = "status"  # output of components that say how they fare, 0 for good
MEANING = re.compile(r"(?:^|[,:] )(-?\d+):? (.+?)(?=, -?\d+:? |$)")  # "0 good, 1 clamped, 2 ..."


def status_meaning(network: Network, name: str, value: int) -> str:
    """What ``value`` of the connector ``component.status`` means, as its description lists it; else nothing."""
    component, variable = parted(name, network.fmus)
    fmu = network.fmus.get(component)
    declared = fmu.variables.get(variable) if fmu is not None else None
    description = (declared.description or "") if declared is not None else ""
    meanings = {int(number): words for number, words in MEANING.findall(" ".join(description.split()))}
    return meanings.get(value, "").rstrip(".")


def with_meaning(network: Network, name: str, value: int) -> str:
    """``guidance.status 3, no solution``."""
    words = status_meaning(network, name, value)
    return f"{name} {value}, {words}" if words else f"{name} {value}"
