"""Slots and transfers of a component of FMI 3.0; complete variables, contiguous if their representation is the same."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .....common.errors import InputError
from ...fmi.representations import TEXTS
from ...fmi.variable import ScalarVariable
from ...system.network import Network
from .exchanged import Exchanged
from .slots import Slots
from .transfers import ComponentTransfers, TransferTable, group_by_representation, needs_events, select_arrays


class TransferPlacing:
    """Assigns slots and transfers to components of FMI 3.0."""

    def __init__(self, network: Network, exchanged: Exchanged, slots: Slots, table: TransferTable) -> None:
        self._network = network
        self._exchanged = exchanged
        self._slots = slots
        self._table = table

    def place(
        self,
        component: str,
        transfers: ComponentTransfers,
        texts: Sequence[Sequence[tuple[Sequence[ScalarVariable], int]]],
    ) -> None:
        """Complete the transfers of a component with parameters that have been placed before.

        ``texts`` are its Strings and Binaries with their first rows, for inputs and for outputs.
        """
        network, exchanged = self._network, self._exchanged
        transfers.uses_events = needs_events(network, component)
        variables = network.fmus[component].variables.values()
        numbers = [variable for variable in variables if variable.type not in TEXTS]
        names = {variable.name: f"{component}.{variable.name}" for variable in numbers}
        driven = {short for short, name in names.items() if exchanged.is_set(name)}
        fetched = {short for short, name in names.items() if exchanged.is_fetched(name)}
        inputs = select_arrays((each for each in numbers if each.causality == "input"), driven)
        others = {each.array or each.name for each in numbers if names[each.name] in exchanged.other_sources}
        readable = (each for each in numbers if each.causality == "output" or (each.array or each.name) in others)
        outputs = select_arrays(readable, fetched)
        for is_discrete, target in ((False, transfers.inputs), (True, transfers.discrete)):
            mine = (each for each in inputs if (each.variability == "discrete") == is_discrete)
            target += [self._add(component, group, is_set=True) for group in group_by_representation(mine)]
        tuned = select_arrays((each for each in numbers if each.is_tunable), self._select_tuned(component, numbers))
        for group in group_by_representation(tuned):
            first = len(self._slots.references)
            (transfers.discrete if transfers.uses_events else transfers.inputs).append(
                self._add(component, group, is_set=True)
            )
            transfers.bases.append((first, len(group), self._slots.add_bases(component, group)))
        transfers.discrete += self._add_texts(texts[0])  # after the numeric transfers, whose rows must be consecutive
        transfers.outputs += [self._add(component, group) for group in group_by_representation(outputs)]
        transfers.outputs += self._add_texts(texts[1])
        named = {short for short, name in names.items() if name in exchanged.named and name not in self._slots.numbers}
        recorded = select_arrays((each for each in numbers if each.name in named), named)
        transfers.recorded += [self._add(component, group) for group in group_by_representation(recorded)]
        unfed = {each.name for each in inputs} - driven | {each.name for each in tuned} - self._select_tuned(
            component, numbers
        )
        self._slots.unfed |= {names[each] for each in unfed}

    def _select_tuned(self, component: str, variables: Sequence[ScalarVariable]) -> set[str]:
        return {each.name for each in variables if self._exchanged.is_tuned(component, each)}

    def _add_texts(self, texts: Sequence[tuple[Sequence[ScalarVariable], int]]) -> list[int]:
        return [self._table.add(group, first) for group, first in texts if group]

    def _add(self, component: str, group: Sequence[ScalarVariable], *, is_set: bool = False) -> int:
        slots, first = self._slots, len(self._slots.references)
        for number, variable in enumerate(group, first):
            name = f"{component}.{variable.name}"
            initial = np.nan
            if is_set:
                start = slots.settings.variables.get((component, variable.name), variable.start)
                if start is None and not self._exchanged.is_set(name):
                    problem = (
                        "has no connection, value or start, although other elements of its array do: FMI 3.0 "
                        "sets only complete arrays"
                    )
                    raise InputError(
                        self._network.file, name, problem, f"connect this element, or give `set` {name}=VALUE"
                    )
                initial = slots.start(component, variable)
                if variable.representation.is_wide and start is not None:
                    slots.exact[number] = int(start)
            slots.add(name, variable.reference, initial, variable.type, variable.unit)
        return self._table.add(group, first)
