"""Whether FMUs of others reset, tried in a child each, once per FMU and process."""

from __future__ import annotations

import os
from collections.abc import Mapping

from ...common.errors import InputError
from ..flight.results import CRASHED
from ..instances.reset_check import ResetVerdict, store_verdict, verdict_in_cache
from ..system.fmu import Fmu
from ..system.options import SystemOptions
from ..system.prepared import PreparedSystem
from .connection import ChildEndedError, Connection, Stillness
from .containment import limits_for
from .protocol import messages
from .servers import Subject, begin_child


class TrialWatch:
    """The trials of one system's FMUs, which another thread can end."""

    def __init__(self) -> None:
        self._connection: Connection | None = None
        self._why = ""

    @property
    def is_given_up(self) -> bool:
        return bool(self._why)

    def begin(self, connection: Connection) -> None:
        """A trial begins, which ends at once after `give_up`."""
        self._connection = connection
        if self._why:
            connection.give_up(self._why)

    def give_up(self, why: str) -> None:
        """End the child of the trial that is under way, and of those that follow."""
        self._why = why
        if self._connection is not None:
            self._connection.give_up(why)


def find_verdicts(prepared: PreparedSystem, watch: TrialWatch) -> Mapping[str, ResetVerdict]:
    """The verdicts on FMUs that are not self-contained, by their SHA-256.

    No reset is trusted of an FMU that cannot be tried, or where the ``watch`` is given up; the latter is no verdict for
    other simulations.
    """
    verdicts = {}
    for fmu in prepared.network.fmus.values():
        if not fmu.is_self_contained:
            try:
                verdicts[fmu.digest] = find_verdict(fmu, prepared.options, watch)
            except InputError as error:
                verdicts[fmu.digest] = ResetVerdict(False, error.problem)
                if not watch.is_given_up:
                    store_verdict(fmu.digest, verdicts[fmu.digest])
    return verdicts


def find_verdict(fmu: Fmu, options: SystemOptions, watch: TrialWatch | None = None) -> ResetVerdict:
    """Whether an FMU resets; one that ends its process in the trial does not.

    Raises InputError where it cannot be instantiated, or ends its process before it has flown with its declared values.
    """
    verdict = verdict_in_cache(fmu)
    if verdict is None:
        try:
            verdict = _try_twice(fmu, options, watch or TrialWatch())
        except ChildEndedError as error:
            problem = f"tried alone, with its declared values: {error.how}"
            raise InputError(
                fmu.label, fmu.name, problem, "mend it; perilune run --log info shows what it logs"
            ) from None
        store_verdict(fmu.digest, verdict)
    return verdict


def _try_twice(fmu: Fmu, options: SystemOptions, watch: TrialWatch) -> ResetVerdict:
    try:
        return _try(fmu, options, watch, formats=True)
    except ChildEndedError as error:
        if error.status != CRASHED:
            raise
    # A message that is a format without its arguments may have ended it.
    return _try(fmu, options, watch, formats=False)


def _try(fmu: Fmu, options: SystemOptions, watch: TrialWatch, *, formats: bool) -> ResetVerdict:
    """A trial in a child of its own; ``formats`` are as in `SystemFlights`.

    Raises ChildEndedError where it ends before the FMU has flown with its declared values.
    """
    task = messages.ResetTrial(formats)
    child = begin_child(Subject(fmu, fmu), task, folder=os.getcwd(), limits=limits_for([fmu], options))
    connection = Connection(child, lambda line: None, Stillness(lambda: None, options.call_timeout))
    watch.begin(connection)
    has_flown = False
    try:
        answer = connection.hear(messages.Verdict)
        if not answer.is_final:
            has_flown = True
            answer = connection.hear(messages.Verdict)
    except ChildEndedError as error:
        if not has_flown or watch.is_given_up:
            raise
        return ResetVerdict(False, f"when it was tried, {error.how}")
    finally:
        connection.close()
    return ResetVerdict(answer.resets, answer.reason)
