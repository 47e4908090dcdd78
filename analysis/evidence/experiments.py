"""Experiments of a manifest: inputs of the simulation, and its expected trajectory.

Supported are the Experiments format (ma-hs-experiments, 2026), its form of 2025 with times as attributes of the
experiment, experiments within the manifest (FMI-LS-REF 1.0.0-rc.1), and results without an experiment, which belong to
the default experiment, as in the Reference-FMUs.
"""

from __future__ import annotations

import math
import posixpath
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from lxml import etree

from ...common.errors import InputError
from ...fmus_src.evidence.check import Tolerances
from ...fmus_src.evidence.experiments import TOLERANCES
from ...fmus_src.evidence.manifest import CSV, EXPERIMENTS, MANIFEST, PARAMETERS
from ..runtime.ssp.documents import parse_xml
from .manifest import Manifest, file_of

TYPES = {"Parameters": PARAMETERS, "Stimuli": CSV, "References": CSV}
TRANSIENT = "TransientSimulation"
KINDS = (
    "SteadyState",
    "ParameterOptimization",
    "SetPointOptimization",
    "SensitivityAnalysis",
    "TrajectoryOptimization",
    "Linearization",
)
TIMES = ("startTime", "stopTime", "stepSize")


@dataclass(frozen=True)
class PlannedExperiment:
    """An experiment with the names of its files in the archive. Times are in s; None is the default of the FMU.

    ``tolerances`` maps a signal to its tolerances (absolute, relative), which are 0 for unlisted signals. It is None if
    the experiment declares no tolerances.
    """

    name: str
    start: float | None
    stop: float | None
    step: float | None
    references: str
    parameters: str | None = None
    stimuli: str | None = None
    tolerances: Tolerances | None = None


@dataclass(frozen=True)
class Plan:
    """The experiments of a manifest to simulate; ``notes`` state which experiments are not simulated, and why."""

    experiments: tuple[PlannedExperiment, ...]
    notes: tuple[str, ...]


def plan_experiments(manifest: Manifest, files: Mapping[str, bytes], label: str) -> Plan:
    """Return the plan of an archive's experiments. Raises InputError for an experiment file that cannot be read."""
    experiments: list[PlannedExperiment] = []
    notes: list[str] = []
    for file, element in _elements(manifest, files, label):
        experiment = _read(element, file, label)
        if isinstance(experiment, str):
            notes.append(experiment)
        else:
            experiments.append(experiment)
    used = {each.references for each in experiments} | {each.stimuli for each in experiments}
    for related in manifest.files:
        if related.role == "result" and related.name not in used:
            if related.name is None:
                notes.append(f"{related.source}: not compared, since the archive has no such file")
            elif related.type != CSV:
                notes.append(f"{related.source}: not compared, since its type is {related.type} and not text/csv")
            else:
                experiments.append(PlannedExperiment("default experiment", None, None, None, related.name))
    return Plan(tuple(experiments), tuple(notes))


def _elements(manifest: Manifest, files: Mapping[str, bytes], label: str) -> Iterator[tuple[str, etree._Element]]:
    for element in manifest.root.iterfind("Experiment"):
        yield MANIFEST, element
    for related in manifest.files:
        is_experiment = related.role.partition("/")[0] == "experiment" and related.type == EXPERIMENTS
        if is_experiment and related.name is not None and related.name in files:
            root = parse_xml(files[related.name], f"{label}!{related.name}")
            if root.tag != "Experiments":
                raise InputError(
                    f"{label}!{related.name}",
                    str(root.tag),
                    "the root element is not Experiments",
                    "write ma-hs-experiments",
                )
            for element in root.iterfind("Experiment"):
                yield related.name, element


def _read(element: etree._Element, file: str, label: str) -> PlannedExperiment | str:
    """Return an experiment, or the reason why it is not simulated."""
    name = element.get("name") or "experiment"
    kind = next((kind for kind in KINDS if element.find(kind) is not None), None)
    if kind is not None:
        return f"{name}: not simulated, since experiments of kind {kind} are not supported"
    sources: dict[str, str | None] = {}
    for tag, expected in TYPES.items():
        child = element.find(tag)
        source = None if child is None else child.get("source")
        if child is not None and child.get("type", expected) != expected:
            return f"{name}: not simulated, since the type of its {tag} is {child.get('type')} and not {expected}"
        sources[tag] = None if source is None else file_of(source, posixpath.dirname(file))
        if source is not None and sources[tag] is None:
            return f"{name}: not simulated, since the archive has no file {source}"
    if sources["References"] is None:
        return f"{name}: not simulated, since it has no References to compare with"
    transient = element.find(TRANSIENT)
    times = element if transient is None else transient
    start, stop, step = (_number(times, key, file, label) for key in TIMES)
    if step is not None and step <= 0.0:
        raise _error(times, "stepSize", "is not a positive number of seconds", file, label)
    return PlannedExperiment(
        name,
        start,
        stop,
        step,
        sources["References"],
        sources["Parameters"],
        sources["Stimuli"],
        _tolerances(element, file, label),
    )


def _tolerances(element: etree._Element, file: str, label: str) -> Tolerances | None:
    declared = element.find(f"Annotations/Annotation[@type='{TOLERANCES}']/Tolerances")
    if declared is None:
        return None
    return {
        signal.get("name", ""): (_bound(signal, "absolute", file, label), _bound(signal, "relative", file, label))
        for signal in declared.iterfind("Signal")
    }


def _bound(element: etree._Element, key: str, file: str, label: str) -> float:
    bound = _number(element, key, file, label)
    if bound is not None and bound < 0.0:
        raise _error(element, key, "is negative", file, label)
    return 0.0 if bound is None else bound


def _number(element: etree._Element, key: str, file: str, label: str) -> float | None:
    text = element.get(key)
    if text is None:
        return None
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise _error(element, key, "is not a finite number", file, label)
    return number


def _error(element: etree._Element, key: str, problem: str, file: str, label: str) -> InputError:
    where = f"{element.tag} (line {element.sourceline}), {key}"
    return InputError(f"{label}!{file}", where, f"{element.get(key)!r} {problem}", "correct it")
