"""Conversion of a plan and its prepared systems to a manifest with contents, and of a folder back to the plan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import chdir
from dataclasses import asdict, replace
from importlib.metadata import version
from pathlib import Path, PurePath
from typing import cast

import numpy as np
import pyarrow
import pyarrow.parquet

from ....common.errors import InputError
from ....fmus_src.kernel.functions import VERSION
from ...options.fault import parse_fault
from ...runtime.instances.renewal import Renewal, ResetVerdict, store_verdict
from ...runtime.process.resets import find_verdict
from ...runtime.ssp.archive import SystemArchive
from ...runtime.system.options import UNTRUSTED, Trust, Watch
from ...runtime.system.prepared import PreparedSystem
from ...runtime.system.series import InputSeries
from ..definition.campaign import Campaign
from ..definition.campaign_source import CampaignSource
from ..definition.file import parse_campaign
from ..definition.plan import BatchPlan
from ..definition.sweeps import with_sweeps
from ..draws.supplied import SuppliedDraws, part_streams
from ..folder.campaign_manifest import (
    CONTENTS,
    FILE,
    SAME_VERSION,
    AttachedDocument,
    CampaignDocument,
    CampaignManifest,
    ResetDocument,
    SourceDocument,
    SystemDocument,
    TableDocument,
    content_name,
    content_path,
)
from ..folder.draws import read_draws
from ..folder.numbering import shard_size
from ..folder.shard_files import numbers, read_table
from ..stored_options import restore_options, store_options
from .identity import identity_of


class _Contents(dict[str, bytes]):
    """Contents of files under their names in a campaign's folder."""

    def keep(self, content: bytes, name: str) -> str:
        """Add the content of a file, and return the file's name in the folder."""
        stored = content_name(content, PurePath(name).suffix)
        self[stored] = content
        return stored

    def keep_table(self, label: str, sha256: str, columns: Mapping[str, np.ndarray]) -> TableDocument:
        """Add columns as a Parquet file, which preserves every bit."""
        sink = pyarrow.BufferOutputStream()
        pyarrow.parquet.write_table(pyarrow.table(dict(columns)), sink)
        return {"label": label, "sha256": sha256, "content": self.keep(bytes(sink.getvalue()), ".parquet")}


def make_manifest(plan: BatchPlan, systems: Mapping[str, PreparedSystem]) -> tuple[CampaignManifest, dict[str, bytes]]:
    """Return the manifest of a plan that was read from a campaign's file, and the contents to which it refers.

    ``systems`` are the prepared systems of `check_plan`, by variant. The reset of foreign FMUs is tested here, at first
    use.
    """
    campaign, contents, supplied, series = plan.campaign, _Contents(), plan.supplied, plan.series
    fmus = {fmu.digest: fmu for prepared in systems.values() for fmu in prepared.network.fmus.values()}
    with chdir(plan.options.folder):  # paths are relative to this folder
        system = _system_document([prepared.archive for prepared in systems.values()], contents)
        elsewhere = {
            requested: contents.keep(read(), requested)
            for prepared in systems.values()
            for requested, read in prepared.elsewhere.items()
        }
    manifest = CampaignManifest(
        perilune=version("perilune"),
        system=system,
        elsewhere=elsewhere,
        campaign=_campaign_document(plan, contents),
        options=store_options(plan.options),
        faults=[str(fault) for fault in plan.faults],
        series=None if series is None else _keep_series(series, contents),
        draws=None if supplied is None else contents.keep_table(supplied.file, supplied.sha256, supplied.table),
        timeout=plan.watch.timeout,
        fmus={
            variant: {name: fmu.digest for name, fmu in prepared.network.fmus.items()}
            for variant, prepared in systems.items()
        },
        resets={
            digest: cast(ResetDocument, asdict(find_verdict(fmu, plan.options)))
            for digest, fmu in fmus.items()
            if not fmu.is_self_contained
        },
        until_decided=plan.until_decided,
        seed=campaign.seed,
        trials=campaign.trials,
        shard_size=shard_size(campaign.trials),
        elementary_functions=VERSION,
        identities={digest: identity_of(fmu) for digest, fmu in fmus.items() if identity_of(fmu) != digest},
    )
    return manifest, contents


def _system_document(archives: Sequence[SystemArchive], contents: _Contents) -> SystemDocument:
    """Return the document of a system that is read once for each variant, with the files of all variants."""
    archive = archives[0]
    unlisted = dict.fromkeys(name for each in archives for name in each.unlisted)
    return {
        "name": archive.name,
        "label": archive.label,
        "description": archive.description,
        "sha256": archive.digest,
        "fmu": archive.path.name if archive.is_fmu else None,
        "files": {name: contents.keep(archive.read(name, name), name) for name in (*archive.files, *unlisted)},
    }


def _campaign_document(plan: BatchPlan, contents: _Contents) -> CampaignDocument:
    assert plan.source is not None  # a plan read from a file has a source
    campaign = plan.campaign
    document: CampaignDocument = {
        **_source_document(plan.source, campaign.file, contents),
        "compare": {slot: list(names) for slot, names in campaign.compare.items()},
        "compared_by": plan.compared_by,
    }
    if campaign.selected is not None:
        document["selected"] = campaign.selected
    if campaign.sweeps:
        document["sweep"] = dict(campaign.sweeps)
    return document


