"""Decision on compiling the steps of a batch, from the duration of its trials and the number of remaining trials."""

from __future__ import annotations

import threading
import warnings

from ....common.errors import InputError
from ...runtime.flight.base_simulation import BaseSimulation

GAIN = 0.1  # fraction of a trial's time that is saved in most shipped systems (benchmarks/one_fmu.py)
COMPILATION = 0.4  # s, time to compile a component
MARGIN = 3.0  # least ratio of saved time to compilation time, since a campaign may end early
_compiling = threading.Lock()  # one worker compiles at a time; the others continue


class Fusing:
    """Compiles the steps of one worker's simulations if this saves time and the user sets no flavour.

    Results have the same bits before and after. ``trials`` is the number of each variant's trials for all ``workers``
    together. If it is None, the number of remaining trials is assumed to equal the number of simulated ones.
    """

    def __init__(self, flavour: str | None, trials: int | None, workers: int) -> None:
        self._trials = trials
        self._workers = workers
        self._is_open = flavour is None
        self._simulated: dict[str, int] = {}  # trials of each variant simulated by this worker
        self._decided: set[str] = set()  # variants

    def consider(self, variant: str, simulation: BaseSimulation, count: int, seconds: float) -> None:
        """Compile a variant's steps if this saves enough time, after ``count`` of its trials took ``seconds``.

        The first call for a variant is ignored, since its duration includes loading the loop. Warns if the compiler
        rejects the steps; trials are then simulated as before.
        """
        if not self._is_open or variant in self._decided:
            return
        is_first = variant not in self._simulated
        self._simulated[variant] = self._simulated.get(variant, 0) + count
        if is_first:
            return
        simulated = self._simulated[variant] * self._workers
        left = simulated if self._trials is None else self._trials - simulated
        saved = GAIN * left * seconds / count
        if saved < MARGIN * COMPILATION * len(simulation.prepared.network.fmus):
            return
        if _compiling.acquire(blocking=False):
            try:
                self._decided.add(variant)
                simulation.fuse()
            except InputError as error:
                if simulation.recorder.halt[0]:
                    return  # an interruption ended the compiler
                warnings.warn(f"{variant}: steps are not compiled: {error.problem}", stacklevel=2)
            finally:
                _compiling.release()
