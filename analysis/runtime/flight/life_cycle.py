"""Life cycle of FMU instances between simulations: terminated, then reset or instantiated again."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from collections.abc import Set as AbstractSet

import numpy as np
from fmpy.fmi1 import FMICallException

from ..instances.instance import Instance
from ..instances.renewal import Renewal, ResetVerdict, store_verdict, verdict_in_cache
from ..instances.reset_check import reset_verdict
from ..loop import arrays, codes
from .endings import Outcome, check_initialisation
from .instructions import InstructionList


class LifeCycle:
    """States of all instances in the state machine of FMI 2.0 co-simulation, and the calls that they permit.

    After a simulation without errors the loop terminates and resets Perilune's FMUs itself. All other cases are handled
    here. An FMU is instantiated again if its reset is not trusted, or if it returned an error or discarded a step,
    since the test of its reset may not have covered that state. Instances are terminated only when the next simulation
    begins, because the current one may still be continued. ``note_subject`` is called with the number of a component
    before any of its functions is called.
    """

    def __init__(
        self,
        instances: Mapping[str, Instance],
        program: arrays.Program,
        fmi3: arrays.Fmi3 | None,
        instructions: InstructionList,
        note_subject: Callable[[int], None],
    ) -> None:
        self._instances = instances
        self._program = program
        self._fmi3 = fmi3
        self._instructions = instructions
        self._note_subject = note_subject
        self.are_self_contained = all(instance.fmu.is_self_contained for instance in instances.values())
        self._fresh = True
        self._running: AbstractSet[str] = set()  # initialised, and can be terminated
        self._broken: set[str] = set()  # returned an error
        self._discarded: set[str] = set()  # discarded a step, whether or not to end the simulation

    def note(self, outcome: Outcome, program: arrays.Program) -> None:
        """Record the states in which the loop left the instances."""
        self._fresh = False
        if outcome.is_well and not self._broken:
            self._running = self._instances.keys()
            return
        names = list(self._instances)
        reached = check_initialisation(outcome, program, len(names))
        self._running = {name for name, running in zip(names, reached, strict=True) if running} - self._broken
        if outcome.is_error:
            self._broken.add(names[outcome.subject])
            self._running -= self._broken
        if outcome.is_discarded_step:
            self._discarded.add(names[outcome.subject])

    def make_ready(self) -> bool:
        """Prepare the instances for a start; return True if the loop must terminate and reset them itself.

        Raises InputError if an FMU cannot be instantiated again.
        """
        if self._fresh:
            return False
        if self.are_self_contained and len(self._running) == len(self._instances):
            self._running = set()
            return True
        ended = []
        for index, (name, instance) in enumerate(self._instances.items()):
            self._note_subject(index)
            if not self._is_reset(name, instance):
                instance.free()
                ended.append((index, instance))
        for (
            index,
            instance,
        ) in ended:  # only after all are freed: a library without instances is unloaded, with its state
            self._note_subject(index)
            instance.renew()
            self._readdress(index, instance)
        self._running = set()
        self._broken.clear()
        self._discarded.clear()
        self._fresh = True
        return False

    def _is_reset(self, name: str, instance: Instance) -> bool:
        """Reset an instance if its reset is trusted, and return True on success."""
        sound = instance.fmu.is_self_contained or name not in self._broken | self._discarded
        if not instance.is_there or not self._terminate(name, instance) or not sound:
            return False
        if verdict_in_cache(instance.fmu) is None and instance.fmu.is_alone:
            instance.free()  # makes room for the test, since its process permits only one instance
        if not reset_verdict(instance.fmu).resets or not instance.is_there:
            return False
        try:
            instance.slave.reset()
        except FMICallException as error:
            store_verdict(
                instance.fmu.digest, ResetVerdict(Renewal.INSTANCE, f"fmi2Reset returned status {error.status}")
            )
            return False
        return True

    def _terminate(self, name: str, instance: Instance) -> bool:
        """Terminate an instance if it is initialised; return False if its FMU reports an error."""
        if name in self._running:
            self._running = self._running - {name}
            try:
                instance.slave.terminate()
            except FMICallException:
                return False
        return True

    def _readdress(self, index: int, instance: Instance) -> None:
        """Replace the addresses of a component's former instance in the program by addresses of its new instance."""
        rows = self._program.instructions
        calls = (rows[:, codes.INSTANCE] != 0) & (rows[:, codes.COMPONENT] == index)
        in_memory = calls & np.isin(rows[:, codes.CODE], codes.IN_MEMORY)
        calls &= ~in_memory
        addresses = instance.function_addresses()
        rows[in_memory, codes.ADDRESS] += np.uint64(instance.address) - rows[in_memory, codes.INSTANCE]
        rows[calls | in_memory, codes.INSTANCE] = instance.address
        rows[calls, codes.ADDRESS] = [addresses[function] for function in rows[calls, codes.FUNCTION]]
        if self._fmi3 is not None:
            self._fmi3.transfers.functions[index] = addresses
        self._instructions.addresses[index] = (instance.address, addresses)

    def close(self, fatal: str | None = None) -> None:
        """Terminate and free all instances, except instances of the FMU with the digest ``fatal``.

        After fmi2Fatal no instance of an FMU may be used or freed (FMI 2.0).
        """
        for index, (name, instance) in enumerate(self._instances.items()):
            self._note_subject(index)
            if instance.fmu.digest == fatal:
                instance.abandon()
            else:
                self._terminate(name, instance)
                instance.free()
