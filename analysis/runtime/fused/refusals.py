"""Requirements on systems with steps to be compiled, checked before any simulation."""

from __future__ import annotations

from ....common.errors import InputError
from ....fmus_src.export.compilers import CompilerMissing, available_platforms, compilers_for, local_platform
from ...options.choices import FUSED
from ..system.fmu import Fmu
from ..system.prepared import PreparedSystem

NO_COMPILER = "needs a C compiler, and none is installed"
NO_PLATFORM = "FMI 2.0 does not define this platform, so steps cannot be compiled here"
INSTALL = "install cc, or pip install ziglang; or give `flavour` native"


def has_code(fmu: Fmu) -> bool:
    """Return True if the C code of an FMU can be compiled into the steps."""
    return fmu.is_own and fmu.is_native and fmu.version == 2


def can_fuse(prepared: PreparedSystem) -> bool:
    """Return True if all FMUs contain their C code, and a compiler is available."""
    return all(map(has_code, prepared.network.fmus.values())) and local_platform() in available_platforms()


def check_fused(prepared: PreparedSystem, *, in_child: bool = False) -> None:
    """Reject the flavour `FUSED` for a system with steps that could not be compiled. Raises InputError.

    ``in_child`` is True if the system is simulated in child processes.
    """
    if prepared.options.chosen["flavour"] != FUSED:
        return
    if in_child:
        problem = "the system is simulated in child processes, where steps are not compiled"
        trust = "" if prepared.is_self_contained else "; or give `in_process` if you trust its FMUs"
        raise InputError("`flavour`", FUSED, problem, f"leave `flavour` out{trust}")
    if prepared.has_fmi3:
        raise InputError(
            "`flavour`", FUSED, "the system has FMI 3.0 FMUs, which cannot be fused", "give `flavour` native"
        )
    if not any(map(has_code, prepared.network.fmus.values())):
        problem = "the system has no native FMU of Perilune that could be fused"
        raise InputError("`flavour`", FUSED, problem, "leave `flavour` out")
    platform = local_platform()
    if platform is None:
        raise InputError("`flavour`", FUSED, NO_PLATFORM, "leave `flavour` out")
    try:
        compilers_for(platform)
    except CompilerMissing as error:
        raise InputError("`flavour`", FUSED, NO_COMPILER, INSTALL) from error
