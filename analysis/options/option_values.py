"""Values of options as text: read from a command line, checked, and written into printed commands."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from numbers import Real
from typing import Any

from ...common.errors import InputError, suggestion
from .option import Declared, Kind, options_of


def read_value(declared: Declared, texts: Sequence[str]) -> object:
    """Return the value of an option from its texts on the command line, several if repeated. Raises InputError."""
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
        raise InputError(f"`{declared.name}`", element, f"not {whole}", f"give {whole}") from None


def check_number(declared: Declared, argument: float | int, text: str = "") -> float | int:
    """Return the number if it is finite and within the option's bounds. Raises InputError."""
    option, text = declared.option, text or f"{argument:g}"
    if not math.isfinite(argument):
        raise InputError(
            f"`{declared.name}`", repr(text), f"not a finite number{_of_unit(declared)}", "give a finite number"
        )
    if option.above is not None and argument <= option.above:
        raise InputError(f"`{declared.name}`", text, f"not above {option.above:g}", "give a larger number")
    if option.minimum is not None and argument < option.minimum:
        raise InputError(f"`{declared.name}`", text, f"below {option.minimum:g}", f"give {option.minimum:g} or more")
    if option.maximum is not None and argument > option.maximum:
        raise InputError(f"`{declared.name}`", text, f"above {option.maximum:g}", f"give {option.maximum:g} or less")
    return argument


def _of_unit(declared: Declared) -> str:
    return f" of {'seconds' if declared.option.unit == 's' else declared.option.unit}" if declared.option.unit else ""


def _read_pairs(declared: Declared, texts: Sequence[str]) -> dict[str, object]:
    """Read the texts ``NAME=VALUE`` of a repeated option; ``NAME=A,B`` is a list if the option allows commas.

    Raises InputError for a repeated name.
    """
    pairs: dict[str, object] = {}
    for text in texts:
        name, equals, argument = text.partition("=")
        if not equals or not name.strip() or not argument.strip():
            form = declared.option.metavar or declared.option.form
            raise InputError(f"`{declared.name}`", text, f"not of the form {form}", "use this form")
        if name.strip() in pairs:
            raise InputError(f"`{declared.name}`", text, f"{name.strip()} is given twice", "give each name once")
        if declared.element is Kind.NUMBER:
            pairs[name.strip()] = _parse_number(declared, Kind.NUMBER, argument.strip(), name.strip())
        else:
            several = [part.strip() for part in argument.split(",")]
            pairs[name.strip()] = several if declared.option.comma else argument.strip()
    return pairs


def check_value(declared: Declared, argument: Any) -> object:
    """Return the checked value of an option from a Python caller. Raises InputError.

    None stands for the default; lists and mappings are copied, so later changes by the caller have no effect.
    """
    if argument is None:
        return declared.option.default
    check = CHECKS.get(declared.kind)
    checked = argument if check is None else check(declared, argument)
    if declared.choices and declared.kind is not Kind.LIST:
        _check_choice(declared, argument)
    return checked


def _check_list(declared: Declared, argument: Any) -> tuple[object, ...]:
    if isinstance(argument, str | os.PathLike):
        text = os.fspath(argument)
        remedy = f'give {declared.name}=["{text}"]'
        raise InputError(f"`{declared.name}`", text, "a single name, but a list is needed", remedy)
    is_number = isinstance(argument, Real) and not isinstance(argument, bool)
    if is_number and declared.element in (Kind.NUMBER, Kind.INTEGER):
        return (argument,)
    if not isinstance(argument, Iterable) or isinstance(argument, Mapping):
        raise InputError(f"`{declared.name}`", repr(argument), "not a list", f"give {declared.name}=[...]")
    elements = tuple(argument)
    for each in elements if declared.choices else ():
        _check_choice(declared, each)
    return elements


def _check_pairs(declared: Declared, argument: Any) -> dict[str, object]:
    if not isinstance(argument, Mapping):
        name, _, text = str(argument).partition("=")
        example = f'give {declared.name}={{"{name}": {text if _is_number(text) else repr(text)}}}'
        remedy = example if text and isinstance(argument, str) else f"give {declared.name}={{NAME: VALUE, ...}}"
        raise InputError(f"`{declared.name}`", repr(argument), "not a dictionary", remedy)
    for name, each in argument.items():
        if declared.takes_paths and not isinstance(each, str | os.PathLike | list | tuple):
            raise InputError(
                f"`{declared.name}`",
                f"{name}: {each!r}",
                "neither a name nor a path",
                "give a name or a path in quotes",
            )
    return dict(argument)


def _check_number(declared: Declared, argument: Any) -> float | int:
    kind = declared.kind
    is_number = isinstance(argument, Real) and not isinstance(argument, bool)
    if not is_number or (kind is Kind.INTEGER and not float(argument).is_integer()):
        what = "a whole number" if kind is Kind.INTEGER else f"a number{_of_unit(declared)}"
        is_text = isinstance(argument, str) and _is_number(argument)
        remedy = f"give {declared.name}={argument}" if is_text else f"give {what}"
        raise InputError(f"`{declared.name}`", repr(argument), f"not {what}", remedy)
    return check_number(declared, int(argument) if kind is Kind.INTEGER else float(argument))


def _check_flag(declared: Declared, argument: Any) -> bool:
    if argument not in (True, False):
        raise InputError(f"`{declared.name}`", repr(argument), "neither True nor False", "give True or False")
    return bool(argument)


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


def _check_choice(declared: Declared, argument: object) -> None:
    if argument not in declared.choices:
        raise InputError(
            f"`{declared.name}`", str(argument), "no such choice", suggestion(str(argument), declared.choices)
        )


def complete_options(group: type, options: Mapping[str, Any]) -> dict[str, Any]:
    """Return all options of a group, checked, with defaults for omitted ones and paths as texts. Raises InputError."""
    return {name: _as_text(check_value(each, options.get(name))) for name, each in options_of(group).items()}


def _as_text(setting: object) -> object:
    if isinstance(setting, os.PathLike):
        return os.fspath(setting)
    if isinstance(setting, Mapping):
        return {name: _as_text(each) if isinstance(each, os.PathLike) else each for name, each in setting.items()}
    return tuple(map(_as_text, setting)) if isinstance(setting, tuple) else setting


def value_texts(declared: Declared, argument: Any) -> list[str]:
    """Return the text for each occurrence of the option's flag; an empty text for a flag without argument."""
    if declared.kind is Kind.FLAG:
        return [""] if argument else []
    if declared.kind is Kind.PAIRS:
        return [f"{name}={_text(each)}" for name, each in argument.items()]
    if declared.kind is Kind.LIST:
        texts = [_text(each) for each in argument]
        return [",".join(texts)] if declared.option.comma and texts else texts
    return [_text(argument)]


def _text(argument: object) -> str:
    """Return a value as text that the command line reads back exactly."""
    if isinstance(argument, bool):
        return str(argument).lower()
    if isinstance(argument, float):
        return repr(float(argument))
    if isinstance(argument, os.PathLike):
        return os.fspath(argument)
    if isinstance(argument, Iterable) and not isinstance(argument, str):
        return ",".join(map(_text, argument))
    return str(argument)
