"""Inputs that nothing drives, and signals that nothing gives: refused, noted, or left at their starts."""

from __future__ import annotations

from ...common.errors import InputError
from .assignments import Settings
from .network import Link, Network


def settle_open_inputs(network: Network, settings: Settings, *, keep_starts: bool) -> None:
    """Leave inputs that have neither a source nor a value at their FMUs' starts, or refuse all of them in one line.

    Raises InputError.
    """
    open_inputs = [
        node
        for node in network.nodes.values()
        if node.kind == "input"
        and node.name not in network.driver
        and node.name not in network.driven
        and node.name not in settings.nodes
        and (node.component or "", node.variable) not in settings.variables
    ]
    if not open_inputs:
        return
    if not keep_starts:
        one = len(open_inputs) == 1
        problem = f"{'input is' if one else f'{len(open_inputs)} inputs are'} neither connected nor given a value"
        setting = f"`set` {open_inputs[0].name}=VALUE"
        remedy = f"connect {'it' if one else 'them'}, give a value: {setting}, or `open_inputs` start"
        given = next((settings.left_out[node.name] for node in open_inputs if node.name in settings.left_out), None)
        if given is not None:
            remedy = f"map {given} too, whose mapping leaves it out; or {remedy}"
        raise InputError(network.file, ", ".join(node.where for node in open_inputs), problem, remedy)
    without = {node.name for node in open_inputs}
    readers: dict[str, list[Link]] = {}
    for link in network.driver.values():
        readers.setdefault(link.source.name, []).append(link)
    while open_inputs:
        node = open_inputs.pop()
        if node.component is not None:
            start = network.fmus[node.component].variables[node.variable].start
            network.notes.append(f"{node.name}: open input, keeps {start}")
        for link in readers.get(node.name, ()):  # of a system's own input: what it leads to is open, too
            del network.driver[link.target.name]
            if link.target.name not in without:
                without.add(link.target.name)
                open_inputs.append(link.target)


def check_signals(network: Network, settings: Settings) -> None:
    """Refuse a signal that is read and never driven, and note what is declared in vain. Raises InputError."""
    for link in network.driver.values():
        source = link.source
        is_signal = source.component is None and source.kind in ("inout", "output")
        if is_signal and source.name not in network.driver:
            raise InputError(network.file, source.where, "signal is read but never driven", "connect a source to it")
    for node in network.nodes.values():
        if node.component is None and node.kind == "output" and node.name not in network.driver:
            network.notes.append(f"{node.name}: output without a source, not recorded")
    for component, fmu in network.fmus.items():
        for name, variable in fmu.variables.items():
            full = f"{component}.{name}"
            if variable.causality == "input" and full not in network.nodes and full not in network.driven:
                start = settings.variables.get((component, name), variable.start)
                network.notes.append(f"{component}.{name}: input not declared in the SSD, keeps {start}")
