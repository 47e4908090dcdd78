"""State that is no FMI variable: an object of a library, such as a simulation of another tool."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from .variables import DeclarationError, Variable


class ExternalState:
    """An object with state of its own: ``simulation = ExternalState("the plant as Basilisk simulates it")``.

    It is None until `initialize` assigns it, and again whenever the block is initialised or reset, so that no flight
    sees what another one left. An FMU with one can neither save nor restore its state, and flies in another process.
    """

    def __init__(self, description: str) -> None:
        self.description = description

    if TYPE_CHECKING:  # instances hold the object under the same name

        def __get__(self, instance: object, owner: type | None = None) -> Any: ...

        def __set__(self, instance: object, value: Any) -> None: ...


class HasExternalState:
    """What a block inherits that may declare `ExternalState`: their names, and that all of them can be dropped."""

    external: ClassVar[tuple[str, ...]] = ()
    python_only: ClassVar[bool]
    variables: ClassVar[dict[str, Variable]]

    @classmethod
    def collect_external(cls) -> None:
        """Note the names of all that is declared, in order. Raises DeclarationError."""
        names = [name for owner in reversed(cls.__mro__) for name, each in vars(owner).items() if _is_external(each)]
        cls.external = tuple(dict.fromkeys(names))
        twice = next((name for name in names if name in cls.variables), None)
        if twice is not None:
            raise DeclarationError(f"{cls.__name__}.{twice}: an ExternalState and a variable; give one another name")
        if names and not cls.python_only:
            problem = "an ExternalState, which a native FMU cannot have"
            raise DeclarationError(f"{cls.__name__}.{names[0]}: {problem}; add python_only = True, or declare a State")

    def drop_external(self) -> None:
        """Let go of the objects, which are None from now on."""
        for name in self.external:
            setattr(self, name, None)


def _is_external(attribute: object) -> bool:
    return isinstance(attribute, ExternalState)
