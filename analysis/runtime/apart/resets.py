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


def find_verdicts(prepared: PreparedSystem) -> Mapping[str, ResetVerdict]:
    """The verdicts on a system's foreign FMUs, by their SHA-256; no reset is trusted of one that cannot be tried."""
    verdicts = {}
    for fmu in prepared.network.fmus.values():
        if not fmu.is_own:
            try:
                verdicts[fmu.digest] = find_verdict(fmu, prepared.options)
            except InputError as error:
                verdicts[fmu.digest] = ResetVerdict(False, error.problem)
                store_verdict(fmu.digest, verdicts[fmu.digest])
    return verdicts


def find_verdict(fmu: Fmu, options: SystemOptions) -> ResetVerdict:
    """Whether an FMU resets; one that ends its process in the trial does not.

    Raises InputError where it cannot be instantiated, or ends its process before it has flown with its declared values.
    """
    verdict = verdict_in_cache(fmu)
    if verdict is None:
        try:
            verdict = _try_twice(fmu, options)
        except ChildEndedError as error:
            problem = f"tried alone, with its declared values: {error.how}"
            raise InputError(
                fmu.label, fmu.name, problem, "mend it; perilune run --log info shows what it logs"
            ) from None
        store_verdict(fmu.digest, verdict)
    return verdict


def _try_twice(fmu: Fmu, options: SystemOptions) -> ResetVerdict:
    try:
        return _try(fmu, options, formats=True)
    except ChildEndedError as error:
        if error.status != CRASHED:
            raise
    return _try(fmu, options, formats=False)  # a message that is a format without its arguments may have ended it


def _try(fmu: Fmu, options: SystemOptions, *, formats: bool) -> ResetVerdict:
    """A trial in a child of its own; ``formats`` are as in `SystemFlights`.

    Raises ChildEndedError where it ends before the FMU has flown with its declared values.
    """
    task = messages.ResetTrial(formats)
    child = begin_child(Subject(fmu, fmu), task, folder=os.getcwd(), limits=limits_for([fmu], options))
    connection = Connection(child, lambda line: None, Stillness(lambda: None, options.call_timeout))
    has_flown = False
    try:
        answer = connection.hear(messages.Verdict)
        if not answer.is_final:
            has_flown = True
            answer = connection.hear(messages.Verdict)
    except ChildEndedError as error:
        if not has_flown:
            raise
        return ResetVerdict(False, f"when it was tried, {error.how}")
    finally:
        connection.close()
    return ResetVerdict(answer.resets, answer.reason)
