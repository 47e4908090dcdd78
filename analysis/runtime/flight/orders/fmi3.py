"""The instructions for a component of FMI 3.0: pieces of whole variables by type."""

from __future__ import annotations

from collections.abc import Iterable

from ...instances.library import FUNCTION_NAMES
from ..compiled import codes
from ..compiled.fmi3 import DO_STEP, GETTERS, SETTERS, UPDATE_DISCRETE_STATES
from .pieces import ComponentPieces, PieceTable
from .rows import Rows


def _mode(name: str) -> int:
    return FUNCTION_NAMES.index(f"fmi3{name}")


class Fmi3Orders:
    """Writes the calls of one component to a list of instructions."""

    def __init__(self, rows: Rows, component: int, pieces: ComponentPieces, table: PieceTable) -> None:
        self._rows = rows
        self._component = component
        self._pieces = pieces
        self._table = table

    def set(self, begun: int, *, started: bool) -> None:
        """All inputs; discrete ones in event mode, if that is used and the flight has ``started``."""
        events = self._pieces.discrete if started and self._pieces.uses_events else []
        for piece in (*self._pieces.inputs, *self._pieces.discrete):
            self._rows.inject(self._table.slots(piece))
            if piece not in events:
                self._exchange(codes.SET_PIECE, SETTERS, [piece])
        if events:
            both = (events[0], len(events))
            self._rows.call(codes.SET_EVENTS, self._component, _mode("EnterEventMode"), both)

    def carry(self) -> None:
        """The faults on inputs that are not given."""
        for piece in (*self._pieces.inputs, *self._pieces.discrete):
            self._rows.inject(self._table.slots(piece))

    def get(self) -> None:
        for piece in self._pieces.outputs:
            self._exchange(codes.GET_PIECE, GETTERS, [piece])
            self._rows.inject(self._table.slots(piece))

    def read(self) -> None:
        """What is recorded only."""
        self._exchange(codes.READ_PIECE, GETTERS, self._pieces.recorded)

    def step(self, count: int) -> None:
        self._rows.call(codes.STEP_PIECES, self._component, DO_STEP, (int(self._pieces.uses_events), count))

    def reset(self) -> None:
        for name in ("Terminate", "Reset"):
            self._rows.call(codes.MODE, self._component, _mode(name))

    def enter_initialization(self) -> None:
        """Structure, parameters, initialisation mode, parameters."""
        if self._pieces.structural:
            self._rows.call(codes.MODE, self._component, _mode("EnterConfigurationMode"))
            self._exchange(codes.PIECE_PARAMETERS, SETTERS, self._pieces.structural)
            self._rows.call(codes.MODE, self._component, _mode("ExitConfigurationMode"))
        self._exchange(codes.PIECE_PARAMETERS, SETTERS, self._pieces.before)
        self._rows.call(codes.PIECE_SETUP, self._component, _mode("EnterInitializationMode"))
        self._exchange(codes.PIECE_PARAMETERS, SETTERS, self._pieces.again)

    def exit_initialization(self) -> None:
        """To step mode, by way of event mode where that is used."""
        self._rows.call(codes.MODE, self._component, _mode("ExitInitializationMode"))
        if self._pieces.uses_events:
            self._rows.call(codes.SETTLE, self._component, UPDATE_DISCRETE_STATES)

    def read_back(self) -> None:
        self._exchange(codes.PIECE_READ_BACK, GETTERS, self._pieces.back)

    def _exchange(self, code: int, functions: int, pieces: Iterable[int]) -> None:
        for piece in pieces:
            self._rows.call(code, self._component, functions + self._table.kind(piece), (piece, 1))
