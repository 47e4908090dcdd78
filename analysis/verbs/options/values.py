"""Values of options as text: read from a command line, and written into one that is printed."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from numbers import Real
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
    check = CHECKS.get(declared.kind)
    checked = value if check is None else check(declared, value)
    if declared.choices and declared.kind is not Kind.LIST:
        _check_choice(declared, value)
    return checked


def _check_list(declared: Declared, value: Any) -> tuple[object, ...]:
    if isinstance(value, str | os.PathLike):
        text = os.fspath(value)
        remedy = f'give {declared.name}=["{text}"]'
        raise InputError(f"`{declared.name}`", text, "one name where a list is meant", remedy)
    is_number = isinstance(value, Real) and not isinstance(value, bool)
    if is_number and declared.element in (Kind.NUMBER, Kind.INTEGER):
        return (value,)
    if not isinstance(value, Iterable) or isinstance(value, Mapping):
        raise InputError(f"`{declared.name}`", repr(value), "no list", f"give {declared.name}=[...]")
    elements = tuple(value)
    for each in elements if declared.choices else ():
        _check_choice(declared, each)
    return elements


def _check_pairs(declared: Declared, value: Any) -> dict[str, object]:
    if not isinstance(value, Mapping):
        name, _, text = str(value).partition("=")
        example = f'give {declared.name}={{"{name}": {text if _is_number(text) else repr(text)}}}'
        remedy = example if text and isinstance(value, str) else f"give {declared.name}={{NAME: VALUE, ...}}"
        raise InputError(f"`{declared.name}`", repr(value), "no dictionary", remedy)
    for name, each in value.items():
        if declared.takes_paths and not isinstance(each, str | os.PathLike | list | tuple):
            raise InputError(f"`{declared.name}`", f"{name}: {each!r}", "no name and no path", "give one, in quotes")
    return dict(value)


def _check_number(declared: Declared, value: Any) -> float | int:
    kind = declared.kind
    is_number = isinstance(value, Real) and not isinstance(value, bool)
    if not is_number or (kind is Kind.INTEGER and not float(value).is_integer()):
        what = "a whole number" if kind is Kind.INTEGER else f"a number{_of_unit(declared)}"
        is_text = isinstance(value, str) and _is_number(value)
        remedy = f"give {declared.name}={value}" if is_text else "give one"
        raise InputError(f"`{declared.name}`", repr(value), f"not {what}", remedy)
    return check_number(declared, int(value) if kind is Kind.INTEGER else float(value))


def _check_flag(declared: Declared, value: Any) -> bool:
    if value not in (True, False):
        raise InputError(f"`{declared.name}`", repr(value), "neither True nor False", "give one of them")
    return bool(value)


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


CHECKS: Mapping[Kind, Callable[[Declared, Any], object]] = {
    Kind.LIST: _check_list,
    Kind.PAIRS: _check_pairs,
    Kind.NUMBER: _check_number,
    Kind.INTEGER: _check_number,
    Kind.FLAG: _check_flag,
}


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
