"""Library of a native FMU driven through ctypes, with the interface of perilune.fmus_src.runtime.BlockInstance."""

from __future__ import annotations

import ctypes
import tempfile
import zipfile
from ctypes import byref, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p
from functools import cache
from pathlib import Path

from lxml import etree

from perilune.common.paths import BUILD, shipped_fmu
from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import PLATFORMS, local_platform
from perilune.fmus_src.export.libraries import build_library
from perilune.fmus_src.export.native_fmu import native_sources
from tests.support.built import native_are_current

CACHE = BUILD / "cache"
GUID = "{00000000-0000-0000-0000-000000000000}"
OK, ERROR = 0, 3
BUFFERS = {"Real": c_double, "Integer": c_int, "Boolean": c_int}

LOGGER = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p, c_char_p)


class Callbacks(ctypes.Structure):
    """fmi2CallbackFunctions."""

    _fields_ = [
        ("logger", LOGGER),
        ("allocate", c_void_p),
        ("free", c_void_p),
        ("finished", c_void_p),
        ("environment", c_void_p),
    ]


def load(sources: dict[str, bytes], main: str, portable: bool = False) -> ctypes.CDLL:
    """Load the library of a C file, compiled through the build cache, from a separate copy."""
    platform = local_platform()
    assert platform is not None
    text = build_library(sources, main, platform, CACHE, portable=portable)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        file = Path(folder) / f"library{PLATFORMS[platform].extension}"
        file.write_bytes(text)
        return opened(file)


def opened(file: Path) -> ctypes.CDLL:
    """Load the library of an FMU."""
    dll = ctypes.CDLL(str(file))
    if hasattr(dll, "fmi2Instantiate"):
        dll.fmi2Instantiate.restype = c_void_p
    return dll


@cache
def library(block_class: type[Block], guid: str = GUID) -> ctypes.CDLL:
    """Return the loaded library of a block."""
    return load(native_sources(block_class, guid), f"{block_class.fmu_name}.c")


@cache
def built(block_class: type[Block]) -> tuple[ctypes.CDLL, str] | None:
    """Return the library of a block's native FMU and its GUID; None where none is built from these sources."""
    name, platform = block_class.fmu_name, local_platform()
    if platform is None or catalogue().get(name) is not block_class or not native_are_current([name]):
        return None
    with zipfile.ZipFile(shipped_fmu(name, "native")) as archive, tempfile.TemporaryDirectory() as folder:
        file = Path(archive.extract(f"binaries/{platform}/{name}{PLATFORMS[platform].extension}", folder))
        guid = etree.fromstring(archive.read("modelDescription.xml")).get("guid", "")
        return opened(file), guid


class NativeInstance:
    """One instance, by default of the built FMU, else of a library compiled here; errors leave messages in ``log``."""

    def __init__(
        self, block_class: type[Block], guid: str = GUID, name: str = "instance", dll: ctypes.CDLL | None = None
    ) -> None:
        self.log: list[str] = []
        if dll is None:
            dll, guid = built(block_class) or (library(block_class), guid)
        self.dll = dll
        self.logger = LOGGER(lambda *arguments: self.log.append(arguments[5].decode()))
        self.callbacks = Callbacks(self.logger)
        self.handle = c_void_p(
            self.dll.fmi2Instantiate(name.encode(), 1, guid.encode(), None, byref(self.callbacks), 0, 0)
        )
        self.kinds: list[str] = []
        for variable in block_class.variables.values():
            self.kinds += [variable.type_name] * variable.size

    def call(self, function: str, *arguments: object) -> int:
        """Return the status of an FMI function."""
        return getattr(self.dll, function)(self.handle, *arguments)

    def _split(self, references: list[int]) -> dict[str, list[int]]:
        collected: dict[str, list[int]] = {}
        for reference in references:
            collected.setdefault(self.kinds[reference], []).append(reference)
        return collected

    def get(self, references: list[int]) -> list | None:
        """Return values, or None after an error."""
        values: dict[int, object] = {}
        for kind, group in self._split(references).items():
            buffer = (BUFFERS[kind] * len(group))()
            if self.call(f"fmi2Get{kind}", (c_uint * len(group))(*group), c_size_t(len(group)), buffer) != OK:
                return None
            for reference, value in zip(group, buffer, strict=True):
                values[reference] = bool(value) if kind == "Boolean" else value
        return [values[reference] for reference in references]

    def set(self, references: list[int], values: list) -> int:
        """Return the status of setting values."""
        by_reference = dict(zip(references, values, strict=True))
        worst = OK
        for kind, group in self._split(references).items():
            buffer = (BUFFERS[kind] * len(group))(*[by_reference[reference] for reference in group])
            worst = max(worst, self.call(f"fmi2Set{kind}", (c_uint * len(group))(*group), c_size_t(len(group)), buffer))
        return worst

    def enter(self, start_time: float = 0.0) -> None:
        """Set the experiment up and enter initialisation mode."""
        assert self.call("fmi2SetupExperiment", 0, c_double(0.0), c_double(start_time), 0, c_double(0.0)) == OK
        assert self.call("fmi2EnterInitializationMode") == OK

    def start(self) -> int:
        """Return the status of leaving initialisation mode."""
        return self.call("fmi2ExitInitializationMode")

    def do_step(self, t: float, h: float) -> int:
        """Return the status of a step."""
        return self.call("fmi2DoStep", c_double(t), c_double(h), 1)

    def reset(self) -> None:
        assert self.call("fmi2Reset") == OK

    def get_state(self) -> c_void_p:
        state = c_void_p()
        assert self.call("fmi2GetFMUstate", byref(state)) == OK
        return state

    def set_state(self, state: c_void_p) -> int:
        return self.call("fmi2SetFMUstate", state)

    def free_state(self, state: c_void_p) -> None:
        assert self.call("fmi2FreeFMUstate", byref(state)) == OK

    def serialised(self, state: c_void_p) -> bytes:
        size = c_size_t()
        assert self.call("fmi2SerializedFMUstateSize", state, byref(size)) == OK
        buffer = (ctypes.c_char * size.value)()
        assert self.call("fmi2SerializeFMUstate", state, buffer, size) == OK
        return bytes(buffer)

    def deserialised(self, text: bytes) -> c_void_p:
        state = c_void_p()
        assert self.call("fmi2DeSerializeFMUstate", text, c_size_t(len(text)), byref(state)) == OK
        return state

    def free(self) -> None:
        self.dll.fmi2FreeInstance(self.handle)
