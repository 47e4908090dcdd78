"""Where systems, laws and built FMUs lie: beside the rooms in a checkout, inside the package where it is installed."""

from __future__ import annotations

from pathlib import Path

PACKAGE = Path(__file__).parents[1]  # perilune; in a checkout its rooms are links to the folders beside it
ROOT = PACKAGE.parent if (PACKAGE.parent / "build_fmus.py").is_file() else PACKAGE
SYSTEMS = ROOT / "ssp_systems"
LAWS = ROOT / "laws"
BUILD = ROOT / "build"


def built_fmu(name: str, flavour: str) -> Path:
    """The file that `build_fmus.py` writes for a block; it need not exist."""
    return BUILD / "fmus" / flavour / f"{name}.fmu"
