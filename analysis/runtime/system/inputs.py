"""Inputs of a system that are not connected: open inputs, and inputs that a series of samples drives over time.

Tunable parameters can be driven in the same way.
"""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypedDict

import numpy as np

from ....common.errors import InputError, suggestion
from ....common.machine.table_memory import check_table_memory
from ....common.paths import names_fmu
from ..fmi.representations import OF_FMI2, REPRESENTATIONS, TEXTS, Representation
from ..ssp.kinds import LED_OUT
from ..ssp.names import split_name
from .checks import check_bounds, refuse_fixed
from .network import Network, Node, NodeLink
from .passing.settings import SystemSettings
from .series import InputSeries


def settle_open_inputs(network: Network, settings: SystemSettings, *, keep_starts: bool) -> None:
    """Keep inputs without a source or value at their FMUs' start values, or reject all such inputs with one message.

    Raises InputError.
    """
    inputs = [node for node in network.nodes.values() if node.kind == "input"]
    open_inputs = [
        node
        for node in inputs
        if node.name not in network.driver
        and node.name not in network.driven
        and node.name not in settings.nodes
        and (node.component or "", node.variable) not in settings.variables
    ]
    if not open_inputs:
        return
    if not keep_starts:
        open_inputs = _drop_partial_arrays(network, inputs, open_inputs)
    if open_inputs and not keep_starts:
        one = len(open_inputs) == 1
        problem = f"{'input is' if one else f'{len(open_inputs)} inputs are'} neither connected nor given a value"
        setting = f"`set` {shlex.quote(f'{open_inputs[0].name}=VALUE')}"
        connecting = "drive" if names_fmu(network.file) else "connect"
        driving = " by `input`" if names_fmu(network.file) else ""
        inputs_named = "the input" if one else "the inputs"
        remedy = f"{connecting} {inputs_named}{driving}, give a value: {setting}, or `open_inputs` start"
        assigned = next((settings.left_out[node.name] for node in open_inputs if node.name in settings.left_out), None)
        if assigned is not None:
            remedy = f"add {assigned} to the mapping, which omits it; or {remedy}"
        raise InputError(network.file, ", ".join(node.where for node in open_inputs), problem, remedy)
    without = {node.name for node in open_inputs}
    readers: dict[str, list[NodeLink]] = {}
    for link in network.links():
        readers.setdefault(link.source.name, []).append(link)
    while open_inputs:
        node = open_inputs.pop()
        if node.component is not None:
            start = network.fmus[node.component].variables[node.variable].start
            network.notes.append(f"{node.name}: open input, keeps {start}")
        for link in readers.get(node.name, ()):  # the targets of an open input of a system are open, too
            del network.driver[link.target.name]
            if link.target.name not in without:
                without.add(link.target.name)
                open_inputs.append(link.target)


def _drop_partial_arrays(network: Network, inputs: Sequence[Node], open_inputs: Sequence[Node]) -> list[Node]:
    """Return the open inputs except elements of arrays in which another element is connected or has a value.

    SSP 2.0 cannot declare single elements of an array: these inputs keep the FMU's start values, which is noted.
    """
    names = {node.name for node in open_inputs}
    in_part = {(node.component, node.array) for node in inputs if node.array and node.name not in names}
    remainder = [node for node in open_inputs if node.component is not None and (node.component, node.array) in in_part]
    for node in remainder:
        start = network.fmus[node.component or ""].variables[node.variable].start
        network.notes.append(f"{node.name}: open element of an array, keeps {start}")
    return [node for node in open_inputs if node not in remainder]


def missing_outputs(network: Network) -> list[str]:
    """Return a note if the system's FMUs have no outputs, so that only variables requested by name are recorded."""
    if any(variable.causality == "output" for fmu in network.fmus.values() for variable in fmu.variables.values()):
        return []
    return [f"{network.file}: no FMU has an output; name variables to record with `record`"]


