"""From a campaign's folder back to a plan, whose every file is the one that the manifest names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pyarrow.parquet

from ....runtime.flight.instances.reset_check import ResetVerdict, recall
from ....runtime.ssp.archive import SystemArchive
from ....runtime.system.fault import parse_fault
from ....runtime.system.in_flight.series import InputSeries
from ....runtime.system.in_flight.watch import Watch
from ....runtime.system.options import SystemOptions
from ...draws.given import GivenDraws, part_streams
from ...spec.file import parse_campaign
from ...spec.plan import BatchPlan
from ...spec.sweeps import with_sweeps
from ...spec.toml.source import CampaignSource
from ..shards.draws import read_draws
from .contents import store_content
from .manifest import CONTENTS, Manifest


def restore(folder: Path, manifest: Manifest, log: str | None = None, *, draws: Path | None = None) -> BatchPlan:
    """The plan of a campaign's folder, with the draws that are stored there. Raises InputError.

    ``log`` is the level of the FMUs' messages, which changes no result; ``draws`` is the folder of the table of draws
    where that is another.
    """
    contents = (folder / CONTENTS).absolute()  # FMUs may change the working folder
    source = _source(contents, manifest.campaign)
    parsed, compare = parse_campaign(source.table()), manifest.campaign["compare"]
    read = replace(
        parsed,
        trials=manifest.trials,
        seed=manifest.seed,
        compare={slot: tuple(names) for slot, names in compare.items()},
        configurations=() if compare else parsed.configurations,
        selected=manifest.campaign.get("selected"),
    )
    campaign = with_sweeps(read, manifest.campaign.get("sweep", {}))
    options: dict[str, Any] = {
        name: tuple(value) if isinstance(value, list) else value for name, value in manifest.options.items()
    }
    plan = BatchPlan(
        manifest.system["label"],
        campaign,
        SystemOptions(**options, folder=str(contents)),
        source.sha256,
        faults=tuple(parse_fault(text) for text in manifest.faults),
        series=None if manifest.series is None else _series(contents, manifest.series),
        watch=Watch(manifest.timeout, log),
        compared_by=manifest.campaign["compared_by"],
        source=source,
        until_decided=manifest.until_decided,
        archive=_archive(contents, manifest),
    )
    if manifest.draws is not None:
        plan = plan.of_samples(_read_given(contents, manifest.draws)).of_first(manifest.trials)
    elif not plan.is_counted:
        stored_table = read_draws((draws or folder).absolute(), manifest.trials, plan.campaign.input_names())
        plan = replace(plan, known_draws=stored_table)  # made anew they could differ
    for digest, verdict in manifest.resets.items():
        recall(digest, ResetVerdict(**verdict))
    return plan


def _source(contents: Path, campaign: Mapping[str, Any]) -> CampaignSource:
    extends = tuple(_source(contents, part) for part in campaign.get("extends", []))
    data = store_content(contents, campaign["content"]).read_bytes()
    return CampaignSource(campaign["label"], data, extends, campaign.get("position", 0))


def _archive(contents: Path, manifest: Manifest) -> SystemArchive:
    system: Mapping[str, Any] = manifest.system
    files = {name: store_content(contents, content) for name, content in system["files"].items()}
    return SystemArchive(
        name=system["name"],
        label=system["label"],
        path=contents if system["fmu"] is None else files[system["fmu"]],
        files=files,
        description=system["description"],
        elsewhere={requested: store_content(contents, content) for requested, content in manifest.elsewhere.items()},
        known_digest=system["sha256"],  # without the files that were read in addition to its list of files
    )


def _series(contents: Path, series: Mapping[str, str]) -> InputSeries:
    table = pyarrow.parquet.read_table(store_content(contents, series["content"]))
    columns = {name: table[name].to_numpy() for name in table.column_names}
    return InputSeries(series["label"], series["sha256"], columns.pop("time"), columns)


def _read_given(contents: Path, given: Mapping[str, str]) -> GivenDraws:
    table = pyarrow.parquet.read_table(store_content(contents, given["content"]))
    columns = {name: table[name].to_numpy() for name in table.column_names}
    return GivenDraws(*part_streams(columns), given["label"], given["sha256"])
