"""Loop without Python on other platforms: one FMU of FMI 3.0 on aarch64 Linux under qemu, and on Windows under Wine.

Truth: the record of the same run by this machine's library. `make emulator` installs qemu and the C library of aarch64,
`make windows` Wine, which only `make processors` uses.
"""

from __future__ import annotations

import importlib.util
import subprocess
import zipfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from perilune.analysis.runtime.flight.base_simulation import NOTHING
from perilune.analysis.runtime.flight.recorder import rows_between
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.instances.fmu_library import FUNCTION_NAMES
from perilune.analysis.runtime.loop import library
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import compilers_for, local_platform
from perilune.fmus_src.export.native_fmu import build_native_fmu
from tests.export.fmi3.test_platforms import LIBRARIES
from tests.support.kernels.programs import NO_QEMU, QEMU
from tests.support.lengths import LONG, either
from tests.support.native.frozen_run import freeze_run
from tests.support.native.wine import WINE, fresh_windows

NAME = either("spacecraft", "flat_moon_lander")
STEPS = either(2000, 100)
RUNNERS = {
    "x86_64-linux": [],
    "aarch64-linux": [QEMU or "qemu-aarch64-static", "-L", str(LIBRARIES)],
    "x86_64-windows": [str(WINE)],
}
FROZEN = Path(freeze_run.__code__.co_filename).with_name("fly_frozen_run.c")
pytestmark = [
    pytest.mark.skipif(importlib.util.find_spec("ziglang") is None, reason="ziglang is not installed"),
    pytest.mark.skipif(local_platform(3) != "x86_64-linux", reason="compared with x86_64-linux"),
]


@pytest.fixture(scope="module")
def windows() -> Iterator[dict[str, str]]:
    with fresh_windows() as environment:
        yield environment


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("fmu") / f"{NAME}.fmu"
    platforms = [name for name in RUNNERS if LONG or name != "x86_64-windows"]
    return build_native_fmu(catalogue()[NAME], path, platforms=platforms, portable=LONG, fmi=3)


@pytest.fixture(scope="module")
def case(fmu: Path) -> tuple[str, str, str]:
    """Return C data of the run, the token of the FMU, and the expected output of the program."""
    prepared = prepare_system(fmu, SystemOptions())
    with Simulation(prepared, open_end=True) as simulation:
        simulation.recorder.reserve(len(simulation.signal_names), rows_between(-1, STEPS), prepared.step)
        run = simulation._run(-1, STEPS, 1, False, NOTHING)
        frozen = freeze_run(run, simulation.instances[NAME].function_addresses())
        size = f"#define INSTRUCTIONS {len(run.program.instructions)}\n"
        functions = ", ".join(f"(uintptr_t){each}" if each[:4] == "fmi3" else "0" for each in FUNCTION_NAMES)
        flight = simulation.advance(-1, STEPS)
        assert (flight.status, flight.time.size) == ("stop_time", STEPS + 1)
        values = np.array([flight.signals[name] for name in simulation.signal_names])
        assert np.ptp(values, axis=1).max() > 0.0
        record = " ".join(format(bits, "x") for bits in values.view(np.uint64).ravel().tolist())
        token = prepared.network.fmus[NAME].description.guid
    return f"#define FUNCTIONS {functions}\n{size}{frozen}", token, f"0 {record}\n"


@pytest.mark.parametrize("platform", RUNNERS)
def test_a_program_in_c_has_the_bits_of_this_machine(fmu, case, platform, request, tmp_path):
    if platform == "aarch64-linux" and (QEMU is None or not LIBRARIES.is_dir()):
        pytest.skip(NO_QEMU)
    is_windows = platform == "x86_64-windows"
    if is_windows and (WINE is None or not LONG):
        pytest.skip("only with Wine, in make processors")
    frozen, token, expected = case
    for name, content in {**library.sources(), "frozen_run.h": frozen.encode()}.items():
        (tmp_path / name).write_bytes(content)
    with zipfile.ZipFile(fmu) as archive:
        for name in archive.namelist():
            if name.startswith((f"binaries/{platform}/", "sources/fmi3")):
                (tmp_path / Path(name).name).write_bytes(archive.read(name))
    (compiler,) = compilers_for(platform, LONG)
    program, extension = ("program.exe", "dll") if is_windows else ("program", "so")
    options = [*library.FLAGS, "-I", ".", *([] if is_windows else ["-Wl,-rpath,$ORIGIN"])]
    flags = [flag for flag in options if flag not in ("-shared", "-fPIC")]
    command = [*compiler, *flags, "-o", program, str(FROZEN), f"{NAME}.{extension}", "-lm"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    done = subprocess.run(
        [*RUNNERS[platform], str(tmp_path / program), token],
        env=request.getfixturevalue("windows") if is_windows else None,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout == expected
