"""A verb, declared once: its name, arguments, options and examples.

The declaration is read without what carries the verb out, so that help and completion are quick.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypedDict

from .system import JsonFile


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
    """Declaration of a verb, from which command line, signature and documentation derive.

    ``name`` is what the command line calls it (two words for those of a group). ``options`` are those of the Python
    function, too; ``files`` are those that only the command line has: where it writes the result. ``function`` is
    stated where it is not NAME.NAME. ``examples`` are commands with comments, ``not_met`` is what exit status 1 means
    in addition to an interruption. ``is_command_alone`` where Python has no use for it. ``objects`` are
    parameters of the Python function alone, which stand for several options, with their texts.
    """

    name: str
    text: str
    arguments: tuple[Argument, ...] = ()
    options: type = NoOptions
    files: type = JsonFile
    function: str = ""
    examples: Mapping[str, str] = field(default_factory=dict)
    not_met: str = ""
    is_command_alone: bool = False
    objects: Mapping[str, str] = field(default_factory=dict)

    @property
    def home(self) -> tuple[str, str]:
        """The module below `verbs`, and the function in it."""
        module, _, function = self.function.partition(".")
        return module or self.name, function or self.name
