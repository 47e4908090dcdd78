"""System to which a campaign's file belongs, for commands that name no system."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path

from ....common.errors import InputError
from ....common.paths import names_fmu
from ...runtime.ssp.archive import OSP_DESCRIPTION, SystemArchive, open_system, system_names
from .campaign_source import EXTENDS, parse_toml

FOLDERS = ("campaigns", SystemArchive.campaign_path(""))  # in a system's folder, and in an unpacked archive


def find_system(raw: bytes, path: Path, named: Sequence[str]) -> str | None:
    """Return the system with which a campaign's file is checked: the system with the file in its folder of campaigns.

    For other files with ``named`` systems (paths or names), it is the named system whose name the file states, or else
    the first named system. Without named systems, it is Perilune's system whose name the file states or, if the file
    states no name, the first with a campaign that the file extends by name. None is returned if there is no such
    system. Raises InputError for a file that is not TOML.
    """
    for folder in path.resolve().parents:
        holds = any(path.resolve().is_relative_to(folder / each) for each in FOLDERS)
        if holds and (any(folder.glob("*.ssd")) or (folder / OSP_DESCRIPTION).is_file()):
            return str(folder)
    content = parse_toml(raw, str(path))
    name = str(content.get("system", ""))
    opened = dict(_names_of(named))
    if opened:
        return next((system for system, called in opened.items() if is_called(name, called)), next(iter(opened)))
    if name:
        return next((known for known in system_names() if is_called(name, known)), None)
    entry = content.get(EXTENDS, [])
    extended = {each for each in (entry if isinstance(entry, list) else [entry]) if isinstance(each, str)}
    return next((known for known in system_names() if extended & {*open_system(known).campaign_names()}), None)


def is_called(text: str, name: str) -> bool:
    """Return True if a campaign's ``system`` is this name, with or without the suffix of the system's file."""
    return (text[:-4] if names_fmu(text) else text.removesuffix(".ssp")) == name


def _names_of(systems: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Yield each system with its name; omit systems that cannot be opened, which other checks report."""
    for system in systems:
        with suppress(InputError):
            yield system, open_system(system).name
