"""Work of a cluster's worker: it keeps files by hash in its folder, and simulates portions of campaigns.

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
from ...folder.files import DRAWS
from ...folder.manifest import CONTENTS, store_contents
from ...trials import TrialTable
from ..flyer import Flyer
from ..plan_manifest import restore
from .sent import Sent, identity, refuse_others
from .tasks import Piece

FOLDER = "perilune"  # within the worker's own, which dask removes
MOST_LOADED = 3  # campaigns whose simulations are kept for the next task
_looking = threading.Lock()
_loaded: dict[str, _LoadedCampaign] = {}  # by key, the last used one last


class HaltedError(RuntimeError):
    """Flights that were ended from where the campaign is flown from."""


@dataclass
class _LoadedCampaign:
    """A campaign that this process flies: its plan, and a flyer for each thread that has flown it at once."""

    plan: BatchPlan
    idle: list[Flyer] = field(default_factory=list)
    busy: list[Flyer] = field(default_factory=list)


def fly(sent: Sent, task: Sequence[Piece]) -> list[tuple[TrialTable, float]]:
    """Fly some trials; those of each piece, and the seconds that they took without what comes before the first one.

    Raises InputError in a worker that has another perilune, which may come at any time.
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
            except KeyboardInterrupt:  # which would end the worker
                raise HaltedError(sent.key) from None
            simulated.append((trials, time.perf_counter() - began))
    return simulated


def halt(key: str) -> None:
    """End what flies of a campaign at its next communication points."""
    with _looking:
        loaded = _loaded.get(key)
        for flyer in loaded.busy if loaded is not None else ():
            flyer.interrupt()


@contextmanager
def _flyer(sent: Sent, folder: Path) -> Iterator[Flyer]:
    """Yield a flyer that no other thread has."""
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
    """Return a campaign as it was sent; others that no thread uses are freed where too many are kept, or can be."""
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
