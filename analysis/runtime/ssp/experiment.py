"""Communication steps and algorithms, which SSP does not define, from annotations of Perilune and other tools.

OMSimulator writes a master algorithm into each system. The Open Simulation Platform (libcosim, Vico) writes an
algorithm into the default experiment, and hints into components. Both use Jacobi's algorithm.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from lxml import etree

from ....common.errors import InputError
from .documents import child, children, tag

STEP_ANNOTATION = "org.perilune.step"
OMSIMULATOR = "org.openmodelica"
OSP = ("com.opensimulationplatform", "org.open-simulation-platform", "com.github.ntnu-ihb.vico")  # the last is Vico's


@dataclass(frozen=True)
class StepSettings:
    """Communication step (s) and algorithm; ``varies`` is the line of an algorithm with variable step, or None."""

    step: float | None = None
    algorithm: str | None = None
    varies: int | None = None


def pace_of_experiment(experiment: etree._Element | None, file: str) -> StepSettings:
    """Return step and algorithm of the default experiment. Raises InputError."""
    for kind, item in _read_annotation(experiment):
        if kind == STEP_ANNOTATION and tag(item) == "CommunicationStep":
            return StepSettings(_seconds(item, ("size",), file))
        if kind in OSP and tag(item) == "FixedStepAlgorithm":
            return StepSettings(_seconds(item, ("baseStepSize", "stepSize"), file), "jacobi")
    return StepSettings()


def pace_of_system(system: etree._Element, file: str) -> StepSettings:
    """Return step and algorithm of a system, regardless of its inner systems. Raises InputError."""
    for kind, item in _read_annotation(system):
        if kind == OMSIMULATOR or kind in OSP:
            if tag(item) == "FixedStepMaster":
                return StepSettings(_seconds(item, ("stepSize",), file), "jacobi")
            if tag(item) in ("VariableStepMaster", "VariableStepSolver"):
                return StepSettings(algorithm="jacobi", varies=item.sourceline)
    return StepSettings()


def step_of_component(component: etree._Element, file: str) -> float | None:
    """Return the step (s) that a component requests, or None. Raises InputError."""
    for kind, item in _read_annotation(component):
        if kind in OSP and tag(item) == "StepSizeHint":
            return step_hint(item, "value", f"{tag(item)} (line {item.sourceline})", file)
    return None


def _read_annotation(element: etree._Element | None) -> Iterator[tuple[str, etree._Element]]:
    """Yield the type of each annotation of an element, with each element inside the annotation."""
    if element is not None:
        for annotation in children(child(element, "ssd:Annotations"), "ssc:Annotation"):
            for item in annotation.iterdescendants(etree.Element):
                yield annotation.get("type", ""), item


def _seconds(element: etree._Element, names: tuple[str, ...], file: str) -> float:
    name = next((name for name in names if element.get(name) is not None), names[0])
    return _positive_attribute(element, name, f"{tag(element)} (line {element.sourceline})", file)


def step_hint(element: etree._Element, name: str, where: str, file: str) -> float | None:
    """Return the step (s) in a hint for libcosim, or None if it is missing or 0.

    Raises InputError, at ``where``.
    """
    try:
        is_none = float(element.get(name, "0")) == 0.0
    except ValueError:
        is_none = False
    return None if is_none else _positive_attribute(element, name, where, file)


def _positive_attribute(element: etree._Element, name: str, where: str, file: str) -> float:
    return positive_seconds(element.get(name, ""), name, where, file, f'write {name}="0.1"')


def positive_seconds(text: str, name: str, where: str, file: str, remedy: str) -> float:
    """Return a step (s) from the text of an attribute or element ``name`` at ``where``. Raises InputError."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise InputError(file, where, f"{name} {text!r} is not a positive number of seconds", remedy)
    return value
