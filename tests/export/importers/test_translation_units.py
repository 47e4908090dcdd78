"""Sources of exported FMUs for importers that compile every file, and for importers that compile C as C++17.

dSPACE and others compile each `.c` of sources/ as a translation unit, regardless of the list in the FMU. Truth: the
compilers, both lists as read by FMPy, and the bits of the library in C. `make long` covers every block.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from perilune.common.paths import shipped_fmu
from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.archive import read_zip, write_zip
from perilune.fmus_src.export.compilers import local_platform
from tests.support import lengths
from tests.support.kernels.comparison import Pair, fly
from tests.support.kernels.native_instance import NativeInstance, opened
from tests.support.lengths import either
from tests.support.native.building import COMPILED, NATIVE, fmi3_fmu
from tests.support.native.flights import fly_fmi3
from tests.support.native.system_fmus import Slave, build_one

SYSTEM = "lunar_terminal_guidance"
BITS = ["-O2", "-ffp-contract=off", "-fno-tree-vectorize", "-fPIC"]
CPP = ["-x", "c++", "-std=c++17"]
CPP_BLOCKS = either(COMPILED, ["terrain_camera"])
UNITS = either(COMPILED, ["orbital_filter"])
pytestmark = pytest.mark.skipif(shutil.which("cc") is None, reason="no system cc")


@pytest.fixture(scope="module")
def system_fmu(fmus: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build a system as one FMU, with two candidates of a slot."""
    slots = {"guidance": ["analytic_guidance", "astar_guidance"]}
    return build_one(tmp_path_factory.mktemp("system") / "system.fmu", SYSTEM, slots)


def unpack_sources(fmu: Path, folder: Path) -> list[str]:
    """Write the files of an FMU's sources/ to a folder; return the `.c` files."""
    with zipfile.ZipFile(fmu) as archive:
        names = [name for name in archive.namelist() if name.startswith("sources/")]
        archive.extractall(folder, names)
    return sorted(name.removeprefix("sources/") for name in names if name.endswith(".c"))


def listed(fmu: Path) -> list[str]:
    """Return the files that an importer is to compile, as FMPy reads them of either version."""
    description = fmpy.read_model_description(str(fmu))
    sets = [each for configuration in description.buildConfigurations for each in configuration.sourceFileSets]
    return [name for each in sets for name in each.sourceFiles]


def compile_units(fmu: Path, folder: Path) -> None:
    """Compile each `.c` by itself, and link all of them with every symbol known."""
    units = unpack_sources(fmu, folder)
    assert units == listed(fmu)
    for unit in units:
        subprocess.run(["cc", "-std=c99", "-O0", "-fPIC", "-c", unit], cwd=folder / "sources", check=True)
    objects = [unit.replace(".c", ".o") for unit in units]
    command = ["cc", "-shared", "-Wl,-z,defs", "-o", "all.so", *objects, "-lm"]
    subprocess.run(command, cwd=folder / "sources", check=True)


@pytest.mark.parametrize("name", NATIVE)
def test_every_c_file_is_listed_and_no_other(name: str, fmus: Path) -> None:
    fmu = shipped_fmu(name, "native")
    with zipfile.ZipFile(fmu) as archive:
        files = [entry for entry in archive.namelist() if entry.startswith("sources/") and entry.endswith(".c")]
        root = etree.fromstring(archive.read("modelDescription.xml"))
    names = [file.get("name") for file in root.iterfind("CoSimulation/SourceFiles/File")]
    assert files == [f"sources/{each}" for each in names] == [f"sources/{name}.c"]


@pytest.mark.parametrize("name", UNITS)
def test_every_c_file_of_fmi_2_is_a_translation_unit(name: str, fmus: Path, tmp_path: Path) -> None:
    compile_units(shipped_fmu(name, "native"), tmp_path)


@pytest.mark.skipif(local_platform(3) is None, reason="FMI 3.0 libraries are not compiled for this system")
@pytest.mark.parametrize("name", UNITS)
def test_every_c_file_of_fmi_3_is_a_translation_unit(name: str, tmp_path: Path) -> None:
    compile_units(fmi3_fmu(catalogue()[name]), tmp_path)


def test_every_c_file_of_a_system_is_a_translation_unit(system_fmu: Path, tmp_path: Path) -> None:
    compile_units(system_fmu, tmp_path)


