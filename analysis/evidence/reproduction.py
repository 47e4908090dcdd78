"""Reproduction of an experiment: simulated again, and compared with its reference trajectory."""

from __future__ import annotations

import posixpath
from collections.abc import Mapping
from contextlib import chdir
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from lxml import etree

from ...common.errors import InputError
from ...common.machine.table_memory import check_table_memory
from ...common.visible import limit_lines
from ..runtime.flight.interruptible import fly
from ..runtime.fmi.proposals import proposed_step
from ..runtime.process.opening import open_simulation
from ..runtime.ssp.archive import SystemArchive, read_fmu
from ..runtime.ssp.documents import NAMESPACES, read_document
from ..runtime.system.alone import describe_alone
from ..runtime.system.fmu import Fmu, load_fmu
from ..runtime.system.options import SystemOptions
from ..runtime.system.prepared import PreparedSystem, prepare_system
from .experiments import PlannedExperiment
from .reference_comparison import SignalCheck, compare, time_margin
from .trajectory import Trajectory, read_trajectory

TEXTS = ("String", "Binary")
NAMED = 6  # most columns without a variable, or wide tolerances, that are listed
RELATIVE = 1e-6  # default tolerance, a fraction of a signal's greatest magnitude
FEWEST = 10  # samples needed for a verification
WIDEST = 1e-2  # largest tolerance for a verification, a fraction of a signal's greatest magnitude
WHOLE = 1e-6  # tolerance when a number of steps is tested for being an integer
SET = "resources/perilune-verify-experiment.ssv"  # an experiment's parameters among the files of its archive


@dataclass(frozen=True)
class Reproduction:
    """Result of reproducing an experiment: ``signals``, the worst first, and ``problems`` that prevented a comparison.

    ``samples`` is the number of distinct times of the reference. ``not_compared`` lists its text columns.
    ``interpolated`` is True if times of the reference are between communication points.
    """

    name: str
    references: str
    samples: int
    signals: tuple[SignalCheck, ...]
    problems: tuple[str, ...] = ()
    not_compared: tuple[str, ...] = ()
    interpolated: bool = False

    @property
    def exact(self) -> bool:
        """True if all signals equal the reference to the last bit."""
        return not any(each.difference or each.excess for each in self.signals)

    @property
    def widest(self) -> SignalCheck:
        """The signal with the largest tolerance."""
        return max(self.signals, key=lambda each: each.tolerance)

    @property
    def weaknesses(self) -> list[str]:
        """The reasons why the comparison is too weak to verify anything, one line each."""
        few = (
            f"the reference has {self.samples} samples, but verification needs at least {FEWEST}; give a "
            "longer reference"
        )
        wide = [
            f"{each.name} may differ by {each.tolerance:.3g} of its greatest magnitude, more than the permitted "
            f"{WIDEST:g}; "
            "give a smaller tolerance"
            for each in self.signals
            if each.tolerance > WIDEST
        ]
        return [*([few] if self.signals and self.samples < FEWEST else []), *limit_lines(wide, NAMED, "signals")]


def reproduce(
    archive: SystemArchive,
    files: Mapping[str, bytes],
    experiment: PlannedExperiment,
    options: SystemOptions,
    relative: float | None,
    timeout: float | None,
    loaded: dict[str, Fmu],
) -> Reproduction:
    """Simulate an experiment of an archive with these ``files``, and compare it with its reference.

    ``relative`` is the tolerance of signals without a declared tolerance. It defaults to RELATIVE, or to 0 (equal bits)
    if the experiment declares tolerances for other signals. ``loaded`` caches FMUs as in `prepare_system`. Raises
    InputError.
    """
    reference = _table(files, experiment.references, archive.label)
    prepared = _prepare(archive, files, experiment, reference, options, loaded)
    samples = int(np.unique(reference.time).size)
    reproduction = Reproduction(experiment.name, experiment.references, samples, (), not_compared=reference.texts)
    if experiment.start is not None and experiment.start != prepared.start:
        problem = f"starts at {experiment.start:g} s, but the default experiment starts at {prepared.start:g} s"
        return replace(reproduction, problems=(f"{problem}: not simulated",))
    first, last = reference.time[[0, -1]]
    if first < prepared.start - time_margin(first):
        problem = f"its reference starts at {first:g} s, but the simulation at {prepared.start:g} s: not simulated"
        return replace(reproduction, problems=(problem,))
    variables, problems = _variables(prepared, reference)
    if not variables:
        return replace(reproduction, problems=tuple(problems) or ("its reference has no signal to compare",))
    more = [name for name in variables.values() if name not in prepared.network.nodes]
    with chdir(Path.cwd()), open_simulation(prepared, additional=more) as simulation:
        flight = fly(simulation, timeout)
    if not flight.complete:
        problems.append(f"{flight.ending}: {flight.message}")
    elif flight.time[-1] < last - time_margin(last):
        problems.append(f"ends at t = {flight.time[-1]:g} s, but the reference at {last:g} s")
    else:
        fraction = (0.0 if experiment.tolerances is not None else RELATIVE) if relative is None else relative
        references = {name: reference.signals[name] for name in variables}
        signals = {name: flight.signals[full] for name, full in variables.items()}
        checks, interpolated = compare(
            reference.time, references, flight.time, signals, experiment.tolerances, fraction
        )
        reproduction = replace(reproduction, signals=tuple(checks), interpolated=interpolated)
    return replace(reproduction, problems=tuple(problems))


