"""Ports: quantities that blocks exchange, declared once for the outputs and inputs that connect them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .variables import Input, Output, Parameter, State


class Port:
    """Start, unit, frame, bounds and description of a quantity, from which blocks declare their variables.

    A variable may differ from its port in start, description and bounds, but not in quantity and unit.
    """

    def __init__(self, start: Any, **declaration: Any) -> None:
        self.start = start
        self.declaration = declaration

    if TYPE_CHECKING:  # in a block, a bundle holds plain values under the names of its ports

        def __get__(self, instance: object, owner: type | None = None) -> Any: ...

        def __set__(self, instance: object, value: Any) -> None: ...

    def input(self, description: str | None = None, *, start: Any = None, **changes: Any) -> Input:
        """Return an input of this quantity."""
        return Input(*self._start(start), **self._complete(description, changes))

    def output(
        self,
        description: str | None = None,
        *,
        start: Any = None,
        direct: bool | tuple[str, ...] = False,
        **changes: Any,
    ) -> Output:
        """Return an output of this quantity."""
        return Output(*self._start(start), direct=direct, **self._complete(description, changes))

    def parameter(self, start: Any = None, description: str | None = None, **changes: Any) -> Parameter:
        """Return a parameter of this quantity."""
        return Parameter(*self._start(start), **self._complete(description, changes))

    def state(self, description: str | None = None, *, start: Any = None, **changes: Any) -> State:
        """Return a state of this quantity."""
        return State(*self._start(start), **self._complete(description, changes))

    def _start(self, start: Any) -> tuple[Any]:
        return (self.start if start is None else start,)

    def _complete(self, description: str | None, changes: dict[str, Any]) -> dict[str, Any]:
        if description is not None:
            changes["description"] = description
        return {**self.declaration, **changes}
