"""Native FMUs of FMI 3.0, compiled once for this machine."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from perilune.common.paths import CACHE
from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.native_fmu import build_native_fmu
from tests.support.lengths import either

# Vectors, matrices, records, random numbers, enumerations, Integers, Booleans, sampling and bundles between them.
REPRESENTATIVE = (
    "command_switch",
    "free_flying_robot",
    "inertial_sensor",
    "jet_allocation_least_propellant",
    "jet_health",
    "kalman_navigation",
    "landing_sequencer",
    "orbital_filter",
    "output_feedback",
    "quaternion_feedback",
    "slew_quintic",
    "terrain_camera",
    "thrust_allocation",
)
NATIVE = [name for name, block in catalogue().items() if not block.python_only]
COMPILED = either(NATIVE, [name for name in NATIVE if name in REPRESENTATIVE])


@cache
def fmi3_fmu(block: type[Block]) -> Path:
    """Build the FMI 3.0 FMU of a block."""
    platform = local_platform(3)
    assert platform is not None
    path = CACHE / "fmi3" / f"{block.fmu_name}.fmu"
    return build_native_fmu(block, path, platforms=[platform], cache=CACHE, fmi=3)
