"""Perilune as installed by a user: the wheel in a virtual environment, without compiler and without this checkout."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy

from perilune.common.paths import ROOT

HIDDEN = ("ziglang", "perilune", "__editable__", "_pytest", "pytest", "mypy", "ruff")


@dataclass(frozen=True)
class Installed:
    """A virtual environment with the wheel; ``home`` is the user's, ``site`` its site-packages."""

    wheel: Path
    python: Path
    site: Path
    home: Path

    def run(self, *arguments: str, cwd: Path, script: bool = False) -> subprocess.CompletedProcess[str]:
        """Run `perilune ARGUMENTS`, or with ``script`` Python on them, with nothing of this process's environment."""
        command = [str(self.python), *(() if script else ("-m", "perilune")), *arguments]
        environment = {"PATH": str(self.python.parent), "HOME": str(self.home), "MPLBACKEND": "agg"}
        return subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True, check=False)

    def files(self) -> dict[str, tuple[int, int]]:
        """Return all of site-packages: size and date by name."""
        collected = {path: path.stat() for path in self.site.rglob("*") if path.is_file()}
        return {str(path.relative_to(self.site)): (stat.st_size, stat.st_mtime_ns) for path, stat in collected.items()}


def copy_of_checkout(folder: Path) -> Path:
    """Copy the tracked files, with other dates and modes, into a folder without git, and return it."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in filter(None, names.split("\0")):
        copy = folder / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, copy, follow_symlinks=False)
        if not copy.is_symlink():
            copy.chmod(0o600)
            os.utime(copy, (1e9, 1e9))
    return folder


def build_wheel(folder: Path, source: Path = ROOT, **process: Any) -> Path:
    """Build the wheel of a checkout by `pip wheel`; ``process`` are options of `subprocess.run`."""
    command = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", folder, source]
    subprocess.run(command, check=True, capture_output=True, **process)
    (wheel,) = folder.glob("*.whl")
    return wheel


def install(wheel: Path, folder: Path) -> None:
    """Create a virtual environment with the wheel and, by links, what it depends on; site-packages are read-only.

    (Not for the superuser, who may write everywhere: compare `Installed.files` before and after.)
    """
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder / "venv"], check=True)
    collected = installed_in(folder)
    pip = [sys.executable, "-m", "pip", "--python", collected.python, "install", "--quiet", "--no-deps", "--no-index"]
    subprocess.run([*pip, wheel], check=True, capture_output=True)
    shared = folder / "shared"
    shared.mkdir()
    for entry in Path(numpy.__file__).parents[1].iterdir():
        if not entry.name.startswith(HIDDEN) and entry.suffix != ".pth":
            (shared / entry.name).symlink_to(entry)
    (collected.site / "shared.pth").write_text(f"{shared}\n", encoding="utf-8")
    for path in [collected.site, *(entry for entry in collected.site.rglob("*") if entry.is_dir())]:
        path.chmod(0o555)
    collected.home.mkdir()


def installed_in(folder: Path) -> Installed:
    """Return the installation of `install` in a folder."""
    (site,) = (folder / "venv" / "lib").glob("python*/site-packages")
    (wheel,) = (folder / "wheel").glob("*.whl")
    return Installed(wheel, folder / "venv" / "bin" / "python", site, folder / "home")
