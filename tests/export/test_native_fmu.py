"""Native FMU as an archive: valid, reproducible, cached, and independent of Python at run time."""

from __future__ import annotations

import re
import subprocess
import zipfile
from pathlib import Path

import fmpy
import pytest

from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export import compilers, libraries
from perilune.fmus_src.export.compilers import CompilationFailed, CompilerMissing, local_platform
from perilune.fmus_src.export.description.origin import STANDARD_HEADERS
from perilune.fmus_src.export.libraries import build_library
from perilune.fmus_src.export.native_fmu import build_native_fmu, wrapper_files
from perilune.fmus_src.export.write.names import WRAPPER_NAMES
from perilune.fmus_src.runtime import BlockInstance
from tests.support import kernels
from tests.support.kernels.native_instance import CACHE

BLOCK = catalogue()["forming_filter"]


def built(folder: Path, block: type[Block] = BLOCK, cache: Path = CACHE) -> Path:
    """Build the FMU of a block for the local platform."""
    platform = local_platform()
    assert platform is not None
    return build_native_fmu(block, folder / f"{block.fmu_name}.fmu", platforms=[platform], cache=cache)


def test_two_builds_are_byte_identical(tmp_path: Path) -> None:
    first = built(tmp_path / "a", cache=tmp_path / "cache a").read_bytes()
    second = built(tmp_path / "b", cache=tmp_path / "cache b").read_bytes()
    assert first == second


@pytest.mark.slow
def test_portable_builds_for_linux_and_windows_are_byte_identical(tmp_path: Path) -> None:
    pytest.importorskip("ziglang")
    paths = [
        build_native_fmu(BLOCK, tmp_path / name / "a.fmu", cache=tmp_path / name, portable=True) for name in ("a", "b")
    ]
    assert paths[0].read_bytes() == paths[1].read_bytes()
    with zipfile.ZipFile(paths[0]) as archive:
        assert archive.read("binaries/win64/forming_filter.dll").startswith(b"MZ")
        assert b"GLIBC_2.29" not in archive.read("binaries/linux64/forming_filter.so")


def test_unchanged_block_is_not_compiled_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = built(tmp_path / "a", cache=tmp_path / "cache").read_bytes()

    def refuse(*_: object) -> bytes:
        raise AssertionError("compiled again")

    monkeypatch.setattr(libraries, "_compile", refuse)
    assert built(tmp_path / "b", cache=tmp_path / "cache").read_bytes() == first


def test_missing_compiler_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compilers.shutil, "which", lambda _: None)
    monkeypatch.setattr(compilers.importlib.util, "find_spec", lambda _: None)
    with pytest.raises(CompilerMissing, match="pip install ziglang"):
        built(tmp_path, cache=tmp_path / "cache")


def test_compiler_errors_are_passed_on(tmp_path: Path) -> None:
    platform = local_platform()
    assert platform is not None
    with pytest.raises(CompilationFailed, match="broken"):
        build_library({"broken.c": b"this is not C"}, "broken.c", platform, tmp_path)
    with pytest.raises(ValueError, match="give one of linux64"):
        build_library({}, "broken.c", "amiga", tmp_path)


def test_sources_compile_without_warnings_by_themselves(tmp_path: Path) -> None:
    with zipfile.ZipFile(built(tmp_path)) as archive:
        sources = [name for name in archive.namelist() if name.startswith("sources/")]
        archive.extractall(tmp_path, sources)
    command = ["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-c", "-o", "out.o", "forming_filter.c"]
    subprocess.run(command, cwd=tmp_path / "sources", check=True)
    assert b"2-Clause BSD License" in (tmp_path / "sources" / STANDARD_HEADERS[2][0]).read_bytes()


def test_c_program_steps_the_fmu_without_python(tmp_path: Path) -> None:
    if local_platform() != "linux64":
        pytest.skip("the program loads the FMU with dlopen")
    path = built(tmp_path)
    with zipfile.ZipFile(path) as archive:
        archive.extractall(tmp_path)
    library = tmp_path / "binaries" / "linux64" / "forming_filter.so"
    needed = subprocess.run(["ldd", library], capture_output=True, text=True, check=True).stdout
    names = {line.split()[0].split("/")[-1].split(".")[0] for line in needed.splitlines()}
    assert names <= {"linux-vdso", "libc", "libm", "ld-linux-x86-64"}
    program = tmp_path / "step_fmu"
    source = Path(kernels.__file__).with_name("step_fmu.c")
    subprocess.run(["cc", "-I", tmp_path / "sources", "-o", program, source, "-ldl"], check=True)
    component = BlockInstance(BLOCK)
    references = [i for i, (name, _) in enumerate(component.elements) if name in ("disturbance", "disturbance_rate")]
    guid = fmpy.read_model_description(str(path)).guid
    arguments = [str(library), guid, "0.25", "20", *map(str, references)]
    printed = subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout
    component.start()
    for n, line in enumerate(printed.splitlines()):
        if n > 0:
            component.do_step((n - 1) * 0.25, 0.25)
        assert [float(token) for token in line.split()] == [n * 0.25, *component.get(references)]
    assert n == 20


def test_every_name_of_the_wrapper_is_kept_from_blocks() -> None:
    files = dict.fromkeys((*wrapper_files(2), *wrapper_files(3)))
    text = "".join(path.read_text(encoding="utf-8") for path in files)
    types = re.findall(r"^typedef (?:struct|enum|union) (\w+)", text, re.MULTILINE)
    types += re.findall(r"^typedef [\w ]+ (\w+);", text, re.MULTILINE)
    functions = re.findall(r"^(?:static|FMI2_Export) (?:[\w *]+?)\b(\w+)\(", text, re.MULTILINE)
    for size in re.findall(r"^VECTOR_TYPE\((\d)\)", text, re.MULTILINE):  # a macro for each size
        types.append(f"Vector{size}")
        functions += [f"{name}{size}" for name in re.findall(r"VECTOR_INLINE Vector##n (\w+)##n\(", text)]
    declared = {"Block", "model_initialize", "model_step", "model_set_start_time"}
    declared |= {"model_integration_step", "model_sample_period"}
    actual = {name for name in types + functions if not name.startswith("py_")} | declared
    assert actual == WRAPPER_NAMES
