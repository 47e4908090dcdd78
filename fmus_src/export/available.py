"""The FMUs there are, by name: this repository's own, those in the working folder's ``build/fmus``, or a system's.

An installed package has its native FMUs inside. Its Python FMUs, whose loader alone would make it three times as large,
are built when they are first asked for, which takes no compiler, and kept in the cache folder.
"""

from __future__ import annotations

import hashlib
from functools import cache
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory

from ...analysis.common.machine.cached import cached_file
from ...analysis.common.regular import names_file
from ..catalogue import catalogue
from ..own_digests import note_own
from ..paths import CACHE, FLAVOURS, IS_CHECKOUT, PACKAGE, own_fmu, own_fmus, shipped_fmu
from .pythonfmu_fmu import build_python_fmu


def fmu_file(name: str, flavour: str, system: Path | None = None) -> Path | None:
    """The FMU of this name, the repository's before one of the working folder, or of that which ``system`` lies in.

    None where there is none.
    """
    shipped = shipped_fmu(name, flavour)
    if names_file(shipped):
        return shipped
    if not IS_CHECKOUT and flavour == "python" and name in catalogue():
        path = cached_file(_python_folder() / f"{name}.fmu", lambda: _python_fmu(name))
        note_own(path)  # the list may have been damaged since it was built
        return path
    return next((own for own in own_fmus(name, flavour, system) if names_file(own)), None)


def fmu_flavours() -> dict[str, dict[str, Path | None]]:
    """All FMUs by name, with the flavours there are; a file is None until it is asked for and built."""
    files: dict[str, dict[str, Path | None]] = {}
    for flavour in FLAVOURS:
        if not IS_CHECKOUT and flavour == "python":
            for name in catalogue():
                files.setdefault(name, {})[flavour] = None
        for folder in (shipped_fmu("x", flavour).parent, own_fmu("x", flavour).parent):
            for path in sorted(folder.glob("*.fmu")):
                files.setdefault(path.stem, {}).setdefault(flavour, path)
    return files


def _python_fmu(name: str) -> bytes:
    with TemporaryDirectory() as folder:
        return build_python_fmu(catalogue()[name], Path(folder) / f"{name}.fmu").read_bytes()


@cache
def _python_folder() -> Path:
    """Where Python FMUs of these sources are kept."""
    sources = PACKAGE / "fmus_src"
    digest = hashlib.sha256(version("pythonfmu").encode())
    for path in sorted((*sources.rglob("*.py"), *sources.glob("*/checks/*"))):
        digest.update(b"\0" + path.relative_to(sources).as_posix().encode() + b"\0" + path.read_bytes())
    return CACHE / "fmus" / digest.hexdigest()[:16]
