"""What a worker elsewhere is sent of a campaign: its manifest, the contents that it names, its draws."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from ....common.errors import InputError
from ..campaign import Campaign
from ..manifest.contents import store_content
from ..manifest.gather import gather
from ..manifest.manifest import CONTENTS, Manifest
from ..shards.files import DRAWS, write_draws
from ..workers.workers import in_threads
from .identity import Identity, identity


@dataclass(frozen=True)
class Sent:
    """A campaign for a worker that sees nothing of the sender's files.

    ``contents`` are the files by hash, ``draws`` is draws.parquet, empty where a counter draws, ``log`` the level of
    the FMUs' messages; ``threads``
    says whether several of its flights can be in one process at a time. ``key`` tells it from others, ``identity`` is
    of the perilune that sends it.
    """

    key: str
    identity: Identity
    manifest: Manifest
    contents: Mapping[str, bytes]
    draws: bytes
    log: str | None
    threads: bool


def make_sent(campaign: Campaign) -> Sent:
    """A campaign as workers are sent it: from its folder, or what it has read where it has none. Raises InputError."""
    manifest, folder = campaign.manifest, campaign.folder
    if folder is not None:
        contents = {name: store_content(folder / CONTENTS, name).read_bytes() for name in manifest.names()}
        draws = b"" if campaign.plan.is_counted else (folder / DRAWS).read_bytes()
    else:
        described, contents = gather(campaign.plan, campaign.systems)
        if described != manifest:
            raise InputError(campaign.plan.system, "", "its files change while it is read", "fly it again")
        draws = b"" if campaign.plan.is_counted else _draws(campaign)
    key = hashlib.sha256(json.dumps(manifest.document(), sort_keys=True).encode() + draws).hexdigest()
    threads = in_threads(campaign.systems.values(), None)
    return Sent(key, identity(), manifest, contents, draws, campaign.plan.watch.log, threads)


def _draws(campaign: Campaign) -> bytes:
    """The table of draws of a campaign without a folder, as a file."""
    with TemporaryDirectory() as place:
        write_draws(campaign.plan, Path(place), campaign.numbering.size)
        return (Path(place) / DRAWS).read_bytes()
