"""Writer of command lines and records, which contain only the options that differ from their defaults."""

from __future__ import annotations

import os
import shlex
from collections.abc import Mapping, Sequence
from typing import Any

from .declaration import Verb
from .option import options_of
from .option_values import value_texts


def write_command(verb: Verb, arguments: Mapping[str, Any], options: Mapping[str, object]) -> str:
    """Return the command line that calls a verb with these arguments and options, without default values."""
    words = ["perilune", *verb.name.split()]
    for argument in verb.arguments:
        passed = arguments.get(argument.name)
        texts = [] if passed is None else [_argument_text(each) for each in (passed if argument.many else [passed])]
        words += [f"--{argument.name}", *texts] if argument.is_option and texts else texts
    declared = {**options_of(verb.options), **options_of(verb.files)}
    for name, value in options.items():
        each = declared[name]
        if _is_default(value, each.option.default):
            continue
        for text in value_texts(each, value):
            flag = f"--{each.flag}"
            # with an equals sign, a text that begins with a dash is read as a value
            words += [flag] if not text else [f"{flag}={text}"] if text[0] == "-" else [flag, text]
    return shlex.join(words)


def _argument_text(value: object) -> str:
    return os.fspath(value) if isinstance(value, os.PathLike) else str(value)


def _is_default(value: object, default: object) -> bool:
    if isinstance(value, Sequence | Mapping) and not isinstance(value, str):
        return not value and not default
    return value is None or (type(value) is type(default) and value == default)


def record_options(group: type, options: Mapping[str, object]) -> dict[str, object]:
    """Return the options that differ from their defaults as JSON values, for manifests and documents."""
    known = options_of(group)
    return {
        name: _plain(value)
        for name, value in options.items()
        if name in known and not _is_default(value, known[name].option.default)
    }


def _plain(value: object) -> object:
    if isinstance(value, Mapping):
        return {name: _plain(each) for name, each in value.items()}
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_plain(each) for each in value]
    return value if isinstance(value, str | int | float | bool) or value is None else str(value)
