"""The folder of a campaign: which one it is, and which of its shards are there, by what each says of itself."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ....common.errors import InputError
from ..execute.campaign import open_folder
from ..execute.manifest import FILE as MANIFEST
from ..execute.manifest import WRITE
from ..execute.metadata import Provenance, batch_digest
from ..execute.shards.files import FOLDER, NEW_FOLDER, SUMMARY, describe_columns, trials_in
from .stored import read_summary, without_summary


@dataclass(frozen=True)
class Shard:
    """The file of a shard, and its trials."""

    path: Path
    trials: range


@dataclass(frozen=True)
class ResultFolder:
    """A campaign's folder as it was when it was opened.

    ``provenance`` is what its numbers depend on, as in summary.json; ``is_whole`` says whether all trials are there;
    ``paths`` are the files of the shards in order.
    """

    folder: Path
    provenance: Provenance
    is_whole: bool
    paths: tuple[Path, ...]

    @property
    def variants(self) -> list[str]:
        return list(self.provenance["fmus"])

    @cached_property
    def batch(self) -> str:
        return batch_digest(self.provenance)

    @cached_property
    def shards(self) -> tuple[Shard, ...]:
        """The shards that are there, one or more, in order.

        Raises InputError for one that is damaged or of another campaign, for missing ones of a whole campaign, and
        where there is none.
        """
        shards: list[Shard] = []
        end, total = 0, self.provenance["trials"]
        for path in self.paths:
            if self.is_whole and end == total:
                break  # what is left of a longer campaign
            shard = self._shard(path)
            if self.is_whole and shard.trials.start != end:
                break
            shards.append(shard)
            end = shard.trials.stop
        if self.is_whole and end != total:
            raise InputError(self.folder / FOLDER, "", f"trials from {end} on are missing", NEW_FOLDER)
        if not shards:
            raise InputError(self.folder, FOLDER, "no shard is flown yet", "open it again when one is")
        return tuple(shards)

    @property
    def flown(self) -> int:
        """How many trials of each variant are there."""
        return sum(len(shard.trials) for shard in self.shards) if self.paths else 0

    def _shard(self, path: Path) -> Shard:
        return Shard(path, trials_in(path, describe_columns(path), self.batch, SUMMARY if self.is_whole else MANIFEST))


def read_folder(folder: Path) -> ResultFolder:
    """The folder of a campaign that is whole, or still flying. Raises InputError for what is neither."""
    folder = folder.absolute()
    paths = tuple(path for path in sorted((folder / FOLDER).glob("*.parquet")) if path.stem.isdecimal())
    if (folder / SUMMARY).is_file():
        return ResultFolder(folder, without_summary(read_summary(folder / SUMMARY)), True, paths)
    if not (folder / MANIFEST).is_file():
        raise InputError(folder, MANIFEST, "not found", WRITE)
    return ResultFolder(folder, open_folder(folder).provenance, False, paths)
