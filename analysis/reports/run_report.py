"""The page of one run: termination, limits, scene, the system's figures, trajectory, all signals, provenance."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...fmus_src.roles import STATUS
from ..runtime.flight.results import Result
from ..runtime.ssp.types import WHOLE
from .common.page import write_page
from .common.signals import axes_of, distinct, signal_groups
from .diagram.diagram import Diagram
from .figures.declared import Figure
from .figures.figure_sections import figure_groups, joint_findings
from .figures.limits import Verdict, limit_document
from .figures.scene.declared import Scene
from .interactive.bundles import MISSING
from .scene.notes import scene_notes
from .scene.picture import draw_ends
from .scene.view import scene_view
from .time_histories import time_histories
from .trajectory import trajectory_legend, trajectory_panels, trajectory_reading

ENDINGS = {
    "finished": "Nominal termination: end-of-run flag raised.",
    "stop_time": "Reached stop time; no end condition triggered.",
    "terminated": "Terminated by an FMU.",
    "nonfinite": "Aborted: a component returned a value that is not finite.",
    "failed": "Aborted: an FMU reported an error or rejected a parameter.",
    "timed_out": "Aborted: wall-clock time limit exceeded.",
    "crashed": "Aborted: an FMU ended its process.",
    "hung": "Aborted: a call of an FMU did not return.",
    "out_of_memory": "Aborted: the process of an FMU took more memory than it may.",
    "interrupted": "Aborted: interrupted from the keyboard.",
}
MOST_KEYS = 12  # final values listed where no signal has a known name
KEY_VECTORS = ("position", "velocity")


def write_run_report(
    result: Result,
    path: Path,
    title: str,
    figures: Sequence[Figure] = (),
    diagram: Diagram | None = None,
    command: str = "",
) -> None:
    """Write one self-contained HTML page about a run; the same result gives the same bytes.

    ``figures`` are those that the SSD declares, see figures/reading.py; ``diagram`` is that of the system. ``command``
    simulates the run again.
    """
    limits = limits_by_verdict(figures, result)
    scene = next((figure for figure in figures if isinstance(figure, Scene)), None)
    view = scene_view(scene, result) if scene is not None else None
    limit_sections, groups = figure_groups(figures, result, result.provenance["system"])
    write_page(
        path,
        Path(__file__).with_name("run_report.html"),
        title=title,
        command=command,
        result=result,
        ending=ENDINGS[result.status],
        limits=limits,
        limit_count=sum(map(len, limits.values())),
        end_time=float(result.time[-1]) if result.time.size else None,
        provenance=result.provenance,
        key_values=key_values(result),
        trajectory=trajectory_panels(result),
        trajectory_legend=trajectory_legend(result),
        trajectory_reading=trajectory_reading(result),
        joint=joint_findings(figures, result),
        scene=view,
        scene_pictures=draw_ends(view) if view is not None else [],
        scene_notes=scene_notes(scene, result) if scene is not None else [],
        scripts_missing=MISSING,
        limit_sections=limit_sections,
        groups=groups,
        histories=time_histories(result),
        diagram=diagram,
        signals=signal_table(result),
        components=[
            ("system", result.provenance["system"], result.provenance["system_sha256"]),
            *((name, fmu["fmu"], fmu["sha256"]) for name, fmu in result.provenance["fmus"].items()),
        ],
    )


def limits_by_verdict(figures: Sequence[Figure], result: Result) -> dict[str, list[str]]:
    """The names of the system's limits by verdict, violated ones first; verdicts without a limit are left out."""
    limits = limit_document(figures, result)
    named = {
        str(verdict): [limit["name"] for limit in limits if limit["verdict"] is verdict]
        for verdict in (Verdict.VIOLATED, Verdict.NOT_EVALUATED, Verdict.MET)
    }
    return {verdict: names for verdict, names in named.items() if names}


class KeyValue(NamedTuple):
    """Final values of a signal or of a vector's elements, with a ``note``: the elements' axes, magnitude, maximum."""

    label: str
    note: str
    values: list[float]
    unit: str | None


def key_values(result: Result) -> list[KeyValue]:
    """Final values of the most important signals.

    These are the system's connectors, positions and velocities with their magnitudes (inputs that repeat them are
    left out), and the highest status of each component. A system without any of these has all its signals here, if
    they are at most `MOST_KEYS`.
    """
    if not result.time.size:
        return []
    final, axes = result.final(), axes_of(result)
    rows: list[KeyValue] = []
    groups = signal_groups(result)
    originals = distinct(groups, result)
    for group in sorted(groups, key=lambda group: bool(group.component)):
        if not group.component:
            rows += [KeyValue(name, axes.get(name, ""), [final[name]], group.unit) for name in group.names]
        elif group.variable in KEY_VECTORS and group.is_real and originals[group] == group:
            values = [final[name] for name in group.names]
            rows.append(KeyValue(group.label, group.axes, values, group.unit))
            if len(values) > 1:
                rows.append(KeyValue(group.label, "magnitude", [float(np.linalg.norm(values))], group.unit))
        elif group.variable == STATUS and group.type in WHOLE:
            rows.append(KeyValue(group.label, "maximum over run", [int(group.values(result).max())], group.unit))
    others = [group for group in groups if originals[group] == group]
    if not rows and len(others) <= MOST_KEYS:
        rows = [KeyValue(each.label, each.axes, [final[name] for name in each.names], each.unit) for each in others]
    return rows


class SignalRow(NamedTuple):
    """Initial, minimum, maximum and final value of a signal, which may be along a named ``axis``."""

    name: str
    axis: str
    type: str
    unit: str | None
    values: list[float]


def signal_table(result: Result) -> list[SignalRow]:
    """Initial, minimum, maximum and final value of every signal."""
    if not result.time.size:
        return []
    convert = {"Integer": int, "Enumeration": int, "Boolean": bool}
    rows, axes = [], axes_of(result)
    for name, values in result.signals.items():
        kind = convert.get(result.types[name], float)
        numbers = [kind(value) for value in (values[0], np.min(values), np.max(values), values[-1])]
        rows.append(SignalRow(name, axes.get(name, ""), result.types[name], result.units[name], numbers))
    return rows
