"""The compiled steps of a system: the C is that inside its FMUs, and fits their binaries."""

from __future__ import annotations

import ctypes
from collections.abc import Iterable, Mapping
from functools import cache, lru_cache
from pathlib import Path

import numpy as np

from ....fmus_src.export.compilers import FLAGS as FMU_FLAGS
from ....fmus_src.export.compilers import (
    FOR_THIS_PROCESSOR,
    CompilationFailed,
    CompilerMissing,
    available_platforms,
    library_files,
    local_platform,
)
from ....fmus_src.paths import CACHE
from ...common.errors import InputError
from ..flight.compiled import arrays
from ..flight.compiled.frame import REALS, WORDS
from ..instances.instance import PLACED, Instance
from ..system.fmu import Fmu
from ..system.prepared import PreparedSystem
from .component_code import ComponentCode, component_code
from .unit import ENTRY, SELF_TEST, write_unit

FILE = "fused.c"
# This processor's instructions round as those of all others do, and take a tenth less time.
FLAGS = (*FMU_FLAGS, FOR_THIS_PROCESSOR)
MOST_CODES = 64  # of FMUs, that are kept
MOST_INSTRUCTIONS = 20_000  # a minute of compilation


def can_fuse(prepared: PreparedSystem, program: arrays.Program) -> bool:
    """Whether the FMUs are all ours, native and of FMI 2.0, the steps compile in a minute, and a compiler is here."""
    ours = all(fmu.is_own and fmu.is_native and fmu.version == 2 for fmu in prepared.network.fmus.values())
    return ours and _instructions_in(program) <= MOST_INSTRUCTIONS and local_platform() in available_platforms()


def _instructions_in(program: arrays.Program) -> int:
    return int(program.phases[-1] - program.phases[0])


def fuse(instances: Mapping[str, Instance], program: arrays.Program, recorded: Iterable[int]) -> arrays.Fused:
    """The steps of a ``program`` of which these slots are recorded, as a function of a library.

    The C is that inside the native FMUs of the ``instances``; other FMUs are called as ever. The library is kept in
    the cache folder by its content. Raises InputError where there is no compiler, or one that changes results, and for
    FMUs whose C is of another build, or whose periods come round together too late.
    """
    components = _component_codes(instances)
    if not components:
        problem = "the system has no native FMU of Perilune, whose C could be fused"
        raise InputError("`flavour`", "fused", problem, "leave `flavour` out")
    if _instructions_in(program) > MOST_INSTRUCTIONS:
        problem = (
            f"the steps repeat after {len(program.phases) - 1} communication steps only, too many to be one function"
        )
        raise InputError("`flavour`", "fused", problem, "fly it `native`")
    library = _load(_compile(write_unit(program, recorded, components)))
    _check_arithmetic(library)
    for number, instance in enumerate(instances.values()):
        if number in components:
            _check_layout(library, components[number], instance)
    address = ctypes.cast(getattr(library, ENTRY), ctypes.c_void_p).value or 0
    return arrays.Fused(address, np.zeros(len(WORDS), dtype=np.int64), np.zeros(len(REALS)))


def _component_codes(instances: Mapping[str, Instance]) -> dict[int, ComponentCode]:
    """The code of components by their number; once of an FMU that several have."""
    prefixes: dict[str, str] = {}
    components = {}
    for number, instance in enumerate(instances.values()):
        fmu = instance.fmu
        if fmu.is_own and fmu.is_native and fmu.version == 2:
            prefix = prefixes.setdefault(fmu.digest, f"k{len(prefixes)}_")
            components[number] = _CODES(fmu.digest, prefix, fmu)
    return components


class _Codes:
    """The code of FMUs, which takes some milliseconds for each, by what they contain."""

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


@lru_cache(maxsize=MOST_CODES)
def _compile(text: str) -> Path:
    platform = local_platform()
    try:
        if platform is None:
            raise CompilerMissing("no platform of FMI 2.0")
        (file,) = library_files({FILE: text.encode()}, FILE, platform, CACHE / "fused", flags=FLAGS)
    except CompilerMissing as error:
        remedy = "install cc, or pip install ziglang; or fly it `native`"
        raise InputError("`flavour`", "fused", "needs a C compiler, and there is none", remedy) from error
    except CompilationFailed as error:
        lines = str(error).splitlines()
        problem = f"the compiler refuses its C: {next((line for line in lines if 'error' in line), lines[0])}"
        raise InputError("`flavour`", "fused", problem, "fly it `native`") from error
    return file


@cache
def _load(file: Path) -> ctypes.CDLL:
    return ctypes.CDLL(str(file))


def _check_arithmetic(library: ctypes.CDLL) -> None:
    """Refuse a compiler that changes results, as the FMUs do with their own code."""
    check = getattr(library, SELF_TEST)
    check.restype = ctypes.c_char_p
    problem = check()
    if problem is not None:
        raise InputError("`flavour`", "fused", problem.decode(), "fly it `native`")


def _check_layout(library: ctypes.CDLL, code: ComponentCode, instance: Instance) -> None:
    """Refuse C that lays out an instance otherwise than the FMU's binary: it is of another program."""
    offset_of = getattr(library, f"{code.prefix}offset_of")
    offset_of.restype, offset_of.argtypes = ctypes.c_uint32, [ctypes.c_uint32]
    for variable in instance.fmu.variables.values():
        if variable.type not in PLACED:
            continue
        references = np.array([variable.reference], dtype=np.uint32)
        if instance.locate(references, variable.type) != instance.address + offset_of(variable.reference):
            problem = f"its C has {variable.name} at another address than its binary"
            raise InputError(instance.fmu.label, "sources", problem, "export it again, or fly it `native`")
