"""C compilers and flags for each platform."""

from __future__ import annotations

import importlib.util
import platform as host
import shutil
import sys
from dataclasses import dataclass

# -O3 optimises calls and branches. -fno-tree-vectorize is for reproducible bits: GCC's vectoriser fuses a difference
# next to a sum with their products even under -ffp-contract=off (`kernel_self_test.h`). It costs no speed, since vector
# instructions do not pay in loops of three or nine passes. Without errno a square root is one instruction.
SOURCE_OPTIONS = ("-std=c99", "-O2", "-ffp-contract=off", "-fno-tree-vectorize")  # for importers that compile sources/
FLAGS = ("-O3", "-fno-tree-vectorize", "-fno-math-errno", "-std=c99", "-ffp-contract=off", "-fPIC", "-shared", "-s")
FOR_THIS_PROCESSOR = "-march=native"  # for libraries used on this machine only


class CompilerMissing(RuntimeError):  # noqa: N818
    """Error of a missing compiler for a platform; the message says how to get one."""


class CompilationFailed(RuntimeError):  # noqa: N818
    """Error of a compiler that rejected the sources or did not run; the message contains its output."""


@dataclass(frozen=True)
class Platform:
    """Platform of an FMI version: library extension and zig's target names, several for a universal library."""

    fmi: int
    extension: str
    zig_targets: tuple[str, ...]


LINUX, WINDOWS = "x86_64-linux-gnu.2.17", "x86_64-windows-gnu"
PLATFORMS = {
    "linux64": Platform(2, ".so", (LINUX,)),
    "win64": Platform(2, ".dll", (WINDOWS,)),
    "darwin64": Platform(2, ".dylib", ("x86_64-macos", "aarch64-macos")),
    "x86_64-linux": Platform(3, ".so", (LINUX,)),
    "aarch64-linux": Platform(3, ".so", ("aarch64-linux-gnu.2.17",)),
    "x86_64-windows": Platform(3, ".dll", (WINDOWS,)),
    "x86_64-darwin": Platform(3, ".dylib", ("x86_64-macos",)),
    "aarch64-darwin": Platform(3, ".dylib", ("aarch64-macos",)),
}
USUAL = {2: ("linux64", "win64"), 3: tuple(name for name, each in PLATFORMS.items() if each.fmi == 3)}


def platforms_of(fmi: int) -> list[str]:
    """Return the platform names of an FMI version."""
    return [name for name, platform in PLATFORMS.items() if platform.fmi == fmi]


def local_platform(fmi: int = 2) -> str | None:
    """Return the FMI name of this process's platform; None if it has no name or no compiler."""
    machine = host.machine().lower()
    system = {"linux": "linux", "win32": "windows", "darwin": "darwin"}.get(sys.platform)
    if fmi == 3:
        processor = {"amd64": "x86_64", "arm64": "aarch64"}.get(machine, machine)
        name = f"{processor}-{system}"
        return name if name in PLATFORMS else None
    if system == "darwin":
        return "darwin64"
    if machine not in ("x86_64", "amd64"):
        return None
    return {"linux": "linux64", "windows": "win64"}.get(system or "")


def compilers_for(platform: str, portable: bool = False) -> list[list[str]]:
    """Return the compiler commands of a platform, without flags, one for each processor of its libraries.

    The system's ``cc`` compiles for the platform of this process; zig, from the PyPI package ziglang, compiles for all
    platforms. With ``portable`` zig is always used; its linux64 libraries run on any Linux with glibc 2.17 or later.
    Raises `CompilerMissing`, and ValueError for an unknown platform.
    """
    if platform not in PLATFORMS:
        raise ValueError(f"platform {platform!r} is unknown; give one of {', '.join(PLATFORMS)}")
    system = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if system and platform in (local_platform(2), local_platform(3)) and not portable:
        return [[system]]
    if importlib.util.find_spec("ziglang") is not None:
        return [[sys.executable, "-m", "ziglang", "cc", "-target", name] for name in PLATFORMS[platform].zig_targets]
    raise CompilerMissing(
        f"no C compiler for {platform}: pip install ziglang (any platform), or install a system cc for the local one; "
        "the FMU's sources/ folder can also be compiled elsewhere"
    )


def compiled_here() -> list[str]:
    """Return a list of the FMI 2.0 name of this machine's platform; an empty one without a compiler for it."""
    local = local_platform()
    try:
        return [local] if local is not None and compilers_for(local) else []
    except CompilerMissing:
        return []


def available_platforms(fmi: int = 2) -> list[str]:
    """Return the usual platforms for which a compiler is available.

    With zig these are linux64 and win64 for FMI 2.0, and all platforms for FMI 3.0; otherwise only the local platform.
    """
    platforms = []
    for platform in USUAL[fmi]:
        try:
            compilers_for(platform)
        except CompilerMissing:
            continue
        platforms.append(platform)
    return platforms
