"""When the steps of a batch are worth compiling: judged by how long its trials take, and how many are left."""

from __future__ import annotations

import threading
import warnings

from ...common.errors import InputError
from ...runtime.flight.base_simulation import BaseSimulation
from ..spec.plan import BatchPlan

GAIN = 0.1  # of a trial's time, in most shipped systems (benchmarks/one_fmu.py)
COMPILATION = 0.4  # s, of a component
MARGIN = 3.0  # how many times over compilation is to pay: a campaign may end early
_compiling = threading.Lock()  # one worker at a time, while the others go on


class Fusing:
    """Compiles the steps of one worker's simulations where that pays and the user gives no flavour.

    Results have the same bits before and after.
    """

    def __init__(self, plan: BatchPlan) -> None:
        self._trials = plan.campaign.trials
        self._is_open = plan.options.flavour is None
        self._decided: set[str] = set()  # variants

    def consider(self, variant: str, simulation: BaseSimulation, last: range, seconds: float) -> None:
        """Compile the steps of a variant whose trials ``last`` have taken so long (s), if those left save enough.

        Warns where the compiler refuses them; then trials are simulated as before.
        """
        if not self._is_open or variant in self._decided:
            return
        saved = GAIN * (self._trials - last.stop) * seconds / len(last)
        if saved < MARGIN * COMPILATION * len(simulation.prepared.network.fmus):
            return
        if _compiling.acquire(blocking=False):
            try:
                self._decided.add(variant)
                simulation.fuse()
            except InputError as error:
                warnings.warn(f"{variant}: steps are not compiled: {error.problem}", stacklevel=2)
            finally:
                _compiling.release()
