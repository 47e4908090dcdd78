"""Work of a cluster's worker, which stores files by hash in its folder and simulates portions of campaigns.

The campaign is restored from these files by the code that restores a campaign's folder.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from .....common.atomic import write_atomically
from ...definition.plan import BatchPlan
from ...folder.campaign_manifest import CONTENTS, store_contents
from ...folder.shard_files import DRAWS
from ...trials import TrialTable
from ..flyer import Flyer
from ..plan_manifest import restore
from .sent import Sent, identity, refuse_others
from .tasks import TrialSpan

FOLDER = "perilune"  # in the worker's folder, which dask removes
MOST_LOADED = 3  # most campaigns that stay loaded for the next task
_looking = threading.Lock()
_loaded: dict[str, _LoadedCampaign] = {}  # by key, most recently used last


class TaskHaltedError(RuntimeError):
    """Termination of simulations requested by the process that runs the campaign."""


@dataclass
class _LoadedCampaign:
    """Campaign loaded in this process: its plan, with idle and busy flyers, at most one for each thread."""

    plan: BatchPlan
    idle: list[Flyer] = field(default_factory=list)
    busy: list[Flyer] = field(default_factory=list)


def fly(sent: Sent, task: Sequence[TrialSpan]) -> list[tuple[TrialTable, float]]:
    """Simulate some trials; return the trials of each span, with the seconds they took without preparation.

    Raises InputError in a worker with another version of Perilune, since workers may join at any time.
    """
    from distributed import get_worker

    worker = get_worker()
    refuse_others(sent.identity, identity(), worker.address)
    folder = Path(worker.local_directory).absolute() / FOLDER
    simulated = []
    with _flyer(sent, folder) as flyer:
        for piece in task:
            flyer.simulation(piece.variant)
            began = time.perf_counter()
            try:
                trials = flyer.fly(piece.variant, piece.trials)
            except KeyboardInterrupt:  # it would end the worker
                raise TaskHaltedError(sent.key) from None
            simulated.append((trials, time.perf_counter() - began))
    return simulated


def halt(key: str) -> None:
    """End the running simulations of a campaign at their next communication points."""
    with _looking:
        loaded = _loaded.get(key)
        for flyer in loaded.busy if loaded is not None else ():
            flyer.interrupt()


@contextmanager
def _flyer(sent: Sent, folder: Path) -> Iterator[Flyer]:
    """Yield a flyer for exclusive use by this thread."""
    with _looking:
        loaded = _campaign(sent, folder)
        flyer = loaded.idle.pop() if loaded.idle else Flyer(loaded.plan, in_child=sent.in_child)
        loaded.busy.append(flyer)
    try:
        yield flyer
    finally:
        with _looking:
            loaded.busy.remove(flyer)
            if flyer.halted:
                flyer.close()
            else:
                loaded.idle.append(flyer)


def _campaign(sent: Sent, folder: Path) -> _LoadedCampaign:
    """Return the campaign as loaded in this process; close the oldest unused campaigns if too many are loaded."""
    if sent.key in _loaded:
        _loaded[sent.key] = _loaded.pop(sent.key)
        return _loaded[sent.key]
    store_contents(folder / CONTENTS, dict(sent.contents))
    own = folder / sent.key
    if sent.draws:
        write_atomically(own / DRAWS, sent.draws)
    plan = restore(folder, sent.manifest, sent.log, draws=own)
    free = [key for key, loaded in _loaded.items() if not loaded.busy]
    for key in free[: max(0, len(free) + 1 - MOST_LOADED)]:
        for flyer in _loaded.pop(key).idle:
            flyer.close()
    _loaded[sent.key] = _LoadedCampaign(plan)
    return _loaded[sent.key]
