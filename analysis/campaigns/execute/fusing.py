"""Decision whether to compile the steps of a batch, from the duration of its trials and the number that remains."""

from __future__ import annotations

import threading
import warnings

from ....common.errors import InputError
from ...runtime.flight.base_simulation import BaseSimulation

GAIN = 0.1  # share of a trial's time saved, in most shipped systems (benchmarks/one_fmu.py)
COMPILATION = 0.4  # s, of a component
MARGIN = 3.0  # how many times over compilation is to pay: a campaign may end early
_compiling = threading.Lock()  # one worker at a time, while the others go on


class Fusing:
    """Compiles the steps of one worker's simulations if it saves time and the user sets no flavour.

    Results have the same bits before and after. ``trials`` is the number of each variant's trials for all ``workers``
    together; if it is None, as many as have been simulated are expected to follow.
    """

    def __init__(self, flavour: str | None, trials: int | None, workers: int) -> None:
        self._trials = trials
        self._workers = workers
        self._is_open = flavour is None
        self._simulated: dict[str, int] = {}  # trials of each variant simulated by this worker
        self._decided: set[str] = set()  # variants

    def consider(self, variant: str, simulation: BaseSimulation, count: int, seconds: float) -> None:
        """Compile a variant's steps if it saves enough, where ``count`` of its trials took ``seconds``.

        Not after the first trials, whose duration includes loading the loop. Warns if the compiler rejects the steps;
        trials are then simulated as before.
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
                    return  # interrupted: the compiler has been ended
                warnings.warn(f"{variant}: steps are not compiled: {error.problem}", stacklevel=2)
            finally:
                _compiling.release()
