"""Manifest of a campaign, one JSON file: all inputs that determine its numbers, with contents under their SHA-256."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any, NotRequired, Required, TypedDict

import msgspec

from ....common.atomic import write_atomically
from ....common.bounds import INPUT_BYTES, TRIALS
from ....common.errors import InputError
from ....common.regular import read_regular
from ...runtime.instances.renewal import Renewal
from .files import check_folders

FILE = "manifest.json"
CONTENTS = "files"  # the folder next to it
SAME_VERSION = "resume with the version of perilune that wrote this file"
WRITE = "give a folder that perilune batch or prepare wrote"


class ResetDocument(TypedDict):
    """`ResetVerdict` in a manifest; earlier versions have ``resets`` instead of ``renewal``."""

    renewal: NotRequired[Renewal]
    resets: NotRequired[bool]
    reason: str


class TableDocument(TypedDict):
    """Table supplied by the user: its label, the SHA-256 of its file, and its content."""

    label: str
    sha256: str
    content: str


class SystemDocument(TypedDict):
    """System; ``files`` are contents by archive name, ``fmu`` is the name of a stand-alone FMU."""

    name: str
    label: str
    description: str
    sha256: str
    fmu: str | None
    files: dict[str, str]


class AttachedDocument(TypedDict):
    """Lookup table of a campaign's file."""

    label: str
    content: str


class SourceDocument(TypedDict, total=False):
    """Campaign file, with those that it extends; ``position`` is the place of its entries among theirs.

    ``attached`` are the tables of its lookups, by the paths it states.
    """

    label: Required[str]
    content: Required[str]
    extends: list[SourceDocument]
    position: int
    attached: dict[str, AttachedDocument]


class CampaignDocument(SourceDocument, total=False):
    """Campaign file, with the comparison, selection and sweeps of the command line."""

    compare: Required[dict[str, list[str]]]
    compared_by: Required[str]
    selected: str
    sweep: dict[str, str]


@dataclass(frozen=True)
class CampaignManifest:
    """Campaign to be simulated in shards; every value can be written as JSON.

    ``elsewhere`` are contents outside the ``system``, by the key of their use. ``options`` are the system options,
    ``faults`` the user's, ``series`` the inputs over time (label, sha256, content), ``draws`` likewise supplied ones;
    ``timeout`` is in s. ``fmus`` are hashes by variant and component, ``resets`` the verdicts of reset tests by hash.
    With ``until_decided`` the campaign ends with the shard in which its requirements are decided. ``shard_size`` is the
    number of trials in a shard, of each variant. ``elementary_functions`` is their version, on which the last bits
    depend; None for earlier campaigns, which used those of the C library. ``identities`` are those of FMUs by hash, if
    other files can be the same FMU; None for earlier campaigns.
    """

    perilune: str
    system: SystemDocument
    elsewhere: Mapping[str, str]
    campaign: CampaignDocument
    options: Mapping[str, Any]
    faults: list[str]
    series: TableDocument | None
    draws: TableDocument | None
    timeout: float | None
    fmus: Mapping[str, Mapping[str, str]]
    resets: Mapping[str, ResetDocument]
    until_decided: bool
    seed: int
    trials: int
    shard_size: int
    elementary_functions: int | None = None
    identities: Mapping[str, str] | None = None

    def document(self) -> dict[str, object]:
        """Return the manifest as JSON, without keys that an earlier version lacks, so that its digest is unchanged."""
        content: dict[str, object] = json.loads(json.dumps(asdict(self)))
        for name in ("elementary_functions", "identities"):
            if content[name] is None:
                del content[name]
        return content

    def names(self) -> list[str]:
        """Return the names of the contents that it refers to, each once."""
        tables = [table["content"] for table in (self.series, self.draws) if table is not None]
        return sorted({*self.system["files"].values(), *self.elsewhere.values(), *_contents(self.campaign), *tables})

    def write(self, folder: Path) -> None:
        write_atomically(folder / FILE, f"{json.dumps(self.document(), indent=1)}\n".encode())


def _contents(campaign: SourceDocument) -> list[str]:
    """Return the contents of a campaign's file, of its tables, and of the files that it extends."""
    attached = (table["content"] for table in campaign.get("attached", {}).values())
    return [campaign["content"], *attached, *(name for part in campaign.get("extends", []) for name in _contents(part))]


def read_manifest(folder: Path) -> CampaignManifest:
    """Return the manifest in a folder, which is untrusted. Raises InputError."""
    path = folder / FILE
    content = read_regular(path, WRITE, INPUT_BYTES.limit)
    check_folders(folder, "replace it with a folder")
    try:
        document = msgspec.json.decode(content, type=dict[str, msgspec.Raw])
        manifest = msgspec.json.decode(content, type=CampaignManifest)
    except msgspec.ValidationError as error:
        problem, _, element = str(error).partition(" - at ")
        raise InputError(path, element.strip("`$."), f"{problem[:1].lower()}{problem[1:]}", SAME_VERSION) from error
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise InputError(path, "", f"not JSON: {error}", WRITE) from error
    unknown = sorted(set(document) - {field.name for field in fields(CampaignManifest)})
    if unknown:
        raise InputError(path, unknown[0], "unknown to this version of perilune", SAME_VERSION)
    _check_manifest(manifest, path)
    return manifest


def _check_manifest(manifest: CampaignManifest, path: Path) -> None:
    """Reject numbers out of bounds, and contents with names other than hashes."""
    for name, number in (("trials", manifest.trials), ("shard_size", manifest.shard_size)):
        TRIALS.check(number, path, name)
        if number < 1:
            raise InputError(path, name, f"{number}, not a positive number", SAME_VERSION)
    for name in manifest.names():
        if not NAMED.fullmatch(name) or "/" in name or "\\" in name:
            raise InputError(path, name, "not a SHA-256 hash", SAME_VERSION)
    fmu = manifest.system["fmu"]
    if fmu is not None and fmu not in manifest.system["files"]:
        raise InputError(path, "system.fmu", f"the system has no file {fmu}", SAME_VERSION)


NAMED = re.compile(r"[0-9a-f]{64}(\..*)?")
COPY_AGAIN = "copy the campaign's folder again, with all of its files"


def content_name(content: bytes, suffix: str) -> str:
    return f"{hashlib.sha256(content).hexdigest()}{suffix}"


def store_contents(folder: Path, contents: dict[str, bytes]) -> None:
    """Write contents under their names, unless they exist already."""
    for name, content in contents.items():
        if not (folder / name).is_file():
            write_atomically(folder / name, content)


def remove_contents(folder: Path) -> None:
    """Remove the contents from a folder; other files stay."""
    for path in folder.glob("*"):
        if NAMED.fullmatch(path.name):
            path.unlink()


def content_path(folder: Path, name: str) -> Path:
    """Return the path of a content, after checking its hash against its name. Raises InputError."""
    path = folder / name
    content = read_regular(path, COPY_AGAIN, INPUT_BYTES.limit)
    if content_name(content, path.suffix) != name:
        raise InputError(path, "", "its SHA-256 does not match its name", COPY_AGAIN)
    return path
