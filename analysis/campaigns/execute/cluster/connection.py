"""Connection to a cluster: opened and checked before anything is written, closed at the end."""

from __future__ import annotations

import importlib
import logging
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from .....common.errors import InputError
from .sent import identity, refuse_others
from .shard_tasks import Cluster

OPTION = "`scheduler`"
ANSWER = 10.0  # s, time for a scheduler to answer
FIRST_WORKER = 30.0  # s, time for a first worker to join
LOGS = ("distributed", "distributed.client")  # loggers with separate levels
LARGEST = "1 TB"  # size above which dask warns of a large message; it need not, since the campaign is sent only once


@contextmanager
def cluster(address: str | None, *, workers: int | None = None, engine: str | None = None) -> Iterator[Cluster | None]:
    """Yield an executor for the workers of the dask scheduler at ``address``, or None if no address is passed.

    An address has the form tcp://host:8786. ``workers`` and ``engine`` configure this machine, and are rejected with an
    address. Raises InputError if distributed is not installed, if the scheduler does not answer or has no workers, or
    if a worker has another version of Perilune.
    """
    if address is None:
        yield None
        return
    for option, value in (("`workers`", workers), ("`engine`", engine)):
        if value is not None:
            problem = "the cluster's workers simulate, each with its own number of threads"
            raise InputError(option, str(value), problem, f"omit {option} or {OPTION}")
    distributed = _import_distributed()
    with _quiet(), _client(distributed, address) as client:
        _check_workers(client, address)
        yield Cluster(client, address)


@contextmanager
def _quiet() -> Iterator[None]:
    """Silence the log of distributed, since Perilune reports its errors in one line."""
    logs = [logging.getLogger(name) for name in LOGS]
    levels = [log.level for log in logs]
    for log in logs:
        log.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for log, level in zip(logs, levels, strict=True):
            log.setLevel(level)


def _import_distributed() -> Any:
    try:
        return importlib.import_module("distributed")
    except ImportError as error:
        problem = "simulation on a cluster needs the package distributed, which is not installed"
        raise InputError(OPTION, "", problem, "pip install 'perilune[cluster]'") from error


@contextmanager
def _client(distributed: Any, address: str) -> Iterator[Any]:
    dask = importlib.import_module("dask")
    with dask.config.set({"distributed.admin.large-graph-warning-threshold": LARGEST}):
        try:
            client = distributed.Client(address, timeout=ANSWER, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            problem = "no dask scheduler answers at this address"
            raise InputError(
                OPTION, address, problem, "start a scheduler with dask scheduler, and give its address, tcp://HOST:PORT"
            ) from error
        with client:
            yield client


def _check_workers(client: Any, address: str) -> None:
    """Reject a cluster without workers, or with a worker that has another version of Perilune. Raises InputError."""
    try:
        client.wait_for_workers(1, timeout=FIRST_WORKER)
    except TimeoutError as error:
        problem = f"no worker has connected within {FIRST_WORKER:g} s"
        raise InputError(OPTION, address, problem, f"start a worker with dask worker {address}") from error
    ours = identity()
    for worker, theirs in sorted(client.run(identity, on_error="return").items()):
        refuse_others(ours, theirs, worker)
