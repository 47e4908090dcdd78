"""Campaign as sent to remote workers, and the check that workers have the same Perilune, on which the bits depend."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory

from .....common.errors import InputError
from .....common.paths import PACKAGE
from ...folder.campaign_manifest import CONTENTS, CampaignManifest, content_path
from ...folder.shard_files import DRAWS, write_draws
from ..loaded_campaign import LoadedCampaign
from ..plan_manifest import make_manifest
from ..workers import in_threads

ROOMS = ("analysis", "common", "fmus_src")
Identity = tuple[str, str]


@cache
def identity() -> Identity:
    """Return the version of this Perilune, and the SHA-256 of its sources."""
    total = hashlib.sha256()
    for room in ROOMS:
        place = (PACKAGE / room).resolve()  # the folder may be a link in a checkout
        for path in sorted(place.rglob("*.py")):
            total.update(path.relative_to(place).as_posix().encode() + b"\0" + path.read_bytes())
    return version("perilune"), total.hexdigest()


def refuse_others(ours: Identity, theirs: Identity | BaseException, worker: str) -> None:
    """Raise InputError unless a worker has the same Perilune.

    ``theirs`` is the worker's identity, or an exception if it has no Perilune.
    """
    if isinstance(theirs, BaseException):
        problem = f"worker {worker} cannot load perilune: {' '.join(str(theirs).split())}"
    elif theirs[0] != ours[0]:
        problem = f"worker {worker} has perilune {theirs[0]}, but this process has {ours[0]}"
    elif theirs != ours:
        problem = f"worker {worker} has perilune {ours[0]} with different source files"
    else:
        return
    raise InputError(
        "`scheduler`", "", problem, "install this version in the worker's environment, then restart the worker"
    )


@dataclass(frozen=True)
class Sent:
    """Campaign for a worker that cannot access the sender's files.

    ``contents`` contains the files by hash. ``draws`` is the content of draws.parquet, empty for counter-based draws.
    ``log`` is the level of the FMUs' messages. With ``in_child`` all simulations run in children of the workers.
    ``key`` identifies the campaign, ``identity`` the sender's Perilune.
    """

    key: str
    identity: Identity
    manifest: CampaignManifest
    contents: Mapping[str, bytes]
    draws: bytes
    log: str | None
    in_child: bool


def make_sent(campaign: LoadedCampaign) -> Sent:
    """Return a campaign as sent to workers, from its folder, or from memory if it has no folder. Raises InputError."""
    manifest, folder = campaign.manifest, campaign.folder
    if folder is not None:
        contents = {name: content_path(folder / CONTENTS, name).read_bytes() for name in manifest.names()}
        draws = b"" if campaign.plan.is_counted else (folder / DRAWS).read_bytes()
    else:
        described, contents = make_manifest(campaign.plan, campaign.systems)
        if described != manifest:
            raise InputError(
                campaign.plan.system, "", "its files changed while they were read", "run the command again"
            )
        draws = b"" if campaign.plan.is_counted else _draws(campaign)
    key = hashlib.sha256(json.dumps(manifest.document(), sort_keys=True).encode() + draws).hexdigest()
    in_child = not in_threads(campaign.systems.values(), None)
    return Sent(key, identity(), manifest, contents, draws, campaign.plan.watch.log, in_child)


def _draws(campaign: LoadedCampaign) -> bytes:
    """Return the table of draws of a campaign without a folder, as the content of a file."""
    with TemporaryDirectory() as place:
        write_draws(campaign.plan, Path(place), campaign.numbering.size)
        return (Path(place) / DRAWS).read_bytes()