def check_signals(network: Network, settings: SystemSettings) -> None:
    """Reject signals that are read but never driven; note outputs without a source, and undeclared inputs.

    Raises InputError.
    """
    for link in network.links():
        source = link.source
        is_signal = source.component is None and source.kind in ("inout", *LED_OUT)
        if is_signal and source.name not in network.driver:
            raise InputError(network.file, source.where, "signal is read but never driven", "connect a source to it")
    for node in network.nodes.values():
        if node.component is None and node.kind in LED_OUT and node.name not in network.driver:
            network.notes.append(f"{node.name}: output without a source, not recorded")
    if names_fmu(network.file):
        return  # a stand-alone FMU declares all inputs
    for component, fmu in network.fmus.items():
        for name, variable in fmu.variables.items():
            full = f"{component}.{name}"
            if variable.causality == "input" and full not in network.nodes and full not in network.driven:
                assigned = settings.variables.get((component, name))
                during = f"keeps {variable.start}" if assigned is None else f"is {assigned} throughout"
                network.notes.append(f"{component}.{name}: input not declared in the description, {during}")


HELD = ("discrete", "tunable")  # variabilities of Reals that are held, not interpolated
POINTS = 1_000_000  # number of points interpolated at once, which needs ten times their memory
CLOSE = 1e-9  # relative difference of equal times, as in FMPy and math.isclose


class DrivenInput(TypedDict):
    """Inputs driven by a series: the source of the series, and the names of the inputs."""

    file: str
    sha256: str
    signals: list[str]


class InputFacts(TypedDict, total=False):
    """Inputs over time in the provenance of a result."""

    input: DrivenInput


@dataclass(frozen=True, eq=False)
class Drive:
    """Inputs driven by a series, by name, with their values ``table`` [points + 1, inputs].

    Row 0 contains the values for the initialisation, row n + 1 the values at communication point n.
    """

    series: InputSeries
    names: tuple[str, ...]
    table: np.ndarray

    def facts(self) -> InputFacts:
        """Return the driven inputs for the provenance of a result."""
        return {"input": {"file": self.series.file, "sha256": self.series.sha256, "signals": list(self.names)}}


def find_driven(network: Network, series: InputSeries, alone: str | None) -> dict[str, str]:
    """Return the columns of a series by the names of the inputs that they drive.

    Inputs are unconnected connectors of the system or of a component, ``component.variable``, and tunable parameters;
    the component may be omitted for an FMU simulated ``alone``. Raises InputError for other columns, and for numbers
    that the type of an input cannot represent.
    """
    types = {
        node.name: (node.type_name or "Real", REPRESENTATIONS[OF_FMI2[node.type_name or "Real"]])
        for node in network.nodes.values()
        if node.component is None and node.kind == "input" and node.name not in network.driver
        if node.type_name not in TEXTS
    }
    types |= {
        f"{component}.{variable.name}": (variable.type, variable.representation)
        for component, fmu in network.fmus.items()
        for variable in fmu.variables.values()
        if (variable.causality == "input" or variable.is_tunable) and variable.type not in TEXTS
        if f"{component}.{variable.name}" not in network.driver
    }
    columns: dict[str, str] = {}
    for column in series.columns:
        name = f"{alone}.{column}" if alone is not None and f"{alone}.{column}" in types else column
        where = (series.file, f"column {column}")
        if name in network.driver:
            problem = f"is connected to {network.driver[name].source.name}, which would overwrite it"
            raise InputError(
                *where, problem, "drive an input that nothing is connected to, or inject a fault with `faults`"
            )
        if name not in types:
            refuse_fixed(network, name if alone is None else f"{alone}.{column}", where)
            known = types if alone is None else [text.removeprefix(f"{alone}.") for text in types]
            raise InputError(*where, "no such input", suggestion(column, known))
        if name in columns:
            raise InputError(
                *where, f"drives {name}, which column {columns[name]} also drives", "leave out one of the two columns"
            )
        _check_type(series, column, *types[name])
        _check_bounds(network, series, column, name)
        columns[name] = column
    return columns


def _check_type(series: InputSeries, column: str, type_name: str, stored: Representation) -> None:
    values = series.columns[column]
    if type_name == "Real":
        return
    if type_name == "Boolean":
        wrong, problem, remedy = (values != 0.0) & (values != 1.0), "is not a Boolean", "give true or false, 1 or 0"
    else:
        wrong = (values != np.round(values)) | (values < stored.limits[0]) | (values > stored.limits[1])
        problem, remedy = f"is not of type {type_name}", f"give {stored.describe_range()}"
    if wrong.any():
        row = int(np.flatnonzero(wrong)[0])
        raise InputError(series.file, series.place(row, column), f"{values[row]:.12g} {problem}", remedy)


