"""An FMU compiled from its sources with flags that change results rejects instantiation, and names the flag.

Truth: the manuals of gcc and clang on these flags.
"""

from __future__ import annotations

import importlib.util
import json
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.native_fmu import build_native_fmu, native_sources
from tests.support import kernels
from tests.support.kernels.native_instance import CACHE, GUID
from tests.support.kernels.programs import NO_QEMU, QEMU, ZIG
from tests.support.lengths import either

BLOCK = catalogue()["forming_filter"]
DOCUMENTED = ["-std=c99", "-O2", "-ffp-contract=off", "-fno-tree-vectorize"]
FUSED = (
    "fmi2Instantiate: the compiler fuses a * b + c into one operation, which rounds once; "
    "compile sources/ with -ffp-contract=off"
)
VECTORISED = (
    "fmi2Instantiate: the compiler's vectoriser fuses a * b + c into one operation, which rounds once; "
    "compile sources/ with -fno-tree-vectorize"
)
FAST = "fmi2Instantiate: the compiler changes results (-ffast-math or a part of it); compile sources/ without it"
X87 = "this target computes doubles in wider registers and would round results twice"
FLUSHED = (
    "fmi2Instantiate: subnormal numbers are flushed to zero; compile and link this FMU, and what loads it, "
    "without -ffast-math"
)
# Instantiates unpacked FMUs by fmpy one after the other, in another process: -ffast-math changes the modes of the
# processor in the process that loads the library.
SCRIPT = """
import json, sys
from fmpy import instantiate_fmu, read_model_description

logged = []
for folder in sys.argv[1:]:
    lines = []
    logged.append(lines)
    try:
        fmu = instantiate_fmu(folder, read_model_description(folder), "CoSimulation",
            logger=lambda environment, instance, status, category, message: lines.append(message.decode()))
        fmu.freeInstance()
        lines.append("accepted")
    except Exception as error:
        lines.append(str(error))
print(json.dumps(logged))
"""
REFUSED = "Failed to instantiate model"

pytestmark = pytest.mark.skipif(
    shutil.which("gcc") is None or local_platform() != "linux64", reason="no gcc for x86-64 Linux"
)


def has_fma() -> bool:
    """Return True if this processor has fused operations."""
    return "fma" in Path("/proc/cpuinfo").read_text(encoding="utf-8").split()


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the FMU as it is exported, unpacked."""
    folder = tmp_path_factory.mktemp("exported")
    path = build_native_fmu(BLOCK, folder / "forming_filter.fmu", platforms=["linux64"], cache=CACHE)
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder / "fmu")
    return folder / "fmu"


def compiled(fmu: Path, folder: Path, flags: list[str]) -> Path:
    """Copy an unpacked FMU whose library is compiled with other flags."""
    shutil.copytree(fmu, folder)
    library = folder / "binaries" / "linux64" / "forming_filter.so"
    command = ["gcc", *flags, "-fPIC", "-shared", "-o", library, "forming_filter.c", "-lm"]
    subprocess.run(command, cwd=folder / "sources", check=True, stderr=subprocess.PIPE, text=True)
    return folder


def logged(*fmus: Path) -> list[list[str]]:
    """Return the messages to fmpy's logger from each FMU, and the end of its instantiation."""
    done = subprocess.run([sys.executable, "-c", SCRIPT, *map(str, fmus)], capture_output=True, text=True, check=True)
    return json.loads(done.stdout.splitlines()[-1])


@pytest.mark.parametrize(
    "flags",
    [
        pytest.param(DOCUMENTED, marks=pytest.mark.slow),
        ["-O3", "-march=native", "-ffp-contract=off", "-fno-tree-vectorize"],
        pytest.param(["-O0"], marks=pytest.mark.slow),
        [*DOCUMENTED, "-fno-math-errno", "-fno-trapping-math", "-frounding-math"],
    ],
    ids=" ".join,
)
def test_flags_that_leave_results_alone_are_accepted(fmu: Path, tmp_path: Path, flags: list[str]) -> None:
    assert logged(fmu, compiled(fmu, tmp_path / "fmu", flags)) == [["accepted"], ["accepted"]]


@pytest.mark.parametrize(
    "flags",
    [["-O2", "-march=haswell", "-ffp-contract=fast"], *either([["-O3", "-mfma"], ["-Os", "-mfma"]], [])],
    ids=" ".join,
)
def test_fused_operations_are_refused(fmu: Path, tmp_path: Path, flags: list[str]) -> None:
    if not has_fma():
        pytest.skip("this processor has no fused operations (FMA)")
    assert logged(compiled(fmu, tmp_path / "fmu", flags)) == [[FUSED, REFUSED]]


