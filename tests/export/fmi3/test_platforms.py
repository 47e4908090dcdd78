"""FMUs of FMI 3.0 for several platforms: files, reproducible bytes, execution on aarch64 Linux under qemu.

Truth for aarch64: the checksum of the same simulation by this machine's library. `make emulator` installs qemu and the
C library of aarch64. `make long` covers all platforms, `make test` only this machine and aarch64 Linux, since zig first
builds the C library of each platform.
"""

from __future__ import annotations

import importlib.util
import zipfile
from pathlib import Path

import fmpy
import pytest

from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import compilers_for, local_platform, platforms_of
from perilune.fmus_src.export.native_fmu import build_native_fmu
from tests.support.kernels.programs import NO_QEMU, QEMU
from tests.support.lengths import LONG, either
from tests.support.native.driver import drive, link

BLOCK = catalogue()["output_feedback"]
NAME = BLOCK.fmu_name
LIBRARIES = Path("/usr/aarch64-linux-gnu")  # of Debian's libc6-arm64-cross
STEPS = either(2000, 300)
BUILT = either(platforms_of(3), ["x86_64-linux", "aarch64-linux"])
MAGIC = {  # how libraries begin: ELF, PE, 64-bit Mach-O; and the processor's number at its offset in them
    "x86_64-linux": (b"\x7fELF", 18, 0x3E),
    "aarch64-linux": (b"\x7fELF", 18, 0xB7),
    "x86_64-windows": (b"MZ", None, None),
    "x86_64-darwin": (b"\xcf\xfa\xed\xfe", 4, 0x01000007),
    "aarch64-darwin": (b"\xcf\xfa\xed\xfe", 4, 0x0100000C),
}
pytestmark = pytest.mark.skipif(importlib.util.find_spec("ziglang") is None, reason="ziglang is not installed")


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build an FMU with the libraries of several platforms."""
    path = tmp_path_factory.mktemp("all") / f"{NAME}.fmu"
    return build_native_fmu(BLOCK, path, platforms=BUILT, portable=LONG, fmi=3)


def test_there_is_a_library_for_each_platform(fmu: Path) -> None:
    with zipfile.ZipFile(fmu) as archive:
        folders = {name.split("/")[1]: archive.read(name) for name in archive.namelist() if name.startswith("bin")}
    assert folders.keys() == set(BUILT) <= MAGIC.keys() == set(platforms_of(3))
    for platform in BUILT:
        magic, offset, processor = MAGIC[platform]
        assert folders[platform].startswith(magic), platform
        if offset is not None:
            size = 4 if platform.endswith("darwin") else 2
            assert int.from_bytes(folders[platform][offset : offset + size], "little") == processor
    names = {"linux64", "c-code"} | either({"win64", "darwin64"}, set())  # of FMI 2.0
    assert names <= set(fmpy.supported_platforms(str(fmu)))


def test_two_builds_are_equal(fmu: Path, tmp_path: Path) -> None:
    local = local_platform(3)
    assert local is not None
    builds = [
        build_native_fmu(BLOCK, tmp_path / name / "a.fmu", platforms=[local], cache=tmp_path / name, fmi=3)
        for name in ("a", "b")
    ]
    assert builds[0].read_bytes() == builds[1].read_bytes()


def test_aarch64_linux_has_the_bits_of_this_machine(fmu: Path, tmp_path: Path) -> None:
    if local_platform(3) != "x86_64-linux":
        pytest.skip("compared with x86_64-linux")
    if QEMU is None:
        pytest.skip(NO_QEMU)
    if not LIBRARIES.is_dir():
        pytest.skip(f"{NO_QEMU}: no C library of aarch64")
    token = fmpy.read_model_description(str(fmu)).guid
    printed = {}
    for platform, runner in (("x86_64-linux", []), ("aarch64-linux", [QEMU, "-L", str(LIBRARIES)])):
        folder = tmp_path / platform
        folder.mkdir()
        with zipfile.ZipFile(fmu) as archive:
            for name in archive.namelist():
                if name.startswith((f"binaries/{platform}/", "sources/fmi3")):
                    (folder / Path(name).name).write_bytes(archive.read(name))
        (compiler,) = compilers_for(platform, LONG)
        link([*compiler, "-std=c99", "-O2", "-Wl,-rpath,$ORIGIN"], [f"{NAME}.so"], folder / "program")
        printed[platform] = drive(BLOCK, [*runner, str(folder / "program")], token, STEPS)
    assert printed["aarch64-linux"] == printed["x86_64-linux"]
