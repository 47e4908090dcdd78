"""The folder of a campaign: begun, or found again and gone on with."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow.parquet

from ...campaign.plan import BatchPlan
from ...errors import InputError
from ..shards.files import DRAWS, FOLDER, SUMMARY, clear, trace_path, write_draws
from ..shards.numbering import Numbering
from .contents import store
from .manifest import CONTENTS, FILE, Manifest, differences, read_manifest


def begin(folder: Path, manifest: Manifest, contents: dict[str, bytes], plan: BatchPlan) -> Manifest:
    """A folder with a campaign's manifest, contents and draws, and none of the trials of another."""
    for name in (FILE, SUMMARY):  # first, so that what is left of another campaign is no result any more
        (folder / name).unlink(missing_ok=True)
    clear(folder)
    _write(folder, manifest, contents, plan)
    return manifest


def go_on(folder: Path, manifest: Manifest, contents: dict[str, bytes], plan: BatchPlan) -> Manifest:
    """A folder that holds this campaign already, or its first trials. Raises InputError for another one."""
    held = read_manifest(folder)
    manifest = replace(manifest, shard_size=held.shard_size)  # which followed from fewer trials
    found = differences(held, manifest)
    if found:
        problem = f"another campaign than the one asked for: {found}"
        raise InputError(folder / FILE, "", problem, "resume with what it began with, or give another --output")
    if manifest.trials < held.trials:
        problem = f"holds a campaign of {held.trials} trials, {manifest.trials} are asked for"
        raise InputError(folder / FILE, "trials", problem, f"give --trials {held.trials} or more")
    drawn = pyarrow.parquet.read_table(folder / DRAWS)
    for name, column in plan.draws.columns.items():
        before = drawn[name].to_numpy()[: held.trials]
        if not np.array_equal(before, column[: held.trials], equal_nan=True):
            problem = f"{manifest.trials} trials draw other values of {name} in the first {held.trials}, as designs do"
            raise InputError(folder / DRAWS, name, problem, "fly them into another --output")
    if manifest.trials > held.trials:
        (folder / SUMMARY).unlink(missing_ok=True)
        _write(folder, manifest, contents, plan)
    return manifest


def cut(folder: Path, manifest: Manifest, plan: BatchPlan) -> Manifest:
    """The folder of a campaign of fewer trials, those of the plan: whole shards, and the traces of these."""
    manifest = replace(manifest, trials=plan.campaign.trials)
    numbering = Numbering(manifest.trials, manifest.shard_size)
    for path in (folder / FOLDER).glob("[0-9]*.parquet"):
        if int(path.stem) >= numbering.count:
            path.unlink()
    for variant in plan.campaign.variants():
        for path in trace_path(folder, variant.name, 0).parent.glob("[0-9]*.parquet"):
            if int(path.stem) >= manifest.trials:
                path.unlink()
    manifest.write(folder)
    write_draws(plan, folder)
    return manifest


def _write(folder: Path, manifest: Manifest, contents: dict[str, bytes], plan: BatchPlan) -> None:
    store(folder / CONTENTS, contents)
    write_draws(plan, folder)
    manifest.write(folder)
