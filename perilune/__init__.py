"""Perilune: FMI components, systems and analyses for spacecraft guidance, navigation and control.

The importable face: everything here is defined elsewhere and documented there. Names are looked up when they are first
asked for, so that building an FMU does not load what flies it.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from . import modal
    from .analysis.api import batch, simulate, stability
    from .analysis.batch.results import BatchResult
    from .analysis.errors import InputError
    from .analysis.flight.results import Result
    from .analysis.stability.bench.bench import StudyError
    from .analysis.stability.results.report import StabilityReport
    from .analysis.system.faults import Fault
    from .fmus_src.block import Block, Input, Output, Parameter, State

__all__ = [
    "BatchResult",
    "Block",
    "Fault",
    "Input",
    "InputError",
    "Output",
    "Parameter",
    "Result",
    "StabilityReport",
    "State",
    "StudyError",
    "batch",
    "modal",
    "simulate",
    "stability",
]

_HOMES = {
    "analysis.api": ("batch", "simulate", "stability"),
    "analysis.batch.results": ("BatchResult",),
    "analysis.errors": ("InputError",),
    "analysis.flight.results": ("Result",),
    "analysis.stability.bench.bench": ("StudyError",),
    "analysis.stability.results.report": ("StabilityReport",),
    "analysis.system.faults": ("Fault",),
    "fmus_src.block": ("Block", "Input", "Output", "Parameter", "State"),
}

if not (Path(__file__).parent / "analysis").is_dir():
    raise ImportError(
        f"{Path(__file__).parent / 'analysis'} is a file where a link is meant: this checkout has no symbolic links; "
        "run `git config core.symlinks true` and `git checkout -- perilune`, or pip install a wheel"
    )


def __getattr__(name: str) -> Any:
    if name == "modal":
        return import_module(".modal", __name__)
    for module, names in _HOMES.items():
        if name in names:
            return getattr(import_module(f".{module}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
