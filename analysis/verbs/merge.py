"""`perilune.merge`: the result of a campaign whose shards are all complete."""

from __future__ import annotations

from contextlib import chdir
from pathlib import Path
from typing import Unpack

from ..campaigns.fly.campaign import open_folder
from ..campaigns.fly.runner import merge_rows
from .batch import BatchResult
from .common.campaign_text import campaign_requirements
from .common.plans import resume_hint
from .options.campaigns import MERGE
from .options.option import FilePath
from .options.system import RequireOptions
from .options.verb import verb


@verb(MERGE)
def merge(folder: FilePath, **options: Unpack[RequireOptions]) -> BatchResult:
    """Merge the shards of a campaign's folder: `perilune merge`. Raises InputError where some are missing."""
    with chdir(Path.cwd()), resume_hint(Path(folder)):
        campaign = open_folder(Path(folder))
        requirements = campaign_requirements(campaign.plan, options["require"])
        return BatchResult.finish(campaign, merge_rows(campaign), requirements=tuple(requirements))
