"""What there is to fly: systems, laws, searches, FMUs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from fmpy import read_model_description

from ...fmus_src.block import Block
from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.available import fmu_flavours
from ...fmus_src.export.ssp_package import CAMPAIGN_FOLDER
from ...fmus_src.paths import LAWS, SEARCHES
from ..runtime.ssp.archive import SystemArchive, open_system, system_names
from ..runtime.ssp.reading import read_description
from ..stability.request.reading import read_declaration


def inventory() -> dict[str, Any]:
    """Systems with their parameter sets, campaigns and loops; laws; searches; FMUs, those of the working folder too."""
    return {
        "systems": {name: _system(open_system(name)) for name in system_names()},
        "laws": sorted(path.stem for path in LAWS.glob("*.json")),
        "searches": sorted(path.stem for path in SEARCHES.glob("*.toml")),
        "fmus": _fmus(),
    }


def _system(archive: SystemArchive) -> dict[str, list[str]]:
    return {
        "parameter_sets": sorted(Path(name).name for name in archive.files if name.endswith(".ssv")),
        "campaigns": sorted(Path(name).stem for name in archive.files if name.startswith(f"{CAMPAIGN_FOLDER}/")),
        "loops": [loop.name for loop in read_declaration(read_description(archive)).loops],
    }


def _interface(block: type[Block]) -> str | None:
    """The interface that makes a block swappable: the class right below Block; None without one."""
    base = block.__mro__[block.__mro__.index(Block) - 1]
    return base.__name__ if base is not block else None


def _fmus() -> dict[str, dict[str, Any]]:
    """FMUs of this repository and those built in the working folder, by name."""
    found: dict[str, dict[str, Any]] = {
        name: {"interface": _interface(block), "description": block.summary(), "built": []}
        for name, block in catalogue().items()
    }
    for name, files in fmu_flavours().items():
        if name not in found:
            (first, *_) = files.values()
            description = read_model_description(str(first), validate=False).description or ""
            found[name] = {"interface": None, "description": description, "built": []}
        found[name]["built"] += files
    return found