def _check_bounds(network: Network, series: InputSeries, column: str, name: str) -> None:
    """Reject values of a tunable parameter outside its bounds; inputs may exceed their bounds."""
    component, short = split_name(name, network.fmus)
    variable = network.fmus[component].variables[short] if component else None
    if variable is not None and variable.is_tunable:
        values = series.columns[column]
        for row in {int(np.argmin(values)), int(np.argmax(values))} if values.size else ():
            check_bounds(variable, float(values[row]), (series.file, series.place(row, column)))


def drive_inputs(
    network: Network, series: InputSeries, driven: dict[str, str], start: float, step: float, steps: int
) -> Drive:
    """Return the values of ``driven`` inputs, as found by `find_driven`, at all communication points.

    Raises ExcessError if free memory does not suffice.
    """
    check_table_memory(len(driven), steps + 2, step, "inputs")
    table = np.empty((steps + 2, len(driven)))
    kinds = {name: interpolate if _is_continuous(network, name) else hold for name in driven}
    for place, (name, column) in enumerate(driven.items()):
        values = series.columns[column]
        table[0, place] = kinds[name](np.array([start]), series.time, values, after_event=False)[0]
        for row in range(0, steps + 1, POINTS):
            points = start + np.arange(row, min(row + POINTS, steps + 1)) * step
            samples = kinds[name](points, series.time, values, after_event=True)
            table[row + 1 : row + 1 + points.size, place] = samples
    return Drive(series, tuple(driven), table)


def _is_continuous(network: Network, name: str) -> bool:
    """Return True if an input is interpolated: a continuous Real, or a system's input that only drives such Reals."""
    for component, fmu in network.fmus.items():
        if name.startswith(f"{component}."):
            variable = fmu.variables.get(name.removeprefix(f"{component}."))
            if variable is not None:
                return variable.type == "Real" and variable.variability not in HELD
    readers = [link.target.name for link in network.driver.values() if link.source.name == name]
    return network.nodes[name].type_name in ("Real", None) and all(_is_continuous(network, name) for name in readers)


def interpolate(points: np.ndarray, time: np.ndarray, values: np.ndarray, *, after_event: bool) -> np.ndarray:
    """Return a continuous input at ``points`` (s), interpolated as FMPy's `Input.interpolate` does.

    ``values`` at ``time`` (s) are interpolated linearly, and are constant before the first and after the last time. A
    repeated time is an event: its last value is used if ``after_event``, else its first value. An event at the very
    first time always has its first value.
    """
    last = time.size - 1
    right = np.searchsorted(time, points)
    samples = values[np.clip(right, 0, last)]
    inner = (right > 0) & (right <= last)
    behind = right[inner]
    moments = points[inner]
    repeated = _close(time[:-1], time[1:])
    at_event = _close(moments, time[behind]) & np.append(repeated, False)[behind]
    run_ends = np.flatnonzero(~np.append(repeated, False))  # last rows of equal times
    event = run_ends[np.searchsorted(run_ends, behind)] if after_event else behind
    between = ~at_event
    inside = values[event]
    after = behind[between]
    weight = (time[after] - moments[between]) / (time[after] - time[after - 1])
    inside[between] = weight * values[after - 1] + (1.0 - weight) * values[after]
    samples[inner] = inside
    return samples


def hold(points: np.ndarray, time: np.ndarray, values: np.ndarray, *, after_event: bool) -> np.ndarray:
    """Return a discrete input at ``points`` (s): values are held from their times on, as in FMPy's `Input.interpolate`.

    If ``after_event``, a value is used at its own time already, else only after it. The first value is used at the
    first time in any case.
    """
    last = time.size - 1
    right = np.searchsorted(time, points)
    indices = np.clip(right - 1, 0, last)
    inner = (right > 0) & (right <= last)
    while after_event:
        ahead = np.minimum(indices + 1, last)
        moves = inner & (indices < last) & _close(points, time[ahead])
        if not moves.any():
            break
        indices = np.where(moves, ahead, indices)
    return values[np.where(right > last, last, indices)]


def _close(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    return np.abs(left - right) <= CLOSE * np.maximum(np.abs(left), np.abs(right))
