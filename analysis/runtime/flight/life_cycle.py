"""The instances of a simulation from flight to flight: terminated, then reset or instantiated again."""

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
    """Permitted next calls of each instance, by the state machine of FMI 2.0 (co-simulation).

    Our own FMUs are terminated and reset by the loop itself after a flight without errors. Others are handled here:
    those whose reset cannot be trusted, and those that returned an error or discarded a step, which the trial of a
    reset need not have reached, are instantiated again. A flight is ended when the next one begins, since until then it
    can continue. ``note_subject`` is called with the number of each component before one of its functions is.
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
        self._running: AbstractSet[str] = set()  # initialised, so that they can be terminated
        self._broken: set[str] = set()  # returned an error
        self._discarded: set[str] = set()  # discarded a step, to end the simulation or not

    def note(self, outcome: Outcome, program: arrays.Program) -> None:
        """Remember how the loop has left the instances."""
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
        """Get the instances ready for a start; returns whether the loop is to terminate and reset them.

        Raises InputError where one cannot be instantiated again.
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
        for index, instance in ended:  # once all are freed: libraries without users are unloaded, with their state
            self._note_subject(index)
            instance.renew()
            self._readdress(index, instance)
        self._running = set()
        self._broken.clear()
        self._discarded.clear()
        self._fresh = True
        return False

    def _is_reset(self, name: str, instance: Instance) -> bool:
        """Return True if an instance has been reset, and is thereby as good as a new one."""
        sound = instance.fmu.is_self_contained or name not in self._broken | self._discarded
        if not instance.is_there or not self._terminate(name, instance) or not sound:
            return False
        if verdict_in_cache(instance.fmu) is None and instance.fmu.is_alone:
            instance.free()  # the trial needs its place
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
        """End an instance's flight, if it has one that can be ended; returns whether all went well."""
        if name in self._running:
            self._running = self._running - {name}
            try:
                instance.slave.terminate()
            except FMICallException:
                return False
        return True

    def _readdress(self, index: int, instance: Instance) -> None:
        """Let the program call the new instance of a component."""
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
        """End all flights and free the instances, but for those of the FMU whose digest is ``fatal``.

        After fmi2Fatal no instance of it may be used again, nor freed (FMI 2.0).
        """
        for index, (name, instance) in enumerate(self._instances.items()):
            self._note_subject(index)
            if instance.fmu.digest == fatal:
                instance.abandon()
            else:
                self._terminate(name, instance)
                instance.free()
