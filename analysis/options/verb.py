"""A verb, declared once: its name, arguments and options; and the Python function that carries it out.

The declaration is read without what carries the verb out, so that help and completion are quick.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypedDict, TypeVar

from ...common.errors import suggestion
from .option import defaults_of, options_of
from .system import JsonFile
from .values import check_value


class NoOptions(TypedDict):
    """Options of a verb that has none"""


@dataclass(frozen=True)
class Argument:
    """A positional argument of a verb; on the command line a required option instead where ``is_option``.

    ``name`` is the parameter of the Python function. ``read`` converts its text, ``many`` takes one or more,
    ``optional`` none or one.
    """

    name: str
    metavar: str
    text: str
    completer: str = ""
    many: bool = False
    optional: bool = False
    is_option: bool = False
    read: Callable[[str], object] = str


@dataclass(frozen=True)
class Verb:
    """What the command line, the signature and the documentation need of a verb.

    ``name`` is what the command line calls it (two words for those of a group). ``options`` are those of the Python
    function, too; ``files`` are those that only the command line has: where it writes the result. ``function`` is
    stated where it is not NAME.NAME. ``examples`` are commands with comments, ``not_met`` is what exit status 1 means
    in addition to an interruption.
    """

    name: str
    text: str
    arguments: tuple[Argument, ...] = ()
    options: type = NoOptions
    files: type = JsonFile
    function: str = ""
    examples: Mapping[str, str] = field(default_factory=dict)
    not_met: str = ""

    @property
    def home(self) -> tuple[str, str]:
        """The module below `verbs`, and the function in it."""
        module, _, function = self.function.partition(".")
        return module or self.name, function or self.name


Function = TypeVar("Function", bound=Callable[..., object])


def verb(declared: Verb) -> Callable[[Function], Function]:
    """Give a Python function the options of a verb: its signature, defaults and checks.

    The function takes ``**options`` and gets all of them, those that are not given with their defaults. A keyword that
    the verb does not have raises TypeError, a value out of bounds InputError.
    """
    options = options_of(declared.options)

    def decorate(function: Function) -> Function:
        @functools.wraps(function)
        def call(*arguments: object, **given: object) -> object:
            named = {name: given.pop(name) for name in list(given) if name in positional}
            for keyword in given:
                if keyword not in options:
                    raise TypeError(f"{function.__name__}() has no option {keyword!r}; {suggestion(keyword, options)}")
            checked = {key: check_value(options[key], value) for key, value in given.items()}
            return function(*arguments, **named, **defaults_of(declared.options) | checked)

        own = [each for each in inspect.signature(function).parameters.values() if each.kind is not each.VAR_KEYWORD]
        positional = {each.name for each in own}
        keywords = [
            inspect.Parameter(
                name, inspect.Parameter.KEYWORD_ONLY, default=each.option.default, annotation=each.annotation
            )
            for name, each in options.items()
        ]
        result = inspect.signature(function).return_annotation
        call.__signature__ = inspect.Signature([*own, *keywords], return_annotation=result)  # type: ignore[attr-defined]
        return call  # type: ignore[return-value]

    return decorate
