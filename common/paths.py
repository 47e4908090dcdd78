"""Paths of systems, laws and built FMUs, in a checkout or inside the installed package.

Compiled files are written to `CACHE`, a user's builds to the working folder, and nothing to an installed package.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Literal, get_args

from platformdirs import user_cache_path

PACKAGE = Path(__file__).parents[1]  # perilune; in a checkout its subfolders are links to the folders next to it
IS_CHECKOUT = (PACKAGE.parent / "build_fmus.py").is_file()
ROOT = PACKAGE.parent if IS_CHECKOUT else PACKAGE
SYSTEMS = ROOT / "ssp_systems"
LAWS = ROOT / "laws"
SEARCHES = LAWS / "searches"
BUILD = ROOT / "build"
Build = Literal["native", "python"]  # build of Perilune's FMUs
FLAVOURS: tuple[Build, ...] = get_args(Build)  # preferred in this order
CACHE = BUILD / "cache" if IS_CHECKOUT else user_cache_path("perilune", appauthor=False)


def shipped_fmu(name: str, flavour: str) -> Path:
    """Return the file that `build_fmus.py` writes for a block; it need not exist."""
    return BUILD / "fmus" / flavour / f"{name}.fmu"


def own_fmu(name: str, flavour: str) -> Path:
    """Return the file that `perilune export` writes for a user's block, in the working folder; it need not exist."""
    return Path.cwd() / "build" / "fmus" / flavour / f"{name}.fmu"


def own_fmus(name: str, flavour: str, system: Path | None) -> list[Path]:
    """Return the paths searched for a user's FMU: in the working folder, then next to the folder of its ``system``."""
    places = [own_fmu(name, flavour)]
    if system is not None:
        beside = system.resolve().parent / "build" / "fmus" / flavour / f"{name}.fmu"
        places += [beside] if beside not in places else []
    return places


def names_fmu(name: str | os.PathLike[str]) -> bool:
    """Return True if a name is the name of an FMU file, also with the suffix in capitals, as some tools write it."""
    return os.fspath(name).lower().endswith(".fmu")
