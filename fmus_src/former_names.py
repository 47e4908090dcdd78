"""Module names of the last release, still accepted with a warning that reports the new name.

The package `perilune` imports them by `FormerNames`; a Python FMU contains a module of two lines for each.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Mapping, Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType

PACKAGE = __name__.rpartition(".")[0]
FOLDERS: Mapping[str, Mapping[str, tuple[str, ...]]] = {  # former folder: new folders and their modules
    "mathlib": {
        "kernel": ("matrices",),
        "mathlib.actuators": ("gyros", "jets", "lagged_thrust", "pulses"),
        "mathlib.attitude": ("pursuit", "quaternion", "rotation", "thrust_axis"),
        "mathlib.entry": ("newtonian_cap", "standard_atmosphere"),
        "mathlib.estimation": ("inertial", "kalman", "tracking"),
        "mathlib.hover": ("transfer_polynomial",),
        "mathlib.lunar": ("gravity", "landing_site", "terminal"),
        "mathlib.orbits": ("deorbit",),
    },
    "interfaces": {
        "actuators": ("gyro_steering", "jet_allocation"),
        "control": ("entry_control", "orbital_control"),
        "guidance": ("network_operator_law", "terminal_guidance"),
        "models": ("orbital_body",),
        "navigation": ("attitude_observer", "filtered_navigation", "full_attitude_observer", "inertial_navigation"),
        "plants": ("moon_lander",),
    },
}
RENAMED = {
    "mathlib.orbital": "mathlib.orbits.attitude",
    "mathlib.entry_motion": "mathlib.entry.motion",
    **{
        f"mathlib.hover_{name}": f"mathlib.hover.{name}"
        for name in ("motion", "path", "programme", "shape", "solution")
    },
}
FORMER = {
    f"{old}.{name}": f"{new}.{name}"
    for old, folders in FOLDERS.items()
    for new, names in folders.items()
    for name in names
} | RENAMED  # dotted names below the package


def stand_in(module: str) -> str:
    """Return the source of a module with a former name, which imports the module of the present name."""
    folder, _, name = FORMER[module].rpartition(".")
    return f"import sys\nfrom {PACKAGE}.{folder} import {name}\nsys.modules[__name__] = {name}\n"


class FormerNames(MetaPathFinder):
    """Finder of modules under their former names."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        package, _, module = fullname.partition(f"{PACKAGE}.")
        return ModuleSpec(fullname, _Former()) if not package and module in FORMER else None


class _Former(Loader):
    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        return None

    def exec_module(self, module: ModuleType) -> None:
        old = module.__name__
        new = f"{PACKAGE}.{FORMER[old.removeprefix(f'{PACKAGE}.')]}"
        warnings.warn(f"{old} is accepted in this release only: import {new}", stacklevel=2)
        sys.modules[old] = import_module(new)
