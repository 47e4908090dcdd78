"""Options that several verbs share, and how results leave as JSON."""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from ....fmus_src.paths import FLAVOURS
from ...common.atomic import write_atomically
from ...common.errors import InputError
from ...common.targets import Results, check_file
from ...runtime.system.fault import KINDS, Fault, parse_fault
from ...runtime.system.options import ALGORITHMS, OPEN_INPUTS, SystemOptions
from .completers import completed, parameter_sets, slots_with_fmus, systems, systems_and_fmu_files
from .exit_status import exit_status


def add_json(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--json", metavar="FILE", help="write the result as JSON to a file, or to standard output with -"
    )


def add_system(parser: argparse.ArgumentParser, needed: bool = True, alone: bool = False) -> None:
    """The system and its options, as in docs/command_line.md; one that is not ``needed`` and not given is None.

    ``alone``: an FMU by itself does, too.
    """
    system = parser.add_argument(
        "system",
        metavar="SYSTEM",
        nargs=None if needed else "?",
        help=f"a name under ssp_systems, a folder or an .ssp file{', or an .fmu, which flies alone' if alone else ''}",
    )
    completed(system, systems_and_fmu_files if alone else systems)
    add_system_options(parser)


def add_system_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("system options")
    use = group.add_argument(
        "--use", action="append", default=[], metavar="SLOT=FMU", help="put another FMU in a component's place"
    )
    completed(use, slots_with_fmus)
    sets = group.add_argument(
        "--parameters", action="append", default=[], metavar="F.ssv", help="apply a parameter set, by name or path"
    )
    completed(sets, parameter_sets)
    group.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="COMPONENT.VARIABLE=VALUE",
        help="set one parameter or input; in a batch LOW:HIGH:STEP sweeps it",
    )
    group.add_argument("--step", type=_seconds, metavar="H", help="communication step, s")
    group.add_argument("--stop-time", type=_seconds, metavar="T", help="end of the flight, s")
    group.add_argument(
        "--algorithm", choices=ALGORITHMS, help="how values are exchanged; default: as the system says, else sequential"
    )
    group.add_argument("--variant", metavar="NAME", help="another SSD of the archive")
    group.add_argument("--flavour", choices=FLAVOURS, help="which FMUs of this repository; default: native if built")
    group.add_argument(
        "--open-inputs", choices=OPEN_INPUTS, default=OPEN_INPUTS[0], help="inputs that nothing drives; default: refuse"
    )
    group.add_argument("--allow-unmatched", action="store_true", help="let parameters pass that match nothing")
    group.add_argument("--strict", action="store_true", help="refuse FMUs whose description breaks rules of FMI")
    for option, words in (
        ("--feedthrough", "its outputs depend directly on all inputs: it is stepped with those of the step's end"),
        ("--no-feedthrough", "its outputs depend directly on no input: it is stepped with those of the step's start"),
    ):
        group.add_argument(option, action="append", default=[], metavar="COMPONENT", help=words)


def add_faults(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--fault",
        action="append",
        default=[],
        metavar="FAULT",
        help=f"fly with a fault, COMPONENT.CONNECTOR=KIND[:VALUE]@T[..T]: {' or '.join(KINDS)} from T s on, or until T",
    )


def faults(options: argparse.Namespace) -> list[Fault]:
    """The faults of a parsed command line."""
    return [parse_fault(text) for text in options.fault]


def _seconds(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not a finite number of seconds")
    return value


def json_number(value: float | int | bool) -> float | int | bool | None:
    """A value as strict JSON can hold it."""
    return value if abs(value) < float("inf") else None


def pair(text: str, option: str, form: str) -> tuple[str, str]:
    """``NAME=VALUE`` split; raises InputError."""
    name, equals, value = text.partition("=")
    if not equals or not name.strip() or not value.strip():
        raise InputError(option, text, f"not of the form {form}", "write it so")
    return name.strip(), value.strip()


def pairs(texts: Sequence[str], option: str, form: str) -> dict[str, str]:
    """``NAME=VALUE`` of a repeated option by name; a name given twice is refused."""
    found: dict[str, str] = {}
    for text in texts:
        name, value = pair(text, option, form)
        if name in found:
            raise InputError(option, text, f"{name} is given twice", "give it once")
        found[name] = value
    return found


def system_options(options: argparse.Namespace) -> SystemOptions:
    """The system options of a parsed command line."""
    return SystemOptions(
        use=pairs(options.use, "--use", "SLOT=FMU"),
        parameters=tuple(options.parameters),
        set=pairs(options.set, "--set", "COMPONENT.VARIABLE=VALUE"),
        step=options.step,
        stop_time=options.stop_time,
        algorithm=options.algorithm,
        variant=options.variant,
        flavour=options.flavour,
        allow_unmatched=options.allow_unmatched,
        strict=options.strict,
        open_inputs=options.open_inputs,
        feedthrough=tuple(options.feedthrough),
        no_feedthrough=tuple(options.no_feedthrough),
    )


def check_json(options: argparse.Namespace) -> None:
    """Refuse a file for JSON that cannot be written, before anything flies. Raises InputError."""
    if options.json not in (None, "-"):
        check_file("--json", Path(options.json))


def write_json(document: Any, target: str | None, files: Results | None = None) -> bool:
    """Write a document as strict JSON; returns whether it went to standard output."""
    if target is None:
        return False
    text = json.dumps(document, indent=1, allow_nan=False) + "\n"
    if target == "-":
        sys.stdout.write(text)
        return True
    (files or Results()).write(Path(target), lambda path: write_atomically(path, text.encode()))
    return False


def tell(document: Any, options: argparse.Namespace, text: Callable[[], object], files: Results | None = None) -> int:
    """Print a result by ``text``, or its document as --json asks for, and where files are.

    Returns the exit status: 2 where a file could not be written, ``files`` included, else 0.
    """
    files = files or Results()
    if not write_json(document, options.json, files):
        text()
    if options.json != "-":
        files.say()
    return exit_status(files)
