"""`perilune.show` and `perilune show`: stored campaigns in a browser, also those too large for a page."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Unpack

from ...common.errors import InputError
from ..documents.model import Document
from ..documents.of.campaign_folders import served_document
from ..options.declared.campaigns import SHOW, ShowOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..show.server import CampaignServer
from .common.arguments import path_list
from .common.documented import Documented


@dataclass(frozen=True)
class ServedCampaigns(Documented):
    """Campaigns that were served until Ctrl-C."""

    folders: tuple[Path, ...]

    def document(self) -> Document:
        """Return a document that states that the server ended."""
        return served_document(self.folders)


@verb(SHOW)
def show(*folders: FilePath | Sequence[FilePath], **options: Unpack[ShowOptions]) -> ServedCampaigns:
    """Serve stored campaigns to a browser on this machine until Ctrl-C: `perilune show`.

    ``folders`` are folders that `batch` wrote to its ``output``, as arguments or a list. The address of the page is
    printed; nothing is written. Raises InputError.
    """
    paths = tuple(Path(folder) for folder in path_list(folders))
    if not paths:
        raise InputError("show", "", "no campaign folder is given", "give a folder that batch(..., output=...) wrote")
    _refuse_running_loop()
    server = CampaignServer(paths, options["port"] or 0)
    server.serve(lambda address: print(f"open {address}\nCtrl-C ends", flush=True))
    return ServedCampaigns(paths)


def _refuse_running_loop() -> None:
    try:
        asyncio.get_running_loop()
    except RuntimeError:  # raised by asyncio if no event loop runs
        return
    raise InputError(
        "show", "", "an event loop is already running, as in a notebook", "run perilune show in a terminal"
    )