def _source_document(source: CampaignSource, label: str, contents: _Contents) -> SourceDocument:
    """Return the document of a campaign's file, including the files that it extends."""
    extends = [_source_document(part, part.label, contents) for part in source.extends]
    document: SourceDocument = {"label": label, "content": contents.keep(source.raw, source.label)}
    attached: dict[str, AttachedDocument] = {
        name: {"label": label, "content": contents.keep(content, name)}
        for name, (label, content) in source.attached.items()
        if content is not None
    }
    if attached:
        document["attached"] = attached
    return {**document, "extends": extends, "position": source.position} if extends else document


def _keep_series(series: InputSeries, contents: _Contents) -> TableDocument:
    return contents.keep_table(series.file, series.sha256, {"time": series.time, **series.columns})


def restore(
    folder: Path,
    manifest: CampaignManifest,
    log: str | None = None,
    *,
    draws: Path | None = None,
    trust: Trust = UNTRUSTED,
) -> BatchPlan:
    """Return the plan in a campaign's folder, with the stored draws. Raises InputError.

    ``log`` is the level of the FMUs' messages, which affects no result. ``draws`` is the folder of the table of draws
    if it is a different one. ``trust`` contains the permissions of foreign FMUs.
    """
    contents = (folder / CONTENTS).absolute()  # FMUs may change the working folder
    source = _restore_source(contents, manifest.campaign)
    of_fmu = manifest.system["fmu"] is not None
    options = restore_options(manifest.options, folder / FILE, SAME_VERSION, of_fmu=of_fmu)
    plan = BatchPlan(
        manifest.system["label"],
        _restore_campaign(source, manifest, folder),
        options.replace(folder=str(contents), **trust.trust),
        source.sha256,
        faults=tuple(parse_fault(text) for text in manifest.faults),
        series=_restore_series(contents, manifest),
        watch=Watch(manifest.timeout, log),
        compared_by=manifest.campaign["compared_by"],
        source=source,
        until_decided=manifest.until_decided,
        archive=_restore_archive(contents, manifest),
    )
    if manifest.draws is not None:
        draw_columns = part_streams(_read_columns(contents, manifest.draws))
        supplied = SuppliedDraws(*draw_columns, manifest.draws["label"], manifest.draws["sha256"])
        plan = plan.of_samples(supplied).of_first(manifest.trials)
    elif not plan.is_counted:
        stored_table = read_draws((draws or folder).absolute(), manifest.trials, plan.campaign.input_names())
        plan = replace(plan, known_draws=stored_table)  # repeated draws could differ
    for digest, verdict in manifest.resets.items():
        store_verdict(digest, _restore_verdict(verdict))
    return plan


def _restore_campaign(source: CampaignSource, manifest: CampaignManifest, folder: Path) -> Campaign:
    """Return the campaign in a file with the changes recorded in its manifest. Raises InputError."""
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
    if not campaign.variants():
        raise InputError(
            folder / FILE, "campaign", "the manifest has neither a comparison nor a selected variant", SAME_VERSION
        )
    return campaign


def _restore_series(contents: Path, manifest: CampaignManifest) -> InputSeries | None:
    """Return the inputs over time, or None."""
    if manifest.series is None:
        return None
    columns = _read_columns(contents, manifest.series)
    return InputSeries(manifest.series["label"], manifest.series["sha256"], columns.pop("time"), columns)


def _restore_verdict(document: ResetDocument) -> ResetVerdict:
    """Return a verdict, also from an earlier version, which distinguished only resets and new instances."""
    earlier = Renewal.RESET if document.get("resets", False) else Renewal.INSTANCE
    return ResetVerdict(document.get("renewal", earlier), document["reason"])


def _restore_source(contents: Path, campaign: SourceDocument) -> CampaignSource:
    extends = tuple(_restore_source(contents, part) for part in campaign.get("extends", []))
    data = content_path(contents, campaign["content"]).read_bytes()
    attached = {
        name: (table["label"], content_path(contents, table["content"]).read_bytes())
        for name, table in campaign.get("attached", {}).items()
    }
    return CampaignSource(campaign["label"], data, extends, campaign.get("position", 0), attached)


def _restore_archive(contents: Path, manifest: CampaignManifest) -> SystemArchive:
    system = manifest.system
    files = {name: content_path(contents, content) for name, content in system["files"].items()}
    return SystemArchive(
        name=system["name"],
        label=system["label"],
        path=contents if system["fmu"] is None else files[system["fmu"]],
        files=files,
        description=system["description"],
        elsewhere={requested: content_path(contents, content) for requested, content in manifest.elsewhere.items()},
        known_digest=system["sha256"],  # excludes files that were read but are not in its list of files
    )


def _read_columns(contents: Path, table: TableDocument) -> dict[str, np.ndarray]:
    path = content_path(contents, table["content"])
    read = read_table(path)
    return {name: numbers(read, name, path) for name in read.column_names}
