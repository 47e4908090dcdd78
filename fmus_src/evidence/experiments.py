"""Experiments that reproduce reference trajectories: settings, inputs and expected outputs.

Format: Experiments (ma-hs-experiments), Modelica Association 2026. The format has no tolerances per signal; Perilune
writes them as an annotation: |output - reference| <= absolute + relative |reference|.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from lxml import etree

from .check import Tolerances

TOLERANCES = "org.perilune.tolerances"


@dataclass(frozen=True)
class Experiment:
    """One simulation (times in s) and its files, as names relative to the file of experiments, or None.

    ``tolerances`` maps a signal to (absolute, relative); a signal without an entry must be equal bit by bit. If
    ``tolerances`` is None, no annotation is written, and the user of the experiment chooses the tolerances.
    """

    name: str
    description: str
    times: tuple[float, float]
    step: float
    references: str
    parameters: str | None = None
    stimuli: str | None = None
    tolerances: Tolerances | None = field(default_factory=dict)


def write_experiments(name: str, experiments: Sequence[Experiment]) -> bytes:
    """Return the file of experiments as XML without a namespace."""
    root = etree.Element("Experiments", name=name)
    for each in experiments:
        element = etree.SubElement(root, "Experiment", name=each.name, description=each.description)
        start, stop = each.times
        etree.SubElement(
            element, "TransientSimulation", startTime=repr(start), stopTime=repr(stop), stepSize=repr(each.step)
        )
        files = {"Parameters": each.parameters, "Stimuli": each.stimuli, "References": each.references}
        for tag, source in files.items():
            if source is not None:
                etree.SubElement(element, tag, source=source)
        if each.tolerances is None:
            continue
        annotation = etree.SubElement(etree.SubElement(element, "Annotations"), "Annotation", type=TOLERANCES)
        tolerances = etree.SubElement(annotation, "Tolerances", absolute="0.0", relative="0.0")
        for signal, (absolute, relative) in each.tolerances.items():
            etree.SubElement(tolerances, "Signal", name=signal, absolute=repr(absolute), relative=repr(relative))
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
