"""Ports: what is connected, declared once for the outputs that give it and the inputs that take it; statuses."""

from __future__ import annotations

from typing import Any, ClassVar

from .variables import Input, Output, Parameter, State


class Port:
    """Start, unit, frame, bounds and description of a quantity, from which blocks declare their variables.

    A variable may have a start, a description or bounds of its own; what it is and its unit are the port's.
    """

    def __init__(self, start: Any, **declaration: Any) -> None:
        self.start = start
        self.declaration = declaration

    def input(self, description: str | None = None, *, start: Any = None, **changes: Any) -> Input:
        """An input for it."""
        return Input(*self._start(start), **self._complete(description, changes))

    def output(
        self,
        description: str | None = None,
        *,
        start: Any = None,
        direct: bool | tuple[str, ...] = False,
        **changes: Any,
    ) -> Output:
        """An output of it."""
        return Output(*self._start(start), direct=direct, **self._complete(description, changes))

    def parameter(self, start: Any = None, description: str | None = None, **changes: Any) -> Parameter:
        """A parameter that sets it."""
        return Parameter(*self._start(start), **self._complete(description, changes))

    def state(self, description: str | None = None, *, start: Any = None, **changes: Any) -> State:
        """A state that keeps it."""
        return State(*self._start(start), **self._complete(description, changes))

    def _start(self, start: Any) -> tuple[Any]:
        return (self.start if start is None else start,)

    def _complete(self, description: str | None, changes: dict[str, Any]) -> dict[str, Any]:
        if description is not None:
            changes["description"] = description
        return {**self.declaration, **changes}


def outcome(meaning: str) -> int:
    """A member of a `Status`, and what it means."""
    member: Any = _Outcome(meaning)
    return member


class _Outcome:
    def __init__(self, meaning: str) -> None:
        self.meaning = meaning


class Status:
    """Outcomes of a block, numbered from 0 in the order of declaration; its output says which one it is.

    ``class SteeringStatus(Status)`` with ``GOOD = outcome("good")`` and so on: ``SteeringStatus.GOOD`` is the plain
    int 0, and ``SteeringStatus.output(direct=True)`` an Integer output from 0 to the last, described by their meanings.
    """

    meanings: ClassVar[tuple[str, ...]] = ()

    def __init_subclass__(cls) -> None:
        outcomes = {name: value for name, value in vars(cls).items() if isinstance(value, _Outcome)}
        cls.meanings = tuple(value.meaning for value in outcomes.values())
        for number, name in enumerate(outcomes):
            setattr(cls, name, number)

    @classmethod
    def description(cls) -> str:
        """``0 good, 1 limited``."""
        return ", ".join(f"{number} {meaning}" for number, meaning in enumerate(cls.meanings))

    @classmethod
    def output(cls, about: str = "", *, direct: bool | tuple[str, ...] = False) -> Output:
        """The output of a block, at first the first outcome; ``about`` says before the outcomes which one it is."""
        description = f"{about}: {cls.description()}" if about else cls.description()
        return Output(0, minimum=0, maximum=len(cls.meanings) - 1, direct=direct, description=description)
