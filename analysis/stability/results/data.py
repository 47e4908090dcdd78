"""Loop responses and linear models as files for python-control, MATLAB and spreadsheets, with names and units.

`loops.json` for python-control and `loops.mat` for MATLAB have the same content; `responses.csv` contains the responses
only. Gains are factors, frequencies are in rad/s, times in s; signals and states are in the units stated next to them.
The bytes only depend on the content.

Source: The MathWorks, MAT-File Format (version 5): the first 116 bytes are a text that begins with "MATLAB 5.0
MAT-file", followed by the subsystem's offset, the version and the byte order. SciPy would write date and platform into
this text.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from scipy.io import savemat

from ....common.atomic import write_atomically
from ....common.visible import quote_formula
from .document import document, joint_margin, loop_margins
from .report import JointReport, LoopReport, Orders, StabilityStudy
from .responses import StateSpace

JSON, MAT, CSV = "loops.json", "loops.mat", "responses.csv"
SIGN = (
    "L is the negative of the loop's transfer function from u, the signal into the loop after the break point, "
    "to r, the signal that returns to this point: y = L u = -r. Negative feedback has a positive L, the loop is "
    "closed by "
    "u = d - y, the sensitivity is 1/(1 + L), and the critical point is -1."
)
MODEL = (
    "x[k+1] = A x[k] + B u[k], y[k] = C x[k] + D u[k] every model_period_s, deviations from the flight at the "
    "operating point. Where samples is 1, L(w) = C (exp(j w model_period_s) I - A)^-1 B + D; otherwise the loop "
    "is periodically time-varying, and u and y contain its samples over model_period_s, oldest first. The "
    "matrices are empty if there is no trustworthy linear model; note states the reason."
)
COLUMNS = ("loop", "operating_point", "response", "frequency_rad_s", "real", "imaginary")
LINEARISED, MEASURED = "linearised", "measured"
DIRECT = "with_feedthrough"  # suffix of names of the other order, if FMUs have undeclared dependencies
Curves = tuple[tuple[str, np.ndarray, np.ndarray], ...]  # (name of the response, frequency (rad/s), L)
HEADER = b"MATLAB 5.0 MAT-file, written by Perilune".ljust(116)


def write_data(report: StabilityStudy, folder: Path) -> None:
    """Write the three files to a folder, which is created; the same study gives the same bytes. Raises OSError."""
    facts, results = document(report), _results(report)
    about = {"system": facts["system"], "sign": SIGN, "model": MODEL}
    if report.orders is not None:
        about["feedthrough"] = _assumption(report.orders)
        if report.orders.report is not None:
            results |= {f"{name}_{DIRECT}": items for name, items in _results(report.orders.report).items()}
    content = {**about, "points": facts["points"], **results, "provenance": facts["provenance"]}
    write_atomically(folder / JSON, (json.dumps(content, default=_plain, indent=1, allow_nan=False) + "\n").encode())
    structs = {name: struct_array(items) for name, items in results.items()}
    write_atomically(folder / MAT, mat_bytes({**about, **{name: item for name, item in structs.items() if item.size}}))
    write_atomically(folder / CSV, _table(report).encode())


def _results(report: StabilityStudy) -> dict[str, list[dict[str, object]]]:
    times = {point.name: point.time for point in report.points}
    return {
        "loops": [_loop(loop, times[loop.point]) for loop in report.loops],
        "joint": [_joint(joint, times[joint.point]) for joint in report.joint],
    }


def _assumption(orders: Orders) -> str:
    """Return a note on FMUs with undeclared dependencies, and on the records of each order."""
    words = (
        f"Without declared dependencies of outputs on inputs, {orders.fmus} are stepped with inputs from the "
        "start of the step."
    )
    if orders.report is not None:
        direct = ", ".join(orders.direct)
        words += f" For loops_{DIRECT} and joint_{DIRECT}, {direct} are stepped with inputs from the end of the step."
        words += " The verdict in loops combines both orders."
    return words


def _loop(loop: LoopReport, time: float) -> dict[str, object]:
    """Return the record of one channel at a point with this time (s)."""
    curves = {name: (frequency, value) for name, frequency, value in _curves(loop)}
    empty = np.zeros(0), np.zeros(0, dtype=complex)
    linearised, measured = (curves.get(name, empty) for name in (LINEARISED, MEASURED))
    return {
        "name": loop.name,
        "loop": loop.loop,
        "operating_point": loop.point,
        "time_s": time,
        "broken_at": loop.cut,
        "returned": loop.returned,
        "unit": loop.unit or "1",
        "sample_period_s": loop.sample_period,
        "other_loops_closed": list(loop.closed),
        "stable": "not known" if loop.stable is None else "yes" if loop.stable else "no",
        "verdict": str(loop.verdict),
        **_fill_unknown(loop_margins(loop)),
        "frequency_rad_s": linearised[0],
        "L": linearised[1],
        "measured_frequency_rad_s": measured[0],
        "measured_L": measured[1],
        **_model(loop.open_loop),
        "note": "; ".join(f"{name}: {reason}" for name, reason in loop.not_applicable.items()),
    }


def _joint(joint: JointReport, time: float) -> dict[str, object]:
    return {
        "name": joint.name,
        "operating_point": joint.point,
        "time_s": time,
        "channels": list(joint.channels),
        "stable": "yes" if joint.stable else "no",
        **_fill_unknown({"disk_margin": joint_margin(joint)}),
        **_model(joint.open_loop),
    }


def _fill_unknown(facts: Mapping[str, float | str | None]) -> dict[str, float | str]:
    """Return margins for file formats that have no null."""
    return {key: "not known" if value is None else value for key, value in facts.items()}


def _curves(loop: LoopReport) -> Curves:
    """Return the linearised and the measured response, as far as they exist."""
    curves: list[tuple[str, np.ndarray, np.ndarray]] = []
    if loop.open_loop is not None:
        curves.append((LINEARISED, loop.curve.frequency, loop.curve.value))
    if (measured := loop.measured_response) is not None:
        curves.append((MEASURED, measured.curve.frequency, measured.curve.value))
    return tuple(curves)


def _model(model: StateSpace | None) -> dict[str, object]:
    if model is None:
        nothing = np.zeros((0, 0))
        model = StateSpace(nothing, nothing, nothing, nothing, 0.0, 0, (), (), (), (), (), 0.0)
    return {
        "A": model.a,
        "B": model.b,
        "C": model.c,
        "D": model.d,
        "model_period_s": model.period,
        "samples": model.samples,
        "model_error": model.error,
        "state_names": list(model.states),
        "state_units": [unit or "1" for unit in model.state_units],
        "input_names": list(model.inputs),
        "input_units": [unit or "1" for unit in model.signal_units],
        "output_names": list(model.outputs),
        "output_units": [unit or "1" for unit in model.signal_units],
    }


def _table(report: StabilityStudy) -> str:
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(COLUMNS)
    other = None if report.orders is None else report.orders.report
    for loops, ending in ((report.loops, ""), (other.loops if other is not None else (), f"_{DIRECT}")):
        for loop in loops:
            for name, frequency, values in _curves(loop):
                for w, value in zip(frequency.tolist(), values.tolist(), strict=True):
                    names = map(quote_formula, (loop.name, loop.point, f"{name}{ending}"))
                    rows.writerow((*names, repr(w), repr(value.real), repr(value.imag)))
    return text.getvalue()


def _plain(value: object) -> object:
    """Return arrays as JSON; complex numbers are [real, imaginary]."""
    if isinstance(value, np.ndarray):
        return np.stack([value.real, value.imag], axis=-1).tolist() if np.iscomplexobj(value) else value.tolist()
    raise TypeError(type(value).__name__)


def mat_bytes(variables: Mapping[str, object]) -> bytes:
    """Return a MAT-file with these variables; names are at most 63 letters, digits and underscores."""
    file = io.BytesIO()
    savemat(file, dict(variables), long_field_names=True, oned_as="column")
    return HEADER + file.getvalue()[len(HEADER) :]


def struct_array(records: Sequence[Mapping[str, object]]) -> np.ndarray:
    """Return records with the same keys as a 1 x n MATLAB struct array; lists of texts are cell arrays."""
    names = list(records[0]) if records else []
    array = np.empty((1, len(records)), dtype=[(name, object) for name in names])
    for place, record in enumerate(records):
        for name, value in record.items():
            array[name][0, place] = _cells(value) if isinstance(value, list) else value
    return array


def _cells(texts: Sequence[str]) -> np.ndarray:
    cells = np.empty((len(texts), 1), dtype=object)
    cells[:, 0] = texts
    return cells
