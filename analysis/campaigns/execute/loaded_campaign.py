"""Campaign that is ready for simulation: its plan, systems and manifest, and its folder if it has one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from ....common.errors import InputError
from ....fmus_src.kernel.functions import VERSION
from ...options.choices import FUSED
from ...runtime.fused.refusals import check_fused
from ...runtime.process.opening import may_load_here
from ...runtime.system.options import UNTRUSTED, Trust
from ...runtime.system.prepared import PreparedSystem
from ..definition.checks import check_plan, prepare_variants
from ..definition.plan import BatchPlan
from ..folder.campaign_folder import CampaignFolder
from ..folder.campaign_manifest import FILE, WRITE, CampaignManifest, read_manifest
from ..folder.lock import lock_folder
from ..folder.numbering import Numbering
from ..folder.provenance import CampaignProvenance
from ..folder.shard_files import SUMMARY, check_folders, shard_path
from ..folder.summary_file import read_summary
from ..lost_trials import lost_status
from ..trials import TrialTable
from .folder import remove_further_trials, resume_folder, write_prepared_campaign
from .identity import campaign_key
from .metadata import provenance
from .plan_manifest import make_manifest, restore
from .store import ShardStore
from .workers import in_threads, needs_children, worker_count


@dataclass(frozen=True)
class LoadedCampaign:
    """Campaign ready for simulation, with every file read and stored in its ``folder`` (absolute), if it has one.

    ``plan`` is the user's plan, and ``stored_plan`` the same plan with the files stored in the folder. ``user_folder``
    is the folder's path as stated by the user.
    """

    plan: BatchPlan
    stored_plan: BatchPlan
    systems: Mapping[str, PreparedSystem]
    manifest: CampaignManifest
    folder: Path | None
    user_folder: Path | None = None

    def of_first(self, trials: int) -> LoadedCampaign:
        """Return the campaign reduced to its first trials, which must end with a shard; reduce its folder, too."""
        if trials == self.manifest.trials:
            return self
        plan = self.plan.of_first(trials)
        if self.folder is None:
            return replace(self, plan=plan, manifest=replace(self.manifest, trials=trials))
        return replace(self, plan=plan, manifest=remove_further_trials(self.folder, self.manifest, plan))

    @property
    def provenance(self) -> CampaignProvenance:
        """Inputs that determine the campaign's numbers, other than the trials themselves."""
        is_earlier = self.manifest.identities is None
        entries = provenance(self.stored_plan if is_earlier else self.plan, self.systems)
        entries["manifest" if is_earlier else "batch"] = campaign_key(self.manifest)
        return entries

    @property
    def numbering(self) -> Numbering:
        return Numbering(self.manifest.trials, self.manifest.shard_size)

    @cached_property
    def stored(self) -> CampaignFolder | None:
        """Reader of the campaign's folder, or None if it has none."""
        return None if self.folder is None else CampaignFolder(self.folder, self.provenance)

    def store(self) -> ShardStore:
        return ShardStore(self.plan if self.folder is None else self.stored_plan, self.stored)

    def shard_rows(self, shard: int) -> Mapping[str, TrialTable]:
        """Return the trials of a stored shard by variant."""
        if self.folder is None:
            raise ValueError("a campaign without a folder stores no shards")
        return self.store().rows(self.numbering, range(shard, shard + 1))

    def has(self, shard: int) -> bool:
        """Return True if a shard is stored. Raises InputError for a damaged shard."""
        return self.stored is not None and self.stored.has(shard, self.numbering.of(shard))

    def missing(self) -> list[int]:
        """Return the numbers of the shards that are not stored."""
        return [shard for shard in range(self.numbering.count) if not self.has(shard)]

    def discard_lost(self, shards: Iterable[int]) -> None:
        """Remove shards with trials that crashed, hung or ran out of memory, so that they are simulated again.

        Raises InputError if another process is simulating the campaign.
        """
        if self.folder is None:
            return
        with lock_folder(self.folder, alone=True):
            for shard in sorted(set(shards) - set(self.missing())):
                if self._has_lost(shard):
                    shard_path(self.folder, shard).unlink()

    def _has_lost(self, shard: int) -> bool:
        """Return True if a trial of a shard crashed, hung or ran out of memory."""
        columns = (columns for rows in self.shard_rows(shard).values() for columns in rows.parts("status"))
        return any(lost_status(status) for column in columns for status in column["status"])

    def check_campaign(self, shards: Iterable[int]) -> list[int]:
        """Check that the campaign can be simulated here, and return the ``shards`` that are not stored yet.

        Raises InputError for an invalid shard number, or if the campaign uses another version of the elementary
        functions.
        """
        if self.manifest.elementary_functions != VERSION:
            problem = (
                f"prepared with elementary functions {self.manifest.elementary_functions}, but this perilune has "
                f"{VERSION}: results would differ in their last bits"
            )
            remedy = f"simulate its shards with perilune {self.manifest.perilune}, which prepared it"
            raise InputError(self.user_folder or FILE, "elementary_functions", problem, remedy)
        requested = set(shards)
        for shard in sorted(requested):
            if not 0 <= shard < self.numbering.count:
                raise InputError("shard", str(shard), "no such shard", f"give 0 to {self.numbering.count - 1}")
        return sorted(requested & set(self.missing()))


