"""Native FMU recompiled from its sources/, as for another platform: the bits of Python with any compiler."""

from __future__ import annotations

import ctypes
import importlib.util
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import pytest

from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.native_fmu import build_native_fmu, native_sources
from tests.support import lengths
from tests.support.kernels.comparison import Pair, fly
from tests.support.kernels.native_instance import CACHE, LOGGER, Callbacks, NativeInstance, opened
from tests.support.lengths import either

BLOCKS = [block for block in catalogue().values() if not block.python_only]
STEPS = lengths.size(200)
# The flags of docs/use_elsewhere.md; bits do not depend on the optimisation level.
FLAGS = ["-std=c99", "-ffp-contract=off", "-fno-tree-vectorize", "-fPIC", "-shared"]
COMPILERS = {
    "cc -O0": ["cc", "-O0"],
    "cc -O3": ["cc", "-O3"],
    "zig -O2": [sys.executable, "-m", "ziglang", "cc", "-O2"],
}
# Under `make long` every block with what optimises hardest, and the blocks that compute most with every compiler.
HARD = ("spherical_moon_lander", "free_flying_robot", "kalman_navigation", "jet_allocation_least_propellant")
LONG_CASES = [
    (block, compiler) for block in BLOCKS for compiler in COMPILERS if block.fmu_name in HARD or compiler == "cc -O3"
]
SHORT_CASES = [
    (block, compiler) for block in BLOCKS for compiler in ("cc -O3",) if block.fmu_name == "kalman_navigation"
]
CASES = either(LONG_CASES, SHORT_CASES)
TWO = ("forming_filter", "flat_moon_lander")


@pytest.fixture(scope="session")
def unpacked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the FMUs of the blocks that are needed, unpacked."""
    folder = tmp_path_factory.mktemp("unpacked")
    platform = local_platform()
    assert platform is not None
    for block in {*[block for block, _ in CASES], *[catalogue()[name] for name in TWO]}:
        path = build_native_fmu(block, folder / f"{block.fmu_name}.fmu", platforms=[platform], cache=CACHE)
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder / block.fmu_name)
    return folder


@pytest.mark.parametrize(("block", "compiler"), CASES, ids=lambda part: getattr(part, "fmu_name", part))
def test_compiled_from_its_own_sources_it_has_the_bits_of_python(
    block: type[Block], compiler: str, unpacked: Path, tmp_path: Path
) -> None:
    if compiler.startswith("cc") and shutil.which("cc") is None:
        pytest.skip("no system cc")
    if compiler.startswith("zig") and importlib.util.find_spec("ziglang") is None:
        pytest.skip("ziglang is not installed")
    fmu = unpacked / block.fmu_name
    description = fmpy.read_model_description(str(fmu))
    sources = [file for configuration in description.buildConfigurations for file in configuration.sourceFileSets]
    main = [name for source in sources for name in source.sourceFiles]
    assert main == [f"{block.fmu_name}.c"]
    library = tmp_path / "own.so"
    subprocess.run([*COMPILERS[compiler], *FLAGS, "-o", library, *main, "-lm"], cwd=fmu / "sources", check=True)
    native = NativeInstance(block, guid=description.guid, dll=opened(library))
    pair = Pair(block, lengths.generator(f"{block.fmu_name} {compiler}"), native)
    rows, _ = fly(pair, STEPS)
    assert len(rows) == STEPS
    native.free()


@pytest.mark.skipif(shutil.which("cc") is None, reason="no system cc")
def test_with_prefixes_two_fmus_go_into_one_program(unpacked: Path, tmp_path: Path) -> None:
    for name in TWO:
        command = ["cc", *FLAGS, f"-DFMI2_FUNCTION_PREFIX={name}_", "-c", "-o", tmp_path / f"{name}.o", f"{name}.c"]
        subprocess.run(command, cwd=unpacked / name / "sources", check=True)
    subprocess.run(["cc", "-shared", "-o", "both.so", *[f"{name}.o" for name in TWO], "-lm"], cwd=tmp_path, check=True)
    both = ctypes.CDLL(str(tmp_path / "both.so"))
    callbacks = Callbacks(LOGGER())
    for name in TWO:
        instantiate = both[f"{name}_fmi2Instantiate"]
        instantiate.restype = ctypes.c_void_p
        for other in TWO:
            guid = fmpy.read_model_description(str(unpacked / other)).guid.encode()
            handle = instantiate(b"one", 1, guid, None, ctypes.byref(callbacks), 0, 0)
            assert bool(handle) == (name == other)
            both[f"{name}_fmi2FreeInstance"](ctypes.c_void_p(handle))


@pytest.mark.skipif(shutil.which("cc") is None, reason="no system cc")
def test_with_a_prefix_no_function_of_fmi_3_keeps_its_name(tmp_path: Path) -> None:
    """Truth: the functions that the standard's header declares."""
    sources = native_sources(catalogue()[TWO[0]], "by hand", 3)
    for name, text in sources.items():
        (tmp_path / name).write_bytes(text)
    command = ["cc", *FLAGS, "-DFMI3_FUNCTION_PREFIX=one_", "-o", "one.so", f"{TWO[0]}.c", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    declared = re.findall(r"^FMI3_Export fmi3\w+TYPE\s+(\w+);", sources["fmi3Functions.h"].decode(), re.MULTILINE)
    library = ctypes.CDLL(str(tmp_path / "one.so"))
    assert len(declared) == len(set(declared)) > 70
    assert all(hasattr(library, f"one_{name}") and not hasattr(library, name) for name in declared)
