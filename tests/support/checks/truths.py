"""All truths: kind of block and function that computes the check, by FMU name."""

from collections.abc import Callable

from tests.support.checks import (
    actuators,
    control,
    disturbances,
    environment,
    guidance,
    navigation,
    plants,
    sensors,
    sequencing,
)
from tests.support.checks.check import Check

MODULES = {
    "plants": plants,
    "environment": environment,
    "navigation": navigation,
    "guidance": guidance,
    "control": control,
    "disturbances": disturbances,
    "sensors": sensors,
    "sequencing": sequencing,
    "actuators": actuators,
}
TRUTHS: dict[str, tuple[str, Callable[[], Check]]] = {
    name: (kind, truth) for kind, module in MODULES.items() for name, truth in module.TRUTHS.items()
}
