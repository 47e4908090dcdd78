"""Evidence shipped with a system: its simulation, its campaigns and parameter sets, its studies."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from contextlib import chdir
from pathlib import Path, PurePosixPath

import numpy as np

from ...common.errors import InputError, suggestion
from ...fmus_src.catalogue import catalogue
from ...fmus_src.evidence.experiments import Experiment, write_experiments
from ...fmus_src.evidence.manifest import (
    CSV,
    EXPERIMENTS,
    FOLDER,
    PARAMETERS,
    STABILITY,
    Related,
    add_manifest,
    mime_type,
)
from ...fmus_src.evidence.recorded import write_table
from ...fmus_src.export.archive import read_zip
from ...fmus_src.export.ssp_package import CAMPAIGN_FOLDER
from ..runtime.flight.interruptible import fly
from ..runtime.flight.results import Flight
from ..runtime.process.opening import open_simulation
from ..runtime.ssp.archive import SystemArchive
from ..runtime.ssp.names import split_name
from ..runtime.system.fmu import Fmu
from ..runtime.system.options import SystemOptions
from ..runtime.system.prepared import PreparedSystem, prepare_system
from .study_evidence import ALL, known_studies, make_report

ROWS = 200  # most rows of a trajectory: a simulation that differs anywhere differs at its end
TRAJECTORY, EXPERIMENT = f"{FOLDER}/outputs.csv", f"{FOLDER}/outputs.exp"


def check_studies(archive: SystemArchive, studies: Sequence[str]) -> list[str]:
    """Return the requested studies, or all of the system for `ALL`. Raises InputError for an unknown study."""
    known = known_studies(archive)
    for name in studies:
        if name not in (*known, ALL):
            raise InputError("`studies`", name, f"no such study of {archive.label}", suggestion(name, [*known, ALL]))
    for name in (STABILITY, ALL):
        if (name in studies or ALL in studies) and name in archive.campaign_names():
            raise InputError("`studies`", name, f"also a campaign of {archive.label}", "rename the campaign")
    return known if ALL in studies else list(dict.fromkeys(studies))


def add_system_evidence(packed: Path, studies: Sequence[str]) -> dict[str, bytes]:
    """Return the files of a packed system with evidence: a simulation with default options, and reports of ``studies``.

    If the system cannot be simulated with default options, it gets no trajectory, and a warning states why. Raises
    InputError.
    """
    files = read_zip(packed)
    related = _list_related(files)
    try:
        prepared = prepare_system(packed)
        with chdir(Path.cwd()), open_simulation(prepared) as simulation:
            flight = fly(simulation)
    except InputError as error:
        warnings.warn(f"no trajectory included: {error.text}", stacklevel=5)
    else:
        if flight.complete:
            files[TRAJECTORY] = _table(flight, prepared)
            files[EXPERIMENT] = _experiment(prepared)
            what = f"the system's outputs with all bits, at no more than {ROWS} communication points"
            related.append(Related(TRAJECTORY, "result", CSV, what))
            related.append(
                Related(EXPERIMENT, "experiment/validation", EXPERIMENTS, "experiment that reproduces the trajectory")
            )
        else:
            warnings.warn(f"no trajectory included: {flight.ending}: {flight.message}", stacklevel=5)
    for name in studies:
        report = f"{FOLDER}/reports/{name}.json"
        files[report] = make_report(packed, name, SystemOptions())
        what = "margins of the loops" if name == STABILITY else f"verdicts and statistics of the campaign {name}"
        related.append(Related(report, "report", mime_type(report), what, study=name))
    return add_manifest(files, related)


def _list_related(files: dict[str, bytes]) -> list[Related]:
    """Return the manifest entries of the system's parameter sets, campaigns and documents."""
    related = []
    for name in sorted(files):
        stem = PurePosixPath(name).stem
        if name.endswith(".ssv"):
            related.append(Related(name, "parameter", PARAMETERS, f"parameter set {stem}"))
        elif name.endswith(".toml") and name.startswith(f"{CAMPAIGN_FOLDER}/"):
            role = "experiment/uncertainty-analysis"
            related.append(Related(name, role, mime_type(name), f"campaign {stem}"))
        elif name.startswith("documentation/"):
            related.append(Related(name, "document", mime_type(name), "description of the system"))
    return related


def _table(flight: Flight, prepared: PreparedSystem) -> bytes:
    """Return the outputs over time (s) as CSV, with at most `ROWS` rows, the first and the last among them."""
    last = flight.time.size - 1
    rows = np.unique(np.linspace(0.0, last, min(ROWS, last + 1)).round().astype(int))
    columns = {"time": flight.time[rows].tolist()}
    for name, samples in flight.signals.items():
        component, variable = split_name(name, prepared.network.fmus)
        if not component or prepared.network.fmus[component].variables[variable].causality == "output":
            is_real = flight.types[name] == "Real"
            columns[name] = samples[rows].tolist() if is_real else samples[rows].astype(int).tolist()
    return write_table([*columns], ([*map(repr, row)] for row in zip(*columns.values(), strict=True)))


def _experiment(prepared: PreparedSystem) -> bytes:
    stop = prepared.start + prepared.steps * prepared.step
    exact = all(_is_exact(fmu) for fmu in prepared.network.fmus.values())
    description = "simulation of the unmodified system"
    if exact:
        description += ", to be reproduced bit by bit"
    times = (prepared.start, stop)
    source = PurePosixPath(TRAJECTORY).name
    experiment = Experiment("outputs", description, times, prepared.step, source, tolerances={} if exact else None)
    return write_experiments(prepared.archive.name, [experiment])


def _is_exact(fmu: Fmu) -> bool:
    """Return True if an FMU's results are bit-identical on every processor: it is one of Perilune's and needs no
    Python libraries.
    """
    block = catalogue().get(fmu.name)
    return fmu.is_own and (fmu.is_native or (block is not None and not block.python_only))