def _variables(prepared: PreparedSystem, reference: Trajectory) -> tuple[dict[str, str], list[str]]:
    """Return the recorded signal to compare with each column, and a problem for each column without such a signal."""
    network, prefix = prepared.network, ""
    if prepared.archive.is_fmu:
        prefix = f"{next(iter(network.fmus))}."
    types = {
        f"{owner}.{name}": variable.type
        for owner, fmu in network.fmus.items()
        for name, variable in fmu.variables.items()
    }
    variables: dict[str, str] = {}
    problems = []
    for name in reference.signals:
        node, full = network.nodes.get(name), f"{prefix}{name}"
        if node is not None and node.component is None:
            variables[name] = name
        elif types.get(full, "String") == "String":
            problem = "it is a String, and strings are not recorded" if full in types else "no such variable"
            problems.append(f"column {name}: {problem}")
        elif full not in network.driven:
            variables[name] = full
    return variables, limit_lines(problems, NAMED, "columns")


def _table(files: Mapping[str, bytes], name: str, label: str) -> Trajectory:
    return read_trajectory(_content(files, name, label), f"{label}!{name}")


def _content(files: Mapping[str, bytes], name: str, label: str) -> bytes:
    if name not in files:
        raise InputError(f"{label}!{name}", "file", "missing, although an experiment names it", "export the file again")
    return files[name]


def _prepare(
    archive: SystemArchive,
    files: Mapping[str, bytes],
    experiment: PlannedExperiment,
    reference: Trajectory,
    options: SystemOptions,
    loaded: dict[str, Fmu],
) -> PreparedSystem:
    stop = float(reference.time[-1]) if experiment.stop is None else experiment.stop
    options = options.replace(stop_time=stop, step=experiment.step)
    others: set[str] = set()
    component = ""
    if archive.is_fmu:
        if archive.label not in loaded:
            loaded[archive.label] = load_fmu(read_fmu(archive.path)(), archive.label)
        fmu = loaded[archive.label]
        component = describe_alone(fmu, options)[0].system.name
        others = {
            name for name, variable in fmu.variables.items() if variable.causality != "input" or variable.type in TEXTS
        }
        if options.chosen["step"] is None:
            options = options.replace(step=_step(reference.time, proposed_step(fmu.description, fmu.label, [])))
    if experiment.parameters is not None:
        content = _content(files, experiment.parameters, archive.label)
        if component:
            content = _with_component(content, component, f"{archive.label}!{experiment.parameters}")
        archive = replace(archive, files={**archive.files, SET: content}, known_digest=None)
        options = options.replace(parameters=(*options.parameters, posixpath.basename(SET)))
    series = None
    if experiment.stimuli is not None:
        series = _table(files, experiment.stimuli, archive.label).series(without=others)
    if options.chosen["step"] is not None:  # before inputs are interpolated or anything is simulated
        start = float(reference.time[0]) if experiment.start is None else experiment.start
        columns = reference.signals.keys() | (series.columns.keys() if series else set())
        check_table_memory(len(columns), (stop - start) // options.chosen["step"], options.chosen["step"])
    return prepare_system(archive, options, loaded, series)


def _step(time: np.ndarray, proposed: float | None) -> float | None:
    """Return the step (s) of a default experiment: the FMU's if it divides all times, else their least spacing."""
    spacing = np.diff(time)
    if not (spacing > 0.0).any():
        return proposed
    if proposed is not None:
        steps = (time - time[0]) / proposed
        if np.all(np.abs(steps - np.round(steps)) <= WHOLE):
            return proposed
    return float(spacing[spacing > 0.0].min())


def _with_component(content: bytes, component: str, file: str) -> bytes:
    """Return an FMU's parameter set for a system that contains the FMU: all names with the prefix ``component``."""
    root = read_document(content, "ssv", file)
    for parameter in root.iter(f"{{{NAMESPACES['ssv']}}}Parameter"):
        parameter.set("name", f"{component}.{parameter.get('name', '')}")
    return etree.tostring(root)
