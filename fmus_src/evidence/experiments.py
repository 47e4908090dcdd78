"""Experiments that reproduce reference trajectories: what to set, what to feed in, what should come out.

Format: Experiments (ma-hs-experiments), Modelica Association 2026. It has no tolerances for each signal, which stand in
an annotation of ours: |output - reference| <= absolute + relative |reference|.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from lxml import etree

from .check import Tolerances

TOLERANCES = "org.perilune.tolerances"


@dataclass(frozen=True)
class Experiment:
    """One simulation (times in s) with its files, named relative to that of the experiments; None where it has none.

    ``tolerances``: signal -> (absolute, relative). A signal that they do not name has to be equal, bit by bit; with
    None, which writes no annotation, every signal may differ by what whoever compares permits.
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
    """Return the file of experiments, XML without a namespace."""
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
