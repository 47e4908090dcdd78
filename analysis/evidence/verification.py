"""Whether an FMU or a system is what was handed on: its files unchanged, its trajectories reproduced."""

from __future__ import annotations

from dataclasses import dataclass

from ..common.bounds import ARCHIVE_BYTES
from ..common.errors import InputError
from ..common.regular import read_input
from ..common.zips import ZippedFiles
from ..runtime.ssp.archive import SystemArchive
from ..runtime.system.fmu import Fmu
from ..runtime.system.options import SystemOptions
from .experiments import plan_experiments
from .manifest import checksum_problem, read_manifest
from .reproduction import Reproduction, reproduce
from .studies import compare_report, known_studies
from .sums import check_sums


@dataclass(frozen=True)
class Verification:
    """What is known of one archive: its experiments reproduced, its ``studies`` made anew; ``problems``, ``notes``."""

    file: str
    reproductions: tuple[Reproduction, ...]
    studies: tuple[str, ...]
    problems: tuple[str, ...]
    notes: tuple[str, ...]


def verify_archive(
    archive: SystemArchive, options: SystemOptions, *, relative: float | None = None, timeout: float | None = None
) -> Verification:
    """Check the files of an .fmu or .ssp against its evidence, and simulate its experiments again.

    ``relative`` as of `reproduce`, ``timeout`` (s) of each simulation. Raises InputError where there is no evidence, or
    some that cannot be read.
    """
    files = ZippedFiles(read_input(archive.path, "give an .fmu or .ssp", ARCHIVE_BYTES), archive.label)
    manifest = read_manifest(files, archive.label)
    problems, notes = check_sums(files, archive.label)
    named = {problem.partition(":")[0] for problem in problems}
    listed = filter(None, (checksum_problem(related, files) for related in manifest.files))
    problems += [problem for problem in listed if problem.partition(":")[0] not in named]
    notes += [f"manifest: {flaw}" for flaw in manifest.flaws]
    plan = plan_experiments(manifest, files, archive.label)
    notes += plan.notes
    loaded: dict[str, Fmu] = {}
    reproductions = []
    studies: list[str] = []
    for experiment in plan.experiments:
        try:
            reproductions.append(reproduce(archive, files, experiment, options, relative, timeout, loaded))
        except InputError as error:
            problems.append(f"{experiment.name}: {error.text}")
    for related in manifest.files:
        if related.study is not None and related.name is not None and related.name in files:
            if related.study not in known_studies(archive):
                problems.append(f"{related.name}: reports {related.study}, which is no study of the archive")
                continue
            where = f"{archive.label}!{related.name}"
            problems += compare_report(files[related.name], archive.path, related.study, options, where)
            studies.append(related.study)
    if not plan.experiments and not studies:
        problems.append("holds no trajectory: nothing to reproduce")
    return Verification(archive.label, tuple(reproductions), tuple(studies), tuple(problems), tuple(notes))
