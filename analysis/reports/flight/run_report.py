"""The page of one run: how it ended, where it went, what its system asks for, every signal, what it was made of."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...runtime.flight.results import Result
from ..common.page import write_page
from ..common.signals import SignalGroup, distinct, signal_groups
from ..figures.declaration.declared import Figure
from ..figures.limit_table import Verdict, limit_document
from ..figures.own_figures import joint_findings, own_sections
from .time_histories import time_histories
from .trajectory import trajectory_panels, trajectory_reading

STATUS_WORDS = {
    "finished": "Ended by itself: the system reported that it is finished.",
    "stop_time": "Ran to its stop time; the system did not end by itself.",
    "terminated": "Ended by itself: an FMU asked for the end of the simulation.",
    "nonfinite": "Broke off: a component gave a value that is not a finite number.",
    "failed": "Broke off: an FMU reported an error, or did not take a parameter.",
    "timed_out": "Terminated: wall-clock time limit exceeded.",
    "interrupted": "Broke off: it was interrupted from the keyboard.",
}
MOST_KEYS = 12  # signals of a system that has none of what one looks at first
KEY_VECTORS = ("position", "velocity")


def write_run_report(result: Result, path: Path, title: str, figures: Sequence[Figure] = ()) -> None:
    """Write one self-contained HTML page about a run; the same result gives the same bytes.

    ``figures`` are those that the system asks for, see own/asked/reading.py.
    """
    write_page(
        path,
        Path(__file__).with_name("run_report.html"),
        title=title,
        result=result,
        words=STATUS_WORDS[result.status],
        limits=limits_by_verdict(figures, result),
        end_time=float(result.time[-1]) if result.time.size else None,
        provenance=result.provenance,
        key_values=key_values(result),
        trajectory=trajectory_panels(result),
        trajectory_reading=trajectory_reading(result),
        joint=joint_findings(figures, result),
        own=own_sections(figures, result),
        histories=time_histories(result),
        signals=signal_table(result),
    )


def limits_by_verdict(figures: Sequence[Figure], result: Result) -> dict[str, list[str]]:
    """The names of the system's limits by verdict, those that are not kept first; verdicts of none are left out."""
    limits = limit_document(figures, result)
    named = {
        str(verdict): [limit["name"] for limit in limits if limit["verdict"] is verdict]
        for verdict in (Verdict.NOT_KEPT, Verdict.NOT_EVALUATED, Verdict.KEPT)
    }
    return {verdict: names for verdict, names in named.items() if names}


def key_values(result: Result) -> list[dict[str, Any]]:
    """What one looks at first, at the end of the run.

    The system's own connectors, positions and velocities with their magnitudes (each once,
    however many inputs repeat it) and the worst status of every component; of a system without any of these all
    signals, as far as they are few.
    """
    if not result.time.size:
        return []
    final = result.final()
    rows: list[dict[str, Any]] = []
    groups = signal_groups(result)
    originals = distinct(groups, result)
    for group in sorted(groups, key=lambda group: bool(group.component)):
        if not group.component:
            rows += [_key_row(name, "", [final[name]], group) for name in group.names]
        elif group.variable in KEY_VECTORS and group.is_real and originals[group] == group:
            values = [final[name] for name in group.names]
            rows.append(_key_row(group.label, "", values, group))
            if len(values) > 1:
                rows.append(_key_row(group.label, "magnitude", [float(np.linalg.norm(values))], group))
        elif group.variable == "status" and group.type == "Integer":
            rows.append(_key_row(group.label, "worst of the run", [int(group.values(result).max())], group))
    others = [group for group in groups if originals[group] == group]
    if not rows and len(others) <= MOST_KEYS:
        rows = [_key_row(group.label, "", [final[name] for name in group.names], group) for group in others]
    return rows


def _key_row(label: str, note: str, values: list, group: SignalGroup) -> dict[str, Any]:
    return {"label": label, "note": note, "values": values, "unit": group.unit}


def signal_table(result: Result) -> list[dict[str, Any]]:
    """First, least, largest and last value of every signal."""
    if not result.time.size:
        return []
    convert = {"Integer": int, "Enumeration": int, "Boolean": bool}
    rows = []
    for name, values in result.signals.items():
        kind = convert.get(result.types[name], float)
        numbers = [kind(value) for value in (values[0], np.min(values), np.max(values), values[-1])]
        rows.append({"name": name, "type": result.types[name], "unit": result.units[name], "values": numbers})
    return rows