def open_campaign(
    plan: BatchPlan,
    output: Path | None,
    *,
    resume: bool = False,
    engine: str | None = None,
    workers: int | None = None,
    elsewhere: str | None = None,
) -> LoadedCampaign:
    """Check a plan and store it. Raises InputError before anything is written or simulated.

    With ``output`` a campaign is started in that folder, where it replaces other content, or resumed there with
    ``resume``. The files stored in the folder are simulated, even if their originals change. ``elsewhere`` names the
    executor if it is not this process.
    """
    if elsewhere is not None and plan.options.chosen["flavour"] == FUSED:
        problem = f"{elsewhere} choose for themselves whether to compile steps"
        raise InputError("`flavour`", FUSED, problem, "omit `flavour`")
    count = worker_count(workers)
    systems = check_plan(plan)
    in_child = needs_children(count, in_threads(systems.values(), engine), engine)
    for prepared in systems.values():
        check_fused(prepared, in_child=in_child or not may_load_here(prepared))
    manifest, contents = make_manifest(plan, systems)
    if output is None:
        return LoadedCampaign(plan, plan, systems, manifest, None)
    folder = output.absolute()  # FMUs may change the working folder
    with lock_folder(folder, alone=not resume):
        manifest = (resume_folder if resume else write_prepared_campaign)(folder, manifest, contents, plan)
    flown = restore(folder, manifest, plan.watch.log, trust=plan.options)
    flown = replace(flown, options=flown.options.replace(flavour=plan.options.chosen["flavour"]))
    plan = replace(plan, known_draws=flown.draws)  # read from the folder instead of kept in memory
    return LoadedCampaign(plan, flown, systems, manifest, folder, output)


def open_folder(folder: Path, trust: Trust = UNTRUSTED) -> LoadedCampaign:
    """Open the campaign in a folder with a manifest. Raises InputError.

    ``trust`` contains the permissions of foreign FMUs.
    """
    named, folder = folder, folder.absolute()
    manifest = read_manifest(folder)
    plan = restore(folder, manifest, trust=trust)  # its draws were checked when the folder was created
    return LoadedCampaign(plan, plan, prepare_variants(plan), manifest, folder, named)


def read_folder(folder: Path) -> CampaignFolder:
    """Return the folder of a complete or running campaign. Raises InputError for other folders."""
    folder = folder.absolute()
    check_folders(folder)
    if (folder / SUMMARY).is_file():
        return CampaignFolder.complete(folder, read_summary(folder / SUMMARY))
    if not (folder / FILE).is_file():
        raise InputError(folder, FILE, "not found", WRITE)
    return CampaignFolder(folder, open_folder(folder).provenance)
