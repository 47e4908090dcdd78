"""`perilune.prepare`: a campaign written to a folder, to be simulated shard by shard; the result is the folder."""

from __future__ import annotations

from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Unpack

from ..campaigns.fly.campaign import open_campaign
from ..common.errors import InputError
from ..common.targets import check_folder
from .common.plans import read_campaign
from .options.campaigns import PREPARE, PrepareOptions
from .options.option import FilePath
from .options.verb import verb


@dataclass(frozen=True)
class PreparedCampaign:
    """A campaign's ``folder`` with ``shards`` of ``shard_size`` trials, the last one with the rest."""

    folder: Path
    shards: int
    shard_size: int

    def to_json(self) -> dict[str, Any]:
        """Folder, number and size of shards."""
        return {"folder": str(self.folder), "shards": self.shards, "shard_size": self.shard_size}

    def lines(self) -> list[str]:
        """What `perilune prepare` prints."""
        last = self.shards - 1
        return [
            f"written: {self.folder}, shards 0-{last}, {self.shard_size} trials each, the rest in the last",
            f"simulate them: perilune shard {self.folder} 0-{last}, in any parts; then: perilune merge {self.folder}",
        ]

    def problems(self) -> list[str]:
        """None."""
        return []


@verb(PREPARE)
def prepare(
    system: FilePath, campaign: FilePath, output: FilePath, **options: Unpack[PrepareOptions]
) -> PreparedCampaign:
    """Write a campaign to the folder ``output`` without simulating it: `perilune prepare`.

    `shard` simulates its shards, here or wherever the folder is, and `merge` puts them together. Options are as in
    `batch`. Raises InputError.
    """
    folder = Path(output)
    if options["resume"] and options["overwrite"]:
        raise InputError("`resume`", "`overwrite`", "one keeps what is stored, one does not", "leave one of them out")
    is_kept = options["overwrite"] or options["resume"]
    check_folder("`output`", folder, overwrite=is_kept, otherwise="`resume` or `overwrite`")
    with chdir(Path.cwd()):  # an FMU may change the folder
        opened = open_campaign(read_campaign(system, campaign, options), folder, resume=options["resume"])
    return PreparedCampaign(folder, opened.numbering.count, opened.numbering.size)
