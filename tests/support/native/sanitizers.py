"""The compiler with its sanitizers."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import sys
import tempfile
import warnings
from functools import cache
from pathlib import Path

# Kernels divide and convert through checked helpers, so these two, allowed by IEEE 754 or left out of
# `undefined`, would be faults of the translation.
UNDEFINED = "undefined,float-divide-by-zero,float-cast-overflow"
FLAGS = ["-std=c99", "-O1", "-g", "-ffp-contract=off", "-fno-sanitize-recover=all"]


@cache
def find_compiler() -> tuple[str, ...]:
    """Return the command that compiles with sanitizers: the system's compiler, else zig's
    without the one for addresses."""
    system = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if system is not None:
        command = (system, *FLAGS, f"-fsanitize=address,{UNDEFINED}")
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "probe.c").write_text("int main(void) { return 0; }\n")
            probe = subprocess.run([*command, "-o", "probe", "probe.c"], cwd=folder, capture_output=True, text=True)
        assert probe.returncode == 0, (
            f"{system} cannot link its sanitizers; install them (Debian: apt-get install libasan8 libubsan1, which "
            f"come with gcc; Fedora: dnf install libasan libubsan):\n{probe.stderr}"
        )
        return command
    assert importlib.util.find_spec("ziglang") is not None, (
        "no C compiler: install one with sanitizers (apt-get install gcc libc6-dev), or pip install ziglang"
    )
    warnings.warn("no system C compiler: addresses are not checked, apt-get install gcc libc6-dev", stacklevel=1)
    return (sys.executable, "-m", "ziglang", "cc", *FLAGS, f"-fsanitize={UNDEFINED}")
