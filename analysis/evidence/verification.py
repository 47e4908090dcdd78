"""Verification of an FMU or a system: files unchanged, trajectories and studies reproduced."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...common.bounds import ARCHIVE_BYTES, ExcessError
from ...common.errors import InputError
from ...common.regular import read_input
from ...common.visible import limit_lines
from ...common.zips import ZippedFiles
from ..runtime.ssp.archive import SystemArchive
from ..runtime.system.fmu import Fmu
from ..runtime.system.options import SystemOptions
from .experiments import plan_experiments
from .manifest import Manifest, check_listed, read_manifest
from .reproduction import Reproduction, reproduce
from .study_evidence import compare_report, known_studies
from .sums import check_sums

NAMED = 10  # most added files, or flaws of a manifest, that are listed


@dataclass(frozen=True)
class Verification:
    """Findings on one archive: simulated experiments, repeated ``studies``, ``problems`` and ``notes``.

    ``reproduced`` lists the ``studies`` whose results equal their stored reports.
    """

    file: str
    reproductions: tuple[Reproduction, ...]
    studies: tuple[str, ...]
    reproduced: tuple[str, ...]
    problems: tuple[str, ...]
    notes: tuple[str, ...]


def verify_archive(
    archive: SystemArchive, options: SystemOptions, *, relative: float | None = None, timeout: float | None = None
) -> Verification:
    """Check the files of an .fmu or .ssp against its evidence, and repeat its experiments and studies.

    ``relative`` is the tolerance as in `reproduce`; ``timeout`` (s) limits each simulation and each trial of a
    campaign. Raises InputError if the evidence is missing or cannot be read, or if an experiment is too large.
    """
    files = ZippedFiles(read_input(archive.path, "give an .fmu or .ssp", ARCHIVE_BYTES), archive.label)
    manifest = read_manifest(files, archive.label)
    changed, added = check_sums(files, archive.label)
    problems = [f"{name}: {problem}" for name, problem in (check_listed(manifest, files) | changed).items()]
    plan = plan_experiments(manifest, files, archive.label)
    notes = [
        *limit_lines([f"{name}: not in SHA256SUMS, so it was added later" for name in added], NAMED, "files"),
        *limit_lines([f"manifest: {flaw}" for flaw in manifest.flaws], NAMED, "flaws in the manifest"),
        *plan.notes,
    ]
    loaded: dict[str, Fmu] = {}
    reproductions = []
    for experiment in plan.experiments:
        try:
            reproductions.append(reproduce(archive, files, experiment, options, relative, timeout, loaded))
        except ExcessError as error:
            element = f"experiment {experiment.name}"
            raise InputError(archive.label, element, error.problem, error.remedy) from error
        except InputError as error:
            problems.append(f"{experiment.name}: {error.text}")
    studies, reproduced, differences = _repeat_studies(archive, manifest, files, options, timeout)
    problems += differences
    if not plan.experiments and not studies:
        problems.append("contains no trajectory, so there is nothing to reproduce")
    return Verification(archive.label, tuple(reproductions), studies, reproduced, tuple(problems), tuple(notes))


def _repeat_studies(
    archive: SystemArchive,
    manifest: Manifest,
    files: Mapping[str, bytes],
    options: SystemOptions,
    timeout: float | None,
) -> tuple[tuple[str, ...], tuple[str, ...], list[str]]:
    """Return the repeated studies, the studies that equal their reports, and all differences from the reports."""
    studies, reproduced, problems = [], [], []
    for related in manifest.files:
        if related.study is None or related.name is None or related.name not in files:
            continue
        if related.study not in known_studies(archive):
            problems.append(f"{related.name}: reports {related.study}, which is not a study of the archive")
            continue
        where = f"{archive.label}!{related.name}"
        differences = compare_report(files[related.name], archive.path, related.study, options, where, timeout)
        problems += differences
        studies.append(related.study)
        reproduced += [] if differences else [related.study]
    return tuple(studies), tuple(reproduced), problems
