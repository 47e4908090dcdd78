"""Windows libraries of FMUs, as in a wheel, give the same bits as their C on this machine.

Truth: the checksum of `test_compilers.py`, by the system's compiler without optimisation. Windows is replaced by Wine,
with its implementation of Microsoft's C runtime (ucrtbase), in which the functions called by FMUs are exact. Only `make
processors` runs this file.
"""

from __future__ import annotations

import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from lxml import etree

from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.native_fmu import build_native_fmu
from tests.support.kernels.programs import ZIG, checksum, fly, link
from tests.support.lengths import LONG
from tests.support.native.wine import WINE, fresh_windows

BLOCKS = [block for block in catalogue().values() if not block.python_only]
STEPS = 2000

if WINE is None or not LONG:
    pytest.skip("only with Wine, in make processors", allow_module_level=True)


@pytest.fixture(scope="module")
def windows() -> Iterator[dict[str, str]]:
    with fresh_windows() as environment:
        yield environment


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: block.fmu_name)
def test_a_shipped_windows_library_gives_the_same_bits(
    block: type[Block], windows: dict[str, str], tmp_path: Path
) -> None:
    library = f"{block.fmu_name}.dll"
    path = build_native_fmu(block, tmp_path / f"{block.fmu_name}.fmu", platforms=["win64"], portable=True)
    with zipfile.ZipFile(path) as archive:
        guid = etree.fromstring(archive.read("modelDescription.xml")).get("guid")
        for name in archive.namelist():
            if name.startswith("sources/fmi2") or name == f"binaries/win64/{library}":
                (tmp_path / Path(name).name).write_bytes(archive.read(name))
    program = tmp_path / "program.exe"
    link([*ZIG, "-target", "x86_64-windows-gnu", "-std=c99", "-O2"], [library], program)
    (tmp_path / "here").mkdir()
    expected = checksum(block, "cc -O0", STEPS, tmp_path / "here")
    assert fly(block, [str(WINE), str(program)], guid, STEPS, windows) == expected
