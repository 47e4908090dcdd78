"""perilune list: what there is to fly."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from fmpy import read_model_description

from ...fmus_src.block import Block
from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.available import fmu_flavours
from ...fmus_src.export.ssp_package import CAMPAIGN_FOLDER
from ...fmus_src.places import LAWS, SEARCHES
from ..stability.ask.reading import read_declaration
from ..system.archive import SystemArchive, open_system, system_names
from ..system.description import read_description
from .common.options import check_json, tell


def run(options: argparse.Namespace) -> int:
    check_json(options)
    document: dict[str, Any] = {
        "systems": {name: _system(open_system(name)) for name in system_names()},
        "laws": sorted(path.stem for path in LAWS.glob("*.json")),
        "searches": sorted(path.stem for path in SEARCHES.glob("*.toml")),
        "fmus": _fmus(),
    }
    return tell(document, options, lambda: _print(document))


def _print(document: dict[str, Any]) -> None:
    for name, system in document["systems"].items():
        print(name)
        print(f"  parameter sets  {', '.join(system['parameter_sets']) or 'none'}")
        print(f"  campaigns       {', '.join(system['campaigns']) or 'none'}")
        print(f"  loops           {', '.join(system['loops']) or 'none'}")
    print(f"laws              {', '.join(document['laws'])}")
    print(f"searches          {', '.join(document['searches'])}")
    print("FMUs")
    width = max((len(name) for name in document["fmus"]), default=0)
    for name, entry in document["fmus"].items():
        print(f"  {name:{width}}  {'+'.join(entry['built']) or 'not built':13}  {entry['description']}")


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
