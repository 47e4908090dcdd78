"""From a plan and its prepared systems to the manifest, and to the contents that lie beside it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import chdir
from dataclasses import asdict
from importlib.metadata import version
from pathlib import PurePath
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet

from .....fmus_src.kernel.functions import VERSION
from ....runtime.flight.instances.reset_check import reset_verdict
from ....runtime.ssp.archive import SystemArchive
from ....runtime.system.prepared import PreparedSystem
from ...spec.plan import BatchPlan
from ...spec.toml.source import CampaignSource
from ..shards.numbering import shard_size
from .contents import name_of
from .manifest import Manifest

NOT_ASKED = ("places", "folder")  # of the options: where values are written, and where paths are meant from


def gather(plan: BatchPlan, systems: Mapping[str, PreparedSystem]) -> tuple[Manifest, dict[str, bytes]]:
    """The manifest of a plan that was read from a campaign's file, and the contents that it names.

    ``systems`` are those of `check_plan`, by variant. FMUs that are not ours have their reset tried here, once.
    """
    assert plan.source is not None  # a plan that was read from a file has one
    first = next(iter(systems.values()))
    contents: dict[str, bytes] = {}

    def keep(content: bytes, name: str) -> str:
        stored = name_of(content, PurePath(name).suffix)
        contents[stored] = content
        return stored

    archive = first.archive
    with chdir(plan.options.folder):  # from which paths are meant
        files = {name: keep(archive.read(name, name), name) for name in {**archive.files, **_read_besides(systems)}}
        elsewhere = {
            requested: keep(read(), requested)
            for prepared in systems.values()
            for requested, read in prepared.elsewhere.items()
        }
    series = None
    if plan.series is not None:
        content = keep(_table({"time": plan.series.time, **plan.series.columns}), ".parquet")
        series = {"label": plan.series.file, "sha256": plan.series.sha256, "content": content}
    draws = None
    if plan.given is not None:
        content = keep(_table(plan.given.table), ".parquet")
        draws = {"label": plan.given.file, "sha256": plan.given.sha256, "content": content}
    campaign = plan.campaign
    options = {name: value for name, value in asdict(plan.options).items() if name not in NOT_ASKED}
    fmus = {fmu.digest: fmu for prepared in systems.values() for fmu in prepared.network.fmus.values()}
    manifest = Manifest(
        perilune=version("perilune"),
        system=_system(archive) | {"files": files},
        elsewhere=elsewhere,
        campaign={
            "label": campaign.file,
            **_source(plan.source, keep),
            "compare": {slot: list(names) for slot, names in campaign.compare.items()},
            "compared_by": plan.compared_by,
            **({} if campaign.selected is None else {"selected": campaign.selected}),
            **({"sweep": dict(campaign.sweeps)} if campaign.sweeps else {}),
        },
        options=options,
        faults=[str(fault) for fault in plan.faults],
        series=series,
        draws=draws,
        timeout=plan.watch.timeout,
        fmus={
            variant: {name: fmu.digest for name, fmu in prepared.network.fmus.items()}
            for variant, prepared in systems.items()
        },
        resets={digest: asdict(reset_verdict(fmu)) for digest, fmu in fmus.items() if not fmu.is_own},
        until_decided=plan.until_decided,
        seed=campaign.seed,
        trials=campaign.trials,
        shard_size=shard_size(campaign.trials),
        elementary_functions=VERSION,
    )
    return manifest, contents


def _source(source: CampaignSource, keep: Callable[[bytes, str], str]) -> dict[str, Any]:
    """The contents of a campaign's file, and of those that it extends."""
    extends = [{"label": part.label, **_source(part, keep)} for part in source.extends]
    own = {"content": keep(source.raw, source.label)}
    return own | {"extends": extends, "position": source.position} if extends else own


def _system(archive: SystemArchive) -> dict[str, Any]:
    return {
        "name": archive.name,
        "label": archive.label,
        "description": archive.description,
        "sha256": archive.digest,
        "fmu": archive.path.name if archive.is_fmu else None,
    }


def _table(columns: Mapping[str, np.ndarray]) -> bytes:
    """Columns as Parquet, every bit of them."""
    sink = pyarrow.BufferOutputStream()
    pyarrow.parquet.write_table(pyarrow.table(dict(columns)), sink)
    return bytes(sink.getvalue())


def _read_besides(systems: Mapping[str, PreparedSystem]) -> dict[str, None]:
    """Files of a system's folder that its list of files lacks, and that some variant has read."""
    return {name: None for prepared in systems.values() for name in prepared.archive.besides}
