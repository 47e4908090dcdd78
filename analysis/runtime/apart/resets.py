"""Whether FMUs of others reset, tried in a child each, once per FMU and process."""

from __future__ import annotations

import os
from collections.abc import Mapping

from ..instances.reset_check import ResetVerdict, store_verdict, verdict_in_cache
from ..system.fmu import Fmu
from ..system.options import SystemOptions
from ..system.prepared import PreparedSystem
from .connection import ChildEndedError, Connection, Stillness
from .containment import limits_for
from .protocol import messages
from .servers import Subject, fork


def find_verdicts(prepared: PreparedSystem) -> Mapping[str, ResetVerdict]:
    """The verdicts on a system's foreign FMUs, by their SHA-256."""
    fmus = {fmu.digest: fmu for fmu in prepared.network.fmus.values() if not fmu.is_own}
    return {digest: find_verdict(fmu, prepared.options) for digest, fmu in fmus.items()}


def find_verdict(fmu: Fmu, options: SystemOptions) -> ResetVerdict:
    """Whether an FMU resets; one that ends its process in the trial does not. Raises InputError."""
    known = verdict_in_cache(fmu)
    if known is not None:
        return known
    child = fork(Subject(fmu, fmu), messages.ResetTrial(), folder=os.getcwd(), limits=limits_for([fmu], options))
    connection = Connection(child, lambda line: None, Stillness(lambda: None, options.call_timeout))
    try:
        answer = connection.hear(messages.Verdict)
        verdict = ResetVerdict(answer.resets, answer.reason)
    except ChildEndedError as error:
        verdict = ResetVerdict(False, f"when it was tried, {error.how}")
    finally:
        connection.close()
    store_verdict(fmu.digest, verdict)
    return verdict
