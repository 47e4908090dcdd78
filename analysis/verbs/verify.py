"""`perilune.verify` and `perilune verify`: reproduction of the evidence inside FMUs and systems."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Unpack, overload

from ...common.errors import InputError, suggestion
from ...common.paths import FLAVOURS, names_fmu
from ...fmus_src.export.available import find_fmu, fmu_flavours
from ..documents.model import Document
from ..documents.of.verification import verification_document, verification_problems
from ..evidence.verification import Verification, verify_archive
from ..options.declared.library import VERIFY, VerifyOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.ssp.archive import open_system, system_names
from ..runtime.system.options import SystemOptions, Watch, select_permissions
from .common.arguments import path_list
from .common.documented import Documented


@dataclass(frozen=True)
class Verifications(Documented, Sequence[Verification]):
    """Verifications of files, in the order of the paths."""

    files: tuple[Verification, ...]

    @overload
    def __getitem__(self, index: int) -> Verification: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Verification, ...]: ...
    def __getitem__(self, index: int | slice) -> Verification | tuple[Verification, ...]:
        return self.files[index]

    def __len__(self) -> int:
        return len(self.files)

    def document(self) -> Document:
        """Return a document with each experiment, notes, and the files that are unaltered."""
        return verification_document(self.files)

    def problems(self) -> list[str]:
        """Return the problems of all files: altered, not reproduced, or insufficiently compared."""
        return verification_problems(self.files)


@verb(VERIFY)
def verify(*paths: FilePath | Sequence[FilePath], **options: Unpack[VerifyOptions]) -> Verifications:
    """Reproduce the reference trajectories inside FMUs and systems, and check their files: `perilune verify`.

    ``paths`` are .fmu and .ssp files of any tool with a manifest of FMI-LS-REF, or names of FMUs, of which ``flavour``
    selects the build. Signals without a declared tolerance may differ by ``tolerance`` of their greatest magnitude: by
    default 1e-6, and 0 (identical bits) in Perilune's files. A tolerance above 1e-2 or fewer than 10 samples verify
    nothing. ``timeout`` (s, wall clock) limits each simulation; other options restrict foreign FMUs. Raises InputError
    for a file without evidence, and for an experiment that exceeds a limit on size.
    """
    system = SystemOptions(**select_permissions(options).trust)
    watch = Watch(options["timeout"])
    verifications = [
        verify_archive(
            open_system(_path(path, options["flavour"])), system, relative=options["tolerance"], timeout=watch.timeout
        )
        for path in path_list(paths)
    ]
    return Verifications(tuple(verifications))


def _path(text: str, flavour: str | None) -> Path:
    """Return the file for a path or the name of an FMU. Raises InputError for folders and other files."""
    path = Path(text)
    if names_fmu(path) or path.suffix.lower() == ".ssp":
        return path
    file = find_fmu(text, FLAVOURS if flavour is None else (flavour,))
    if file is not None:
        return file
    is_system = text in system_names() or path.is_dir()
    remedy = f"perilune export {text} writes it with its evidence" if is_system else suggestion(text, fmu_flavours())
    raise InputError("verify", text, "neither an .fmu, an .ssp nor the name of a built FMU", remedy)