def compile_as_cpp(fmu: Path, compiler: str, folder: Path) -> bytes:
    """Compile the library of an FMU's sources, taken for C++17."""
    if shutil.which(compiler) is None:
        pytest.skip(f"no {compiler}")
    units = unpack_sources(fmu, folder)
    command = [compiler, *CPP, *BITS, "-w", "-shared", "-o", "cpp.so", *units, "-lm"]
    subprocess.run(command, cwd=folder / "sources", check=True)
    return (folder / "sources" / "cpp.so").read_bytes()


def with_library(fmu: Path, library: bytes, folder: Path) -> Path:
    """Return the FMU with another library for this machine."""
    files = read_zip(fmu)
    version = 3 if "sources/fmi3Functions.h" in files else 2
    (name,) = [name for name in files if name.startswith(f"binaries/{local_platform(version)}/")]
    write_zip(folder / fmu.name, {**files, name: library})
    return folder / fmu.name


@pytest.mark.parametrize("compiler", ["g++", "clang++"])
@pytest.mark.parametrize("name", CPP_BLOCKS)
def test_compiled_as_cpp_a_block_has_the_bits_of_python(name: str, compiler: str, fmus: Path, tmp_path: Path) -> None:
    block: type[Block] = catalogue()[name]
    fmu = shipped_fmu(name, "native")
    compile_as_cpp(fmu, compiler, tmp_path)
    guid = fmpy.read_model_description(str(fmu)).guid
    native = NativeInstance(block, guid=guid, dll=opened(tmp_path / "sources" / "cpp.so"))
    assert hasattr(native.dll, "perilune_place")
    pair = Pair(block, lengths.generator(f"{name} {compiler}"), native)
    rows, _ = fly(pair, 12)
    assert len(rows) == 12
    native.free()


@pytest.mark.skipif(local_platform(3) is None, reason="FMI 3.0 libraries are not compiled for this system")
@pytest.mark.parametrize("compiler", ["g++", "clang++"])
@pytest.mark.parametrize("name", CPP_BLOCKS)
def test_compiled_as_cpp_a_block_of_fmi_3_has_the_bits_of_c(name: str, compiler: str, tmp_path: Path) -> None:
    fmu = fmi3_fmu(catalogue()[name])
    other = with_library(fmu, compile_as_cpp(fmu, compiler, tmp_path), tmp_path)
    step = catalogue()[name].default_step
    in_c, in_cpp = (fly_fmi3(each, {}, [{}] * 4, step, tmp_path / str(k)) for k, each in enumerate((fmu, other)))
    assert repr(in_cpp.points) == repr(in_c.points)
    assert in_cpp.state == in_c.state


@pytest.mark.parametrize("compiler", ["g++", "clang++"])
def test_compiled_as_cpp_a_system_has_the_bits_of_c(system_fmu: Path, compiler: str, tmp_path: Path) -> None:
    other = with_library(system_fmu, compile_as_cpp(system_fmu, compiler, tmp_path), tmp_path)
    states = []
    for k, fmu in enumerate((system_fmu, other)):
        slave = Slave(fmu, tmp_path / str(k))
        for _ in range(5):
            slave.step(0.1)
        states.append(slave.fmu.serializeFMUState(slave.fmu.getFMUState()))
    assert states[0] == states[1]


@pytest.mark.skipif(local_platform() != "linux64", reason="another processor")
def test_registers_of_80_bits_are_refused_by_the_compiler(fmus: Path, tmp_path: Path) -> None:
    (unit,) = unpack_sources(shipped_fmu("forming_filter", "native"), tmp_path)
    for flags, status in (([], 0), (["-mfpmath=387"], 1)):
        command = ["cc", "-std=c99", *flags, "-fsyntax-only", unit]
        done = subprocess.run(command, cwd=tmp_path / "sources", capture_output=True, text=True, check=False)
        assert done.returncode == status, done.stderr
        assert ("would round results twice" in done.stderr) == bool(flags)


@pytest.mark.parametrize("name", NATIVE[:: either(1, 10)])
def test_libraries_for_windows_need_the_universal_c_runtime_alone(name: str, fmus: Path) -> None:
    with zipfile.ZipFile(shipped_fmu(name, "native")) as archive:
        library = f"binaries/win64/{name}.dll"
        if library not in archive.namelist():
            pytest.skip("no library for Windows is built")
        needed = set(re.findall(rb"[\w-]+\.dll", archive.read(library)))
    runtime = {each for each in needed if each.startswith(b"api-ms-win-crt-")}
    assert runtime
    assert needed - runtime == {b"KERNEL32.dll", f"{name}.dll".encode()}
