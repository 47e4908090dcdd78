"""What a flight depends on, as plain values."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.metadata import version
from typing import Any

from ..system.assignments import Settings
from ..system.fault import Fault
from ..system.prepared import PreparedSystem
from .parameters import Parameters


def provenance_of(
    prepared: PreparedSystem, settings: Settings, parameters: Parameters, faults: Sequence[Fault | None]
) -> dict[str, Any]:
    """Parameter values, hashes, options and version."""
    return {
        "system": prepared.archive.name,
        "system_sha256": prepared.archive.digest,
        "fmus": {
            name: {"fmu": fmu.name, "sha256": fmu.digest, "guid": fmu.description.guid}
            for name, fmu in prepared.network.fmus.items()
        },
        "parameters": {
            f"{component}.{variable}": parameters[component, variable] for component, variable in settings.variables
        },
        "start_time": prepared.start,
        "step": prepared.step,
        "stop_time": prepared.start + prepared.steps * prepared.step,
        "variant": prepared.options.variant,
        "feedthrough": list(prepared.options.feedthrough),
        "no_feedthrough": list(prepared.options.no_feedthrough),
        "assumptions": prepared.assumptions,
        "faults": [str(fault) for fault in faults if fault is not None],
        "algorithm": prepared.algorithm,
        **(prepared.drive.facts() if prepared.drive is not None else {}),
        "perilune": version("perilune"),
    }
