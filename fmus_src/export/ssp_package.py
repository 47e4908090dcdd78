"""Packing of a system's folder into an .ssp archive."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from lxml import etree

from ...common.paths import names_fmu
from .archive import write_zip

SSD_NAMESPACE = "http://ssp-standard.org/SSP1/SystemStructureDescription"
DESCRIPTION = "SystemStructure.ssd"
SYSTEM_FILE = "system.toml"  # source of `perilune compose`
RESOURCE_SUFFIXES = (".ssv", ".ssm", ".ssb")
CAMPAIGN_FOLDER = "extra/org.perilune/campaigns"


def system_files(folder: Path) -> dict[str, Path]:
    """Return the files of a system folder by archive name, without FMUs that are built elsewhere.

    SSDs and the FMUs next to them are at the root; parameter sets, mappings and dictionaries in resources/, campaigns
    in extra/, the README in documentation/; the folder's resources/ is copied unchanged.
    """
    files: dict[str, Path] = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if not path.is_file() or name.startswith("."):
            continue
        if path.parent == folder and (path.suffix == ".ssd" or names_fmu(path)):
            files[name] = path
        elif path.parent == folder and path.suffix in RESOURCE_SUFFIXES:
            files[f"resources/{name}"] = path
        elif name.startswith("campaigns/"):
            files[f"{CAMPAIGN_FOLDER}/{name.removeprefix('campaigns/')}"] = path
        elif name == "README.md":
            files["documentation/README.md"] = path
        elif name.startswith(("resources/", "documentation/", "extra/")):
            files[name] = path
    return files


def list_fmus(folder: Path) -> dict[str, str]:
    """Return the FMUs that a system's SSDs name and its folder does not contain: source -> first SSD that names it."""
    files = system_files(folder)
    sources: dict[str, str] = {}
    for name in [name for name in files if name.endswith(".ssd")]:
        for component in etree.fromstring(files[name].read_bytes()).iter(f"{{{SSD_NAMESPACE}}}Component"):
            source = component.get("source", "")
            if source not in files:
                sources.setdefault(source, name)
    return sources


def pack_system(folder: Path, fmus: Sequence[Path], target: Path) -> Path:
    """Write ``target``/NAME.ssp with the system's files and the FMUs that its SSDs name.

    An FMU is taken from the first of the folders ``fmus`` that contains it. Raises ValueError for an FMU in none of the
    folders, which names the FMU and the SSD.
    """
    files = {name: path.read_bytes() for name, path in system_files(folder).items()}
    for source, name in list_fmus(folder).items():
        built = [path / Path(source).name for path in fmus if (path / Path(source).name).is_file()]
        if not built:
            places = " or ".join(str(path) for path in fmus)
            raise ValueError(f"{folder / name}: {source}: no such FMU in {places}; add a block of this name")
        files[source] = built[0].read_bytes()
    path = target / f"{folder.name}.ssp"
    write_zip(path, files)
    return path
