"""Compilation of a system's steps into one function, from the C code inside its FMUs."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from pathlib import Path
from tempfile import gettempdir

import numpy as np

from ....common.errors import InputError
from ....common.machine.os_errors import reason_of, remedy_of
from ....common.paths import CACHE
from ....fmus_src.export.compilers import FLAGS as FMU_FLAGS
from ....fmus_src.export.compilers import FOR_THIS_PROCESSOR, CompilationFailed, CompilerMissing, local_platform
from ....fmus_src.export.libraries import library_files
from ...options.choices import FUSED
from ..instances.instance import PLACED, Instance
from ..loop import arrays
from ..system.fmu import Fmu
from .component_code import ComponentCode, component_code
from .refusals import INSTALL, NO_COMPILER, NO_PLATFORM, has_code
from .unit import ENTRY, SELF_TEST, write_unit

FILE = "fused.c"
# Optimisation for this processor rounds as code for any processor does, and saves a tenth of the time.
FLAGS = (*FMU_FLAGS, FOR_THIS_PROCESSOR)
MOST_CODES = 64  # FMUs in the cache
MOST_INSTRUCTIONS = 20_000  # take about a minute to compile


def is_compilable(program: arrays.Program) -> bool:
    """Return True if the steps of a program can be compiled within about a minute."""
    return int(program.phases[-1] - program.phases[0]) <= MOST_INSTRUCTIONS


def fuse(
    instances: Mapping[str, Instance],
    program: arrays.Program,
    recorded: Iterable[int],
    is_needed: Callable[[], bool] = lambda: True,
) -> int:
    """Return the address of a function that executes the steps of ``program`` and records these slots.

    The function contains the C code of the native FMUs among ``instances``; other FMUs are called through FMI. The
    library is cached by its content. Compilation is cancelled once ``is_needed`` returns False. Raises InputError if
    there is no compiler, if it fails or changes results, if no library can be written, if the C code of an FMU is from
    another build, or if the steps repeat only after too many communication steps.
    """
    components = _component_codes(instances)
    if not is_compilable(program):
        problem = (
            f"the sequence of steps repeats only after {len(program.phases) - 1} communication steps, too many "
            "for one function"
        )
        raise InputError("`flavour`", FUSED, problem, "give `flavour` native")
    library = _load(_compile(write_unit(program, recorded, components), is_needed))
    _check_arithmetic(library)
    for number, instance in enumerate(instances.values()):
        if number in components:
            _check_layout(library, components[number], instance)
    return ctypes.cast(getattr(library, ENTRY), ctypes.c_void_p).value or 0


def _component_codes(instances: Mapping[str, Instance]) -> dict[int, ComponentCode]:
    """Return the code of components by number; components with the same FMU share it."""
    prefixes: dict[str, str] = {}
    components = {}
    for number, instance in enumerate(instances.values()):
        fmu = instance.fmu
        if has_code(fmu):
            prefix = prefixes.setdefault(fmu.digest, f"k{len(prefixes)}_")
            components[number] = _CODES(fmu.digest, prefix, fmu)
    return components


class _Codes:
    """Cache of the code of FMUs, by SHA-256 and prefix; each takes some milliseconds."""

    def __init__(self) -> None:
        self._known: dict[tuple[str, str], ComponentCode] = {}

    def __call__(self, digest: str, prefix: str, fmu: Fmu) -> ComponentCode:
        if (digest, prefix) not in self._known:
            if len(self._known) >= MOST_CODES:
                self._known.clear()
            model = fmu.description.coSimulation.modelIdentifier
            self._known[digest, prefix] = component_code(fmu.read_sources(), model, prefix, fmu.label)
        return self._known[digest, prefix]


_CODES = _Codes()


def _compile(text: str, is_needed: Callable[[], bool]) -> Path:
    platform, cached = local_platform(), CACHE / "fused"
    try:
        if platform is None:
            raise InputError("`flavour`", FUSED, NO_PLATFORM, "leave `flavour` out")
        (file,) = library_files({FILE: text.encode()}, FILE, platform, cached, flags=FLAGS, is_needed=is_needed)
    except CompilerMissing as error:
        raise InputError("`flavour`", FUSED, NO_COMPILER, INSTALL) from error
    except CompilationFailed as error:
        lines = str(error).splitlines()
        problem = (
            "the compiler rejects the C code of the steps: "
            f"{next((line for line in lines if 'error' in line), lines[0])}"
        )
        raise InputError("`flavour`", FUSED, problem, "give `flavour` native") from error
    except OSError as error:
        problem = f"the library cannot be written: {error.filename or gettempdir()}: {reason_of(error)}"
        raise InputError("`flavour`", FUSED, problem, f"{remedy_of(error)}, or give `flavour` native") from error
    return file


@cache
def _load(file: Path) -> ctypes.CDLL:
    try:
        return ctypes.CDLL(str(file))
    except OSError as error:
        problem = f"the compiler's output is not a library: {error}"
        raise InputError("`flavour`", FUSED, problem, "repair the compiler, or give `flavour` native") from error


def _check_arithmetic(library: ctypes.CDLL) -> None:
    """Reject a compiler that changes results, as FMUs do for their C code."""
    check = getattr(library, SELF_TEST)
    check.restype = ctypes.c_char_p
    problem = check()
    if problem is not None:
        raise InputError("`flavour`", FUSED, problem.decode(), "give `flavour` native")


def _check_layout(library: ctypes.CDLL, code: ComponentCode, instance: Instance) -> None:
    """Reject C code with another memory layout than the FMU's binary, since it belongs to another program."""
    offset_of = getattr(library, f"{code.prefix}offset_of")
    offset_of.restype, offset_of.argtypes = ctypes.c_uint32, [ctypes.c_uint32]
    for variable in instance.fmu.variables.values():
        if variable.type not in PLACED:
            continue
        references = np.array([variable.reference], dtype=np.uint32)
        if instance.locate(references, variable.type) != instance.address + offset_of(variable.reference):
            problem = f"the address of {variable.name} in its C code differs from its binary"
            raise InputError(instance.fmu.label, "sources", problem, "export the FMU again, or give `flavour` native")
