"""What the numbers were measured on and with."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from loky import cpu_count

PACKAGES = ("perilune", "fmpy", "pythonfmu", "libcosimpy", "fmu-manipulation-toolbox", "numba", "numpy")


def machine() -> dict[str, str | int]:
    """Processor, how many of them this process may use, operating system."""
    return {"processor": _processor(), "processors": cpu_count(), "system": platform.platform()}


def versions() -> dict[str, str]:
    """Versions of Python, of this package and of the peers; "not installed" for those that are not."""
    by_package = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            by_package[package] = version(package)
        except PackageNotFoundError:
            by_package[package] = "not installed"
    return by_package


def _processor() -> str:
    path = Path("/proc/cpuinfo")
    if path.is_file():
        for line in path.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()
