"""Ways to restore foreign FMUs between simulations, tested in children, once in a process for each FMU."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping

from ....common.errors import InputError
from ..flight.results import CRASHED
from ..instances.renewal import Renewal, ResetVerdict, store_verdict, verdict_in_cache
from ..system.fmu import Fmu
from ..system.options import SystemOptions
from ..system.prepared import PreparedSystem
from . import messages
from .child_connection import ChildConnection, ChildEndedError, Watchdog
from .children import begin_child
from .restriction import limits_for

DIFFERS = "two processes simulate it with different results"
_noted: set[str] = set()  # digests of FMUs for which a warning was issued


class TrialWatch:
    """Handle with which another thread can end the tests of a system's FMUs."""

    def __init__(self) -> None:
        self._connection: ChildConnection | None = None
        self._why = ""

    @property
    def is_cancelled(self) -> bool:
        return bool(self._why)

    def begin(self, connection: ChildConnection) -> None:
        """Register the child of a test; end it at once if `cancel` was called before."""
        self._connection = connection
        if self._why:
            connection.abort(self._why)

    def cancel(self, why: str) -> None:
        """End the child of the current test, and the children of later tests."""
        self._why = why
        if self._connection is not None:
            self._connection.abort(why)


def find_verdicts(prepared: PreparedSystem, watch: TrialWatch) -> Mapping[str, ResetVerdict]:
    """Return the verdicts on FMUs that are not self-contained, by SHA-256.

    An FMU with a failed test gets a new process for each simulation; this verdict is not stored if ``watch`` was
    cancelled.
    """
    verdicts = {}
    for fmu in prepared.network.fmus.values():
        if not fmu.is_self_contained:
            try:
                verdicts[fmu.digest] = find_verdict(fmu, prepared.options, watch)
            except InputError as error:
                verdicts[fmu.digest] = ResetVerdict(Renewal.PROCESS, error.problem)
                if not watch.is_cancelled:
                    store_verdict(fmu.digest, verdicts[fmu.digest])
    return verdicts


def find_verdict(fmu: Fmu, options: SystemOptions, watch: TrialWatch | None = None) -> ResetVerdict:
    """Return the verdict on how to restore an FMU; the first call tests it in children.

    Raises InputError if the FMU cannot be instantiated, or if its process ends before the simulation with declared
    values is complete.
    """
    verdict = verdict_in_cache(fmu)
    if verdict is None:
        try:
            verdict = _Trials(fmu, options, watch or TrialWatch()).decide()
        except ChildEndedError as error:
            problem = f"its test alone, with its declared values, failed: {error.how}"
            raise InputError(
                fmu.label, fmu.name, problem, "repair the FMU; perilune run --log info shows its messages"
            ) from None
        store_verdict(fmu.digest, verdict)
    return verdict


def renewal_note(component: str, verdict: ResetVerdict) -> str | None:
    """Return a note on the cost of restoring a component, or None if its reset works."""
    match verdict.renewal:
        case Renewal.RESET:
            return None
        case Renewal.INSTANCE:
            return f"{component}: instantiated again for every simulation, since its reset fails: {verdict.reason}"
        case Renewal.PROCESS:
            return (
                f"{component}: one process per simulation, since a second simulation in the same process "
                f"differs: {verdict.reason}"
            )
        case Renewal.IRREPRODUCIBLE:
            return f"{component}: one process per simulation, but even then results differ: {verdict.reason}"


def warn_of_processes(prepared: PreparedSystem, cost: float) -> None:
    """Warn, once for each FMU, that every simulation needs a new process, which costs ``cost`` seconds."""
    for component, fmu in prepared.network.fmus.items():
        verdict = verdict_in_cache(fmu)
        if verdict is not None and verdict.needs_process and fmu.digest not in _noted:
            _noted.add(fmu.digest)
            warnings.warn(f"{fmu.label}: {renewal_note(component, verdict)}; {1e3 * cost:.0f} ms each", stacklevel=2)


class _Trials:
    """Tests of one FMU in children."""

    def __init__(self, fmu: Fmu, options: SystemOptions, watch: TrialWatch) -> None:
        self._fmu = fmu
        self._options = options
        self._watch = watch
        self._formats = True  # formats of messages, as in `SystemTask`
        self._digest = ""  # SHA-256 of the first simulation in a new process

    def decide(self) -> ResetVerdict:
        """Test a reset and a new instance in one process, then test if a second process gives the same results.

        If the process ends after the first simulation of the FMU, the reset fails, or, if the process was started
        without a reset, a new instance fails. Raises ChildEndedError if the process ends earlier.
        """
        verdict = self._try_formats()
        if not verdict.needs_process:
            return verdict
        first, connection = self._digest, self._begin(with_reset=False)
        try:
            self._digest = connection.receive(messages.DefaultsSimulated).digest
        finally:
            connection.kill()
        return (
            verdict if self._digest == first else ResetVerdict(Renewal.IRREPRODUCIBLE, f"{verdict.reason}; {DIFFERS}")
        )

    def _try_formats(self) -> ResetVerdict:
        try:
            return self._try(with_reset=True)
        except ChildEndedError as error:
            if error.status != CRASHED:
                raise
        self._formats = False  # a format without its arguments may have ended the process
        return self._try(with_reset=True)

    def _try(self, *, with_reset: bool) -> ResetVerdict:
        connection = self._begin(with_reset=with_reset)
        self._digest = ""
        try:
            self._digest = connection.receive(messages.DefaultsSimulated).digest
            answer = connection.receive(messages.ResetChecked)
            return ResetVerdict(Renewal(answer.renewal), answer.reason)
        except ChildEndedError as error:
            if not self._digest or self._watch.is_cancelled:
                raise
            reason = f"when its reset was tested, {error.how}"
        finally:
            connection.close()
        renewal = self._try(with_reset=False).renewal if with_reset else Renewal.PROCESS
        return ResetVerdict(renewal, reason)

    def _begin(self, *, with_reset: bool) -> ChildConnection:
        """Start a test in a child."""
        fmu, options = self._fmu, self._options
        task = messages.ResetTask(self._formats, with_reset)
        child = begin_child(fmu, task, folder=os.getcwd(), limits=limits_for([fmu], options))
        connection = ChildConnection(child, lambda line: None, Watchdog(lambda: None, options.limits["call_timeout"]))
        self._watch.begin(connection)
        return connection
