"""Instructions for a component of FMI 3.0, which transfer complete variables by type."""

from __future__ import annotations

from collections.abc import Iterable

from ...instances.fmu_library import FUNCTION_NAMES
from ...loop import codes
from .instruction_rows import InstructionRows
from .transfers import ComponentTransfers, TransferTable


def _mode(name: str) -> int:
    return FUNCTION_NAMES.index(f"fmi3{name}")


class Fmi3Orders:
    """Writer of the calls of one component."""

    def __init__(
        self, rows: InstructionRows, component: int, transfers: ComponentTransfers, table: TransferTable
    ) -> None:
        self._rows = rows
        self._component = component
        self._transfers = transfers
        self._table = table

    def reset_bases(self) -> None:
        """Reset the slots of parameters that change during simulation to their unchanged values."""
        for first, count, base in self._transfers.bases:
            self._rows.rows.append([codes.COPY, base, 0, first, count, self._component, 0])

    def set(self, begun: int, *, started: bool) -> None:
        """Set all inputs; once the simulation has ``started``, set discrete inputs in event mode if it is used."""
        events = self._transfers.discrete if started and self._transfers.uses_events else []
        for transfer in (*self._transfers.inputs, *self._transfers.discrete):
            self._rows.inject(self._table.slots(transfer))
            if transfer not in events:
                self._exchange(self._code(codes.SET_TRANSFER, codes.GIVE_TEXTS, transfer), codes.SETTERS, [transfer])
        if events:
            both = (events[0], len(events))
            self._rows.call(codes.SET_EVENTS, self._component, _mode("EnterEventMode"), both)

    def apply_input_faults(self) -> None:
        """Apply faults to the input slots without setting the inputs."""
        for transfer in (*self._transfers.inputs, *self._transfers.discrete):
            self._rows.inject(self._table.slots(transfer))

    def get(self) -> None:
        for transfer in self._transfers.outputs:
            self._exchange(self._code(codes.GET_TRANSFER, codes.TAKE_TEXTS, transfer), codes.GETTERS, [transfer])
            self._rows.inject(self._table.slots(transfer))

    def read(self) -> None:
        """Get the variables that are only recorded."""
        self._exchange(codes.READ_TRANSFER, codes.GETTERS, self._transfers.recorded)

    def step(self, count: int) -> None:
        self._rows.call(codes.STEP_TO_EVENTS, self._component, codes.DO_STEP, (int(self._transfers.uses_events), count))

    def reset(self) -> None:
        for name in ("Terminate", "Reset"):
            self._rows.call(codes.MODE, self._component, _mode(name))

    def enter_initialization(self) -> None:
        """Set structural parameters and parameters, enter initialisation mode, and set parameters again."""
        if self._transfers.structural:
            self._rows.call(codes.MODE, self._component, _mode("EnterConfigurationMode"))
            self._exchange(codes.GIVE_PARAMETERS, codes.SETTERS, self._transfers.structural)
            self._rows.call(codes.MODE, self._component, _mode("ExitConfigurationMode"))
        self._exchange(codes.GIVE_PARAMETERS, codes.SETTERS, self._transfers.before)
        self._rows.call(codes.ENTER_INITIALIZATION, self._component, _mode("EnterInitializationMode"))
        self._exchange(codes.GIVE_PARAMETERS, codes.SETTERS, self._transfers.repeated)

    def exit_initialization(self) -> None:
        """Leave initialisation mode for step mode, through event mode if the component uses it."""
        self._rows.call(codes.MODE, self._component, _mode("ExitInitializationMode"))
        if self._transfers.uses_events:
            self._rows.call(codes.SETTLE, self._component, codes.UPDATE_DISCRETE_STATES)

    def read_back(self) -> None:
        self._exchange(codes.TAKE_BACK, codes.GETTERS, self._transfers.back)

    def _code(self, of_numbers: int, of_texts: int, transfer: int) -> int:
        return of_texts if self._table.kind(transfer) >= codes.STRING else of_numbers

    def _exchange(self, code: int, functions: int, transfers: Iterable[int]) -> None:
        for transfer in transfers:
            self._rows.call(code, self._component, functions + self._table.kind(transfer), (transfer, 1))
