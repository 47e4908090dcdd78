"""Conversion of a verb's declaration to an argparse parser, and of its result to arguments of the Python function."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from .declaration import Argument, Verb
from .option import Declared, Kind, options_of
from .option_values import read_value
from .simulation_options import SHARED

Completer = Callable[..., Iterable[str]]  # type of argcomplete's completers
FindCompleter = Callable[[str], Completer]  # finds a completer by its declared name


def add_verb(parser: argparse.ArgumentParser, verb: Verb, find_completer: FindCompleter, *, is_complete: bool) -> None:
    """Add a verb's arguments and options, shared options last.

    ``is_complete`` includes the help texts of shared options.
    """
    parser.usage = f"{parser.prog} {' '.join(map(_usage, verb.arguments))} [OPTION ...]".replace("  ", " ")
    arguments = parser.add_argument_group("arguments")
    for argument in verb.arguments:
        _complete(_add_argument(arguments, argument), argument.completer, find_completer)
    options = [*options_of(verb.options).values(), *options_of(verb.files).values()]
    shared = {name: title for title, group in SHARED.items() for name in options_of(group)}
    sections: dict[str, list[Declared]] = {}
    for each in sorted(options, key=lambda each: each.name in shared):
        sections.setdefault(shared.get(each.name, "options"), []).append(each)
    for title, members in sections.items():
        is_explained = is_complete or title not in SHARED
        names = " ".join(f"--{each.flag}" for each in members)
        group = parser.add_argument_group(title, None if is_explained else f"{names} (explained by --help-all)")
        for each in members:
            _complete(_add_option(group, each, is_explained), each.option.completer, find_completer)


def _usage(argument: Argument) -> str:
    if argument.is_option:
        usage = f"--{argument.name} {argument.metavar}"
        return f"[{usage}]" if argument.optional else usage
    return f"[{argument.metavar}]" if argument.optional else f"{argument.metavar}{' ...' if argument.many else ''}"


def _add_argument(parser: argparse._ArgumentGroup, argument: Argument) -> argparse.Action:
    keywords: dict[str, Any] = {"metavar": argument.metavar, "help": argument.text}
    if argument.is_option:
        return parser.add_argument(f"--{argument.name}", required=not argument.optional, **keywords)
    nargs = "+" if argument.many else "?" if argument.optional else None
    return parser.add_argument(argument.name, nargs=nargs, **keywords)


def _add_option(group: argparse._ArgumentGroup, declared: Declared, is_explained: bool) -> argparse.Action:
    option = declared.option
    text = f"{option.text}{_default_text(declared)}" if is_explained else argparse.SUPPRESS
    if declared.kind is Kind.FLAG:
        return group.add_argument(f"--{declared.flag}", dest=declared.name, action="store_const", const=[""], help=text)
    action = group.add_argument(
        f"--{declared.flag}",
        dest=declared.name,
        action="append",
        metavar=option.metavar or _metavar(declared),
        help=text,
    )
    if declared.choices:
        action.choices = declared.choices
    return action


def _metavar(declared: Declared) -> str:
    if declared.choices:
        return f"{{{','.join(declared.choices)}}}"
    return {Kind.NUMBER: "X", Kind.INTEGER: "N", Kind.PAIRS: declared.option.form}.get(declared.kind, "TEXT")


def _default_text(declared: Declared) -> str:
    option = declared.option
    unit = f", {option.unit}" if option.unit and f", {option.unit}" not in option.text else ""
    if declared.kind in (Kind.LIST, Kind.PAIRS) and not option.comma:
        return f"{unit}; may be repeated"
    if option.default in (None, False) or declared.kind in (Kind.FLAG, Kind.LIST, Kind.PAIRS):
        return unit
    text = f"{option.default:g}" if isinstance(option.default, float) else option.default
    return f"{unit}; default: {text}"


def _complete(action: argparse.Action, completer: str, find_completer: FindCompleter) -> None:
    """Register a completer for an argument; its module is imported only when the shell asks for completions."""
    if completer:

        def offer(*arguments: Any, **keywords: Any) -> Any:
            return find_completer(completer)(*arguments, **keywords)

        vars(action)["completer"] = offer


def read_parsed(verb: Verb, parsed: argparse.Namespace) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
    """Return the arguments, function options and files of a parsed command line, each by name, without defaults.

    Raises InputError with the parameter's name.
    """
    arguments = {}
    for argument in verb.arguments:
        texts = getattr(parsed, argument.name)
        if texts is not None:
            arguments[argument.name] = (
                [argument.read(text) for text in texts] if argument.many else argument.read(texts)
            )
    return arguments, _read_group(verb.options, parsed), _read_group(verb.files, parsed)


def _read_group(group: type, parsed: argparse.Namespace) -> dict[str, Any]:
    values = {}
    for name, declared in options_of(group).items():
        texts = getattr(parsed, name)
        if texts is not None:
            values[name] = True if declared.kind is Kind.FLAG else read_value(declared, texts)
    return values


def flags_of(verb: Verb) -> Mapping[str, str]:
    """Return the command-line names of a verb's parameters by Python name."""
    flags = {
        argument.name: f"--{argument.name}" if argument.is_option else argument.metavar for argument in verb.arguments
    }
    for group in (verb.options, verb.files):
        flags |= {name: f"--{declared.flag}" for name, declared in options_of(group).items()}
    return flags
