"""Values of options as text: read from a command line, and written into one that is printed."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ...common.errors import InputError, suggestion
from .option import Declared, Kind


def read_value(declared: Declared, texts: Sequence[str]) -> object:
    """The value that the texts of a command line give an option; several where it is repeated. Raises InputError."""
    if declared.kind is Kind.PAIRS:
        return _read_pairs(declared, texts)
    if declared.kind is Kind.LIST:
        parts = [part for text in texts for part in (text.split(",") if declared.option.comma else (text,))]
        return tuple(_read_single(declared, declared.element, part) for part in parts)
    return _read_single(declared, declared.kind, texts[-1])


def _read_single(declared: Declared, kind: Kind, text: str) -> object:
    if kind in (Kind.NUMBER, Kind.INTEGER):
        return check_number(declared, _parse_number(declared, kind, text), text)
    return text


def _parse_number(declared: Declared, kind: Kind, text: str, name: str = "") -> float | int:
    try:
        return int(text) if kind is Kind.INTEGER else float(text)
    except ValueError:
        whole = "a whole number" if kind is Kind.INTEGER else f"a finite number{_of_unit(declared)}"
        element = ": ".join(part for part in (name, repr(text)) if part)
        raise InputError(f"`{declared.name}`", element, f"not {whole}", "give one") from None


def check_number(declared: Declared, value: float | int, text: str = "") -> float | int:
    """The number, if it is finite and within the bounds of its option. Raises InputError."""
    option, text = declared.option, text or f"{value:g}"
    if not math.isfinite(value):
        raise InputError(f"`{declared.name}`", repr(text), f"not a finite number{_of_unit(declared)}", "give one")
    if option.above is not None and value <= option.above:
        raise InputError(f"`{declared.name}`", text, f"not above {option.above:g}", "give a larger number")
    if option.minimum is not None and value < option.minimum:
        raise InputError(f"`{declared.name}`", text, f"below {option.minimum:g}", f"give {option.minimum:g} or more")
    if option.maximum is not None and value > option.maximum:
        raise InputError(f"`{declared.name}`", text, f"above {option.maximum:g}", f"give {option.maximum:g} or less")
    return value


def _of_unit(declared: Declared) -> str:
    return f" of {'seconds' if declared.option.unit == 's' else declared.option.unit}" if declared.option.unit else ""


def _read_pairs(declared: Declared, texts: Sequence[str]) -> dict[str, object]:
    """``NAME=VALUE`` of a repeated option by name, ``NAME=A,B`` as a list where it takes several; no name twice."""
    pairs: dict[str, object] = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals or not name.strip() or not value.strip():
            form = declared.option.metavar or declared.option.form
            raise InputError(f"`{declared.name}`", text, f"not of the form {form}", "write it so")
        if name.strip() in pairs:
            raise InputError(f"`{declared.name}`", text, f"{name.strip()} is given twice", "give it once")
        if declared.element is Kind.NUMBER:
            pairs[name.strip()] = _parse_number(declared, Kind.NUMBER, value.strip(), name.strip())
        else:
            several = [part.strip() for part in value.split(",")]
            pairs[name.strip()] = several if declared.option.comma else value.strip()
    return pairs


def check_value(declared: Declared, value: Any) -> object:
    """A value that a Python caller gives, as the function gets it. Raises InputError.

    None stands for the default; lists and mappings are copied, so that nobody changes them afterwards.
    """
    if value is None:
        return declared.option.default
    if declared.kind is Kind.LIST:
        if isinstance(value, str | os.PathLike):
            text = os.fspath(value)
            raise InputError(
                f"`{declared.name}`", text, "one name where a list is meant", f'give {declared.name}=["{text}"]'
            )
        for each in value if declared.choices else ():
            _check_choice(declared, each)
        return (value,) if isinstance(value, int | float) else tuple(value)
    if declared.kind is Kind.PAIRS and isinstance(value, Mapping):
        return dict(value)
    if declared.choices:
        _check_choice(declared, value)
    if declared.kind in (Kind.NUMBER, Kind.INTEGER) and isinstance(value, int | float):
        return check_number(declared, value)
    return value


def _check_choice(declared: Declared, value: object) -> None:
    if value not in declared.choices:
        raise InputError(f"`{declared.name}`", str(value), "no such choice", suggestion(str(value), declared.choices))


def value_texts(declared: Declared, value: Any) -> list[str]:
    """The text after each occurrence of the option's flag; for a flag without value one empty text."""
    if declared.kind is Kind.FLAG:
        return [""] if value else []
    if declared.kind is Kind.PAIRS:
        return [f"{name}={_text(each)}" for name, each in value.items()]
    if declared.kind is Kind.LIST:
        texts = [_text(each) for each in value]
        return [",".join(texts)] if declared.option.comma and texts else texts
    return [_text(value)]


def _text(value: object) -> str:
    """A value as the command line reads it back, to the last bit."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return repr(float(value))
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Iterable) and not isinstance(value, str):
        return ",".join(map(_text, value))
    return str(value)
