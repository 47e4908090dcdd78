"""Perilune: FMI components, systems and analyses for spacecraft guidance, navigation and control.

The importable face: everything here is defined elsewhere and documented there. Names are looked up when they are first
asked for, so that building an FMU does not load what flies it.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .fmus_src.face import HOME_OF

if TYPE_CHECKING:
    from . import modal
    from .analysis.api.batch import BatchResult, batch, merge, shard
    from .analysis.api.comparison import Comparison, compare
    from .analysis.api.export import Exported, export
    from .analysis.api.laws import Law, law, synthesize
    from .analysis.api.own import new_block, new_system
    from .analysis.api.plans import HoverPlan, LandingBound, plan_hover_transfer, plan_landing_bound
    from .analysis.api.results.plots import plot_results
    from .analysis.api.results.replayed import ReplayResult, replay
    from .analysis.api.results.stored import StoredResults, open_results
    from .analysis.api.samples.rare import RareResult, rare
    from .analysis.api.samples.sensitivity import SensitivityResult, sensitivity
    from .analysis.api.samples.worst import WorstResult, worst
    from .analysis.api.stability import StabilityReport, stability
    from .analysis.api.timing import benchmark
    from .analysis.common.errors import InputError
    from .analysis.design.synthesis.outcome import SynthesisResult
    from .analysis.design.trajectories.bounds import Landing
    from .analysis.design.trajectories.path import PlanError
    from .analysis.design.trajectories.vehicle import Margins, Transfer, Vehicle
    from .analysis.runtime.system.fault import Fault
    from .analysis.stability.injection.bench import StudyError
    from .analysis.verbs.describe import describe
    from .analysis.verbs.inventory import inventory
    from .analysis.verbs.run import Result, simulate
    from .analysis.verbs.validate import validate
    from .fmus_src.block import Block, DeclarationError, Input, Output, Parameter, State
    from .fmus_src.interfaces.allocation import Allocation
    from .fmus_src.interfaces.attitude_observer import AttitudeObserver
    from .fmus_src.interfaces.entry_control import EntryControl
    from .fmus_src.interfaces.filtered_navigation import FilteredNavigation
    from .fmus_src.interfaces.gyro_steering import GyroSteering
    from .fmus_src.interfaces.inertial_navigation import InertialNavigation
    from .fmus_src.interfaces.jet_allocation import JetAllocation
    from .fmus_src.interfaces.navigation import Navigation
    from .fmus_src.interfaces.orbital_control import OrbitalControl
    from .fmus_src.interfaces.terminal_guidance import (
        CLAMPED,
        GOOD,
        NO_SOLUTION,
        NOT_CONVERGED,
        TerminalGuidance,
    )
    from .fmus_src.mathlib.vectors import Vector, Vector2, Vector3, Vector4, cross, dot, norm, vector

__all__ = [
    "CLAMPED",
    "GOOD",
    "NOT_CONVERGED",
    "NO_SOLUTION",
    "Allocation",
    "AttitudeObserver",
    "BatchResult",
    "Block",
    "Comparison",
    "DeclarationError",
    "EntryControl",
    "Exported",
    "Fault",
    "FilteredNavigation",
    "GyroSteering",
    "HoverPlan",
    "InertialNavigation",
    "Input",
    "InputError",
    "JetAllocation",
    "Landing",
    "LandingBound",
    "Law",
    "Margins",
    "Navigation",
    "OrbitalControl",
    "Output",
    "Parameter",
    "PlanError",
    "RareResult",
    "ReplayResult",
    "Result",
    "SensitivityResult",
    "StabilityReport",
    "State",
    "StoredResults",
    "StudyError",
    "SynthesisResult",
    "TerminalGuidance",
    "Transfer",
    "Vector",
    "Vector2",
    "Vector3",
    "Vector4",
    "Vehicle",
    "WorstResult",
    "batch",
    "benchmark",
    "compare",
    "cross",
    "describe",
    "dot",
    "export",
    "inventory",
    "law",
    "merge",
    "modal",
    "new_block",
    "new_system",
    "norm",
    "open_results",
    "plan_hover_transfer",
    "plan_landing_bound",
    "plot_results",
    "rare",
    "replay",
    "sensitivity",
    "shard",
    "simulate",
    "stability",
    "synthesize",
    "validate",
    "vector",
    "worst",
]

_HOMES = {
    "analysis.api.batch": ("BatchResult", "batch", "merge", "shard"),
    "analysis.api.comparison": ("Comparison", "compare"),
    "analysis.verbs.describe": ("describe",),
    "analysis.api.export": ("Exported", "export"),
    "analysis.verbs.run": ("Result", "simulate"),
    "analysis.verbs.inventory": ("inventory",),
    "analysis.api.laws": ("Law", "law", "synthesize"),
    "analysis.api.own": ("new_block", "new_system"),
    "analysis.api.plans": ("HoverPlan", "LandingBound", "plan_hover_transfer", "plan_landing_bound"),
    "analysis.api.results.plots": ("plot_results",),
    "analysis.api.results.replayed": ("ReplayResult", "replay"),
    "analysis.api.results.stored": ("StoredResults", "open_results"),
    "analysis.api.samples.rare": ("RareResult", "rare"),
    "analysis.api.samples.sensitivity": ("SensitivityResult", "sensitivity"),
    "analysis.api.samples.worst": ("WorstResult", "worst"),
    "analysis.api.stability": ("StabilityReport", "stability"),
    "analysis.api.timing": ("benchmark",),
    "analysis.verbs.validate": ("validate",),
    "analysis.common.errors": ("InputError",),
    "analysis.design.trajectories.bounds": ("Landing",),
    "analysis.design.trajectories.path": ("PlanError",),
    "analysis.design.trajectories.vehicle": ("Margins", "Transfer", "Vehicle"),
    "analysis.stability.injection.bench": ("StudyError",),
    "analysis.design.synthesis.outcome": ("SynthesisResult",),
    "analysis.runtime.system.fault": ("Fault",),
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
    if name in HOME_OF:
        return getattr(import_module(f".fmus_src.{HOME_OF[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
