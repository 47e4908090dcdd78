"""Folder of a campaign: its creation, and its resumption."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from ....common.atomic import remove_partial
from ....common.errors import InputError
from ..definition.plan import BatchPlan
from ..folder.campaign_manifest import CONTENTS, FILE, CampaignManifest, read_manifest, remove_contents, store_contents
from ..folder.draws import read_draws
from ..folder.numbering import Numbering
from ..folder.shard_files import DRAWS, FOLDER, SUMMARY, clear, trace_path, write_draws
from .identity import differences


def write_prepared_campaign(
    folder: Path, manifest: CampaignManifest, contents: dict[str, bytes], plan: BatchPlan
) -> CampaignManifest:
    """Write a campaign's manifest, contents and draws to a folder, and remove trials of other campaigns."""
    for name in (FILE, SUMMARY):  # removed first, so that remains of another campaign are no result any more
        (folder / name).unlink(missing_ok=True)
    clear(folder)
    remove_contents(folder / CONTENTS)
    _write(folder, manifest, contents, plan)
    return manifest


def resume_folder(
    folder: Path, manifest: CampaignManifest, contents: dict[str, bytes], plan: BatchPlan
) -> CampaignManifest:
    """Resume a folder that contains this campaign, or its first trials. Raises InputError for another campaign."""
    held = read_manifest(folder)
    manifest = replace(manifest, shard_size=held.shard_size)  # it was determined from fewer trials
    difference = differences(held, manifest)
    if difference:
        problem = f"holds another campaign: {difference}"
        raise InputError(folder / FILE, "", problem, "resume with the original options, or give another `output`")
    if manifest.trials < held.trials:
        problem = f"holds a campaign of {held.trials} trials, not {manifest.trials}"
        raise InputError(folder / FILE, "trials", problem, f"give `trials` {held.trials} or more")
    if not plan.is_counted:
        _check_draws(folder, held, plan)
    resumed = replace(held, trials=manifest.trials, timeout=manifest.timeout, options=manifest.options)
    if resumed.trials > held.trials:
        (folder / SUMMARY).unlink(missing_ok=True)
        _write(folder, resumed, contents, plan)
    elif resumed != held:
        resumed.write(folder)
    return resumed


def _check_draws(folder: Path, held: CampaignManifest, plan: BatchPlan) -> None:
    """Reject a plan with draws for the first trials that differ from the stored draws."""
    names = plan.campaign.input_names()
    stored, first = read_draws(folder, held.trials, names), 0
    for part in plan.draw_parts(held.shard_size):
        known = stored.of_part(range(first, min(first + part.trials, held.trials)))
        for name in names:
            if not np.array_equal(known.columns[name], part.columns[name][: known.trials], equal_nan=True):
                total, same = plan.campaign.trials, held.trials
                problem = f"with {total} trials the samples of {name} in the first {same} differ from the stored ones"
                raise InputError(folder / DRAWS, name, problem, "give another `output`")
        first += part.trials
        if first >= held.trials:
            return


def remove_further_trials(folder: Path, manifest: CampaignManifest, plan: BatchPlan) -> CampaignManifest:
    """Reduce the folder to the plan's trials; remove other complete shards and their traces."""
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
    write_draws(plan, folder, manifest.shard_size)
    return manifest


def remove_temporary_files(folder: Path) -> None:
    """Remove temporary files of killed writers from the folder of a campaign with all shards stored."""
    for place in (folder, folder / FOLDER, folder / CONTENTS, *trace_path(folder, "", 0).parent.glob("*/")):
        remove_partial(place)


def _write(folder: Path, manifest: CampaignManifest, contents: dict[str, bytes], plan: BatchPlan) -> None:
    store_contents(folder / CONTENTS, contents)
    write_draws(plan, folder, manifest.shard_size)
    manifest.write(folder)
