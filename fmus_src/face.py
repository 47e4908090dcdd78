"""Public names for writing a block, with the modules that define them.

`from perilune import TerminalGuidance` resolves its names here. So does a Python FMU, which does not contain
`perilune`: its files import from this module because a package attribute may be shadowed by its submodule (`block`).
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

HOMES = {
    "actuators.gyro_steering": ("GyroSteering",),
    "actuators.jet_allocation": ("JetAllocation",),
    "block": ("Block",),
    "bundles": ("Bundle", "Inputs", "Outputs"),
    "control.entry_control": ("EntryControl",),
    "control.orbital_control": ("OrbitalControl",),
    "guidance.terminal_guidance": ("TerminalGuidance",),
    "interfaces.allocation": ("Allocation",),
    "interfaces.navigation": ("Navigation",),
    "interfaces.ports.landing": ("TerminalStatus", "ThrustCommand"),
    "external_state": ("ExternalState",),
    "kernel.enumerations": ("Enumeration", "member"),
    "kernel.functions": (
        *("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "exp2", "expm1"),
        *("log", "log2", "log10", "log1p", "pow", "sinh", "cosh", "tanh", "cbrt", "fmod"),
    ),
    "kernel.integrators": ("Forcing", "Translation", "count_steps", "runge_kutta_4", "runge_kutta_nystrom", "simpson"),
    "kernel.matrices": ("Matrix", "block", "identity", "matrix", "zeros"),
    "kernel.records": ("Field", "Record", "replace"),
    "mathlib.vectors": ("Vector", "Vector2", "Vector3", "Vector4", "cross", "dot", "norm", "vector"),
    "navigation.attitude_observer": ("AttitudeObserver",),
    "navigation.filtered_navigation": ("FilteredNavigation",),
    "navigation.inertial_navigation": ("InertialNavigation",),
    "plants.spacecraft": ("Spacecraft", "SpacecraftMotion"),
    "ports": ("Port",),
    "units": ("deg",),
    "variables": ("DeclarationError", "Input", "Output", "Parameter", "State"),
}
HOME_OF = {name: home for home, names in HOMES.items() for name in names}


def __getattr__(name: str) -> Any:
    if name in HOME_OF:
        return getattr(import_module(f".{HOME_OF[name]}", __package__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