@pytest.mark.parametrize("flags", [["-O3", "-mfma"], *either([["-O3", "-march=haswell"]], [])], ids=" ".join)
def test_products_fused_by_the_vectoriser_are_refused(fmu: Path, tmp_path: Path, flags: list[str]) -> None:
    """GCC 12 makes vfmaddsub of such a pair even under -ffp-contract=off; another version may not, and is accepted."""
    if not has_fma():
        pytest.skip("this processor has no fused operations (FMA)")
    source = tmp_path / "pair.c"
    source.write_text(
        "void pair(double *r, double a, double b, double c, double d, double e, double f)"
        "{ r[0] = a * b - c * d; r[1] = a * e + c * f; }"
    )
    command = ["gcc", *flags, "-ffp-contract=off", "-S", "-o", "-", source]
    assembly = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    expected = [VECTORISED, REFUSED] if "vfm" in assembly else ["accepted"]
    assert logged(compiled(fmu, tmp_path / "fmu", [*flags, "-ffp-contract=off"])) == [expected]


@pytest.mark.parametrize(
    "part",
    [
        ["-ffast-math"],
        pytest.param(["-funsafe-math-optimizations"], marks=pytest.mark.slow),
        pytest.param(["-fassociative-math", "-fno-signed-zeros", "-fno-trapping-math"], marks=pytest.mark.slow),
        ["-freciprocal-math"],
        pytest.param(["-ffinite-math-only"], marks=pytest.mark.slow),
        pytest.param(["-fno-signed-zeros"], marks=pytest.mark.slow),
    ],
    ids=" ".join,
)
def test_fast_math_and_its_parts_are_refused(fmu: Path, tmp_path: Path, part: list[str]) -> None:
    assert logged(compiled(fmu, tmp_path / "fmu", [*DOCUMENTED, *part])) == [[FAST, REFUSED]]


def test_extended_precision_is_refused(fmu: Path, tmp_path: Path) -> None:
    for number, flags in enumerate([[], ["-ffloat-store"], ["-fexcess-precision=fast"]]):
        with pytest.raises(subprocess.CalledProcessError) as refusal:
            compiled(fmu, tmp_path / str(number), [*DOCUMENTED, "-mfpmath=387", *flags])
        assert X87 in refusal.value.stderr


def test_subnormal_numbers_flushed_to_zero_are_refused(fmu: Path, tmp_path: Path) -> None:
    """By modes of the processor that the library sets, or one that was loaded before, as gcc's -ffast-math does."""
    source = tmp_path / "flush.c"
    source.write_text(
        "#include <xmmintrin.h>\n"
        "__attribute__((constructor)) static void flush(void) { _mm_setcsr(_mm_getcsr() | MODE); }\n"
    )
    for mode in ("0x8000", "0x0040"):  # results to zero, operands as zero (Intel, volume 1, 10.2.3)
        flags = ["-include", str(source), f"-DMODE={mode}", "-std=gnu99", "-O2", "-ffp-contract=off"]
        refusing = compiled(fmu, tmp_path / mode, flags)
        assert logged(fmu, refusing, fmu) == [["accepted"], [FLUSHED, REFUSED], [FLUSHED, REFUSED]]


@pytest.mark.slow  # zig builds the C library of aarch64 first, for a minute
@pytest.mark.skipif(importlib.util.find_spec("ziglang") is None, reason="ziglang is not installed")
def test_on_aarch64_compilers_fuse_by_default(tmp_path: Path) -> None:
    if QEMU is None:
        pytest.skip(NO_QEMU)
    for name, text in native_sources(BLOCK, GUID).items():
        (tmp_path / name).write_bytes(text)
    driver = Path(kernels.__file__).with_name("instantiate_fmu.c")
    actual = {}
    for flags in ("-O2", "-O0", "-O2 -ffast-math", "-O2 -ffp-contract=off"):
        command = [*ZIG, "-target", "aarch64-linux-musl", "-std=c99", "-w", *flags.split(), "-I", ".", "-o", "program"]
        subprocess.run([*command, driver, "forming_filter.c", "-lm"], cwd=tmp_path, check=True)
        done = subprocess.run([QEMU, str(tmp_path / "program"), GUID], capture_output=True, text=True, check=False)
        actual[flags] = (done.returncode, done.stdout.strip())
    assert actual == {
        "-O2": (1, FUSED),
        "-O0": (1, FUSED),
        "-O2 -ffast-math": (1, FAST),
        "-O2 -ffp-contract=off": (0, ""),
    }
