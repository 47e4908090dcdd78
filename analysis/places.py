"""Where systems, laws, FMUs and built archives lie."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).parents[1]
SYSTEMS = ROOT / "ssp_systems"
LAWS = ROOT / "laws"
BUILD = ROOT / "build"


def built_fmu(name: str, flavour: str) -> Path:
    """The file that `build_fmus.py` writes for a block; it need not exist."""
    return BUILD / "fmus" / flavour / f"{name}.fmu"
