"""Export of a system's folder, with the FMUs to which it refers, as one archive."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

from ...common.errors import InputError
from ...common.paths import own_fmus, shipped_fmu
from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.archive import read_zip, write_zip
from ...fmus_src.export.available import fmu_file
from ...fmus_src.export.ssp_package import DESCRIPTION, SSD_NAMESPACE, pack_system
from ..evidence.system_evidence import add_system_evidence, check_studies
from ..runtime.ssp.archive import SystemArchive
from ..runtime.ssp.documents import parse_xml
from ..runtime.ssp.version_2.package import convert_package
from .fmus import build_fmu
from .request import ExportRequest


def export_system(
    archive: SystemArchive, path: Path, flavour: str, platforms: Sequence[str], request: ExportRequest
) -> None:
    """Export a system's folder as one archive, with the FMUs that it uses from repository and working folder.

    Raises InputError.
    """
    blocks, studies = catalogue(), check_studies(archive, request.studies)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for entry in [entry for entry in archive.files if entry.endswith(".ssd")]:
            root = parse_xml(archive.read(entry, entry), f"{archive.label}/{entry}")
            for component in root.iter(f"{{{SSD_NAMESPACE}}}Component"):
                source = component.get("source", "")
                target = folder / f"{Path(source).stem}.fmu"
                if source in archive.files or target.exists():
                    continue
                own = fmu_file(target.stem, flavour, archive.path)
                paths = own_fmus(target.stem, flavour, archive.path)
                is_users = own in paths and own != shipped_fmu(target.stem, flavour)
                if target.stem in blocks and not is_users:
                    build_fmu(blocks[target.stem], target, flavour, platforms, request.fmi)
                elif own is not None:
                    shutil.copyfile(own, target)
                else:
                    element = f"{component.get('name')} (line {component.sourceline})"
                    problem = (
                        f"{source} was not found in the system, in this repository or as {' or '.join(map(str, paths))}"
                    )
                    remedy = f"build your own with perilune export FILE.py and `flavour` {flavour}, or add the FMU"
                    raise InputError(f"{archive.label}/{entry}", element, problem, remedy)
        packed = pack_system(archive.path, [folder], folder / "packed")
        if archive.description != DESCRIPTION:
            files = read_zip(packed)
            write_zip(packed, {**files, DESCRIPTION: files[archive.description]})
        if request.ssp == "2" or request.fmi == 3:
            write_zip(packed, convert_package(read_zip(packed), archive.label))
        write_zip(path, add_system_evidence(packed, studies))
