"""Decorator of the Python functions of verbs: signature, checks, defaults and docstring from the declaration."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from typing import TypeVar

from ...common.errors import suggestion
from .declaration import Verb
from .docstring import document_verb
from .option import defaults_of, options_of
from .option_values import check_value

Function = TypeVar("Function", bound=Callable[..., object])


def verb(declared: Verb) -> Callable[[Function], Function]:
    """Return a decorator that gives a function a verb's signature, defaults, checks and docstring.

    The function accepts ``**options`` and receives all of them, with defaults for omitted ones. An unknown keyword
    raises TypeError, and a value out of bounds raises InputError.
    """
    options = options_of(declared.options)

    def decorate(function: Function) -> Function:
        @functools.wraps(function)
        def call(*arguments: object, **passed: object) -> object:
            named = {name: passed.pop(name) for name in list(passed) if name in positional}
            for keyword in passed:
                if keyword not in options:
                    raise TypeError(f"{function.__name__}() has no option {keyword!r}; {suggestion(keyword, options)}")
            checked = {key: check_value(options[key], value) for key, value in passed.items()}
            return function(*arguments, **named, **defaults_of(declared.options) | checked)

        direct = [each for each in inspect.signature(function).parameters.values() if each.kind is not each.VAR_KEYWORD]
        positional = {each.name for each in direct}
        keywords = [
            inspect.Parameter(
                name, inspect.Parameter.KEYWORD_ONLY, default=each.option.default, annotation=each.annotation
            )
            for name, each in options.items()
        ]
        result = inspect.signature(function).return_annotation
        call.__doc__ = document_verb(declared, inspect.getdoc(function) or "", [each.name for each in direct])
        call.__signature__ = inspect.Signature([*direct, *keywords], return_annotation=result)  # type: ignore[attr-defined]
        return call  # type: ignore[return-value]

    return decorate
