"""Declaration of a verb: name, arguments, options and examples.

Declarations do not import the code of their verbs, which keeps help and completion fast.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypedDict

from .simulation_options import JsonFile


class NoOptions(TypedDict):
    """Options of a verb that has none"""


@dataclass(frozen=True)
class Argument:
    """A positional argument of a verb, or with ``is_option`` a required option of the command line.

    ``name`` is the parameter of the Python function, and ``read`` converts the text. ``many`` accepts one or more
    values, ``optional`` accepts at most one.
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

    - ``name``: name on the command line, two words for a verb of a group.
    - ``options``: options of the command line and of the Python function.
    - ``files``: output files, options of the command line only.
    - ``function``: the Python function, if it is not NAME.NAME.
    - ``examples``: commands with comments.
    - ``not_met``: meaning of exit status 1, apart from an interruption.
    - ``is_command_alone``: True for a verb without a Python function.
    - ``objects``: parameters of the Python function only, with their texts; each replaces several options.
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
