"""Manifest of a campaign, a JSON file: all inputs that determine its numbers, with contents named by their SHA-256."""

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
from .shard_files import check_folders

FILE = "manifest.json"
CONTENTS = "files"  # folder of the contents, next to the manifest
SAME_VERSION = "resume with the version of perilune that wrote this file"
WRITE = "give a folder that perilune batch or prepare wrote"


class ResetDocument(TypedDict):
    """`ResetVerdict` in a manifest; earlier versions of it have ``resets`` instead of ``renewal``."""

    renewal: NotRequired[Renewal]
    resets: NotRequired[bool]
    reason: str


class TableDocument(TypedDict):
    """Table supplied by the user: its label, the SHA-256 of its file, and the name of its content."""

    label: str
    sha256: str
    content: str


class SystemDocument(TypedDict):
    """System of a campaign; ``files`` maps archive names to contents, ``fmu`` is the name of a stand-alone FMU."""

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
    """Campaign file, with the files that it extends; its entries are merged after ``position`` of these files.

    ``attached`` contains the tables of its lookups, by the paths that it states.
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

    - ``elsewhere``: contents outside the ``system``, by the key of their use
    - ``options``: system options
    - ``faults``: the user's faults
    - ``series``, ``draws``: inputs over time, and supplied draws (label, sha256, content)
    - ``timeout``: limit on each simulation, s
    - ``fmus``: hashes of FMUs by variant and component
    - ``resets``: verdicts of reset tests by hash
    - ``until_decided``: True if the campaign ends with the shard in which its requirements are decided
    - ``shard_size``: number of trials of each variant in a shard
    - ``elementary_functions``: their version, on which the last bits depend; None for earlier campaigns, which used
      the functions of the C library
    - ``identities``: identities of FMUs by hash, for FMUs that other files can replace; None for earlier campaigns
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
        """Return the manifest as JSON.

        Keys unknown to earlier versions are omitted if they are None, so that digests do not change.
        """
        content: dict[str, object] = json.loads(json.dumps(asdict(self)))
        for name in ("elementary_functions", "identities"):
            if content[name] is None:
                del content[name]
        return content

    def names(self) -> list[str]:
        """Return the names of the contents to which the manifest refers, each once."""
        tables = [table["content"] for table in (self.series, self.draws) if table is not None]
        return sorted({*self.system["files"].values(), *self.elsewhere.values(), *_contents(self.campaign), *tables})

    def write(self, folder: Path) -> None:
        write_atomically(folder / FILE, f"{json.dumps(self.document(), indent=1)}\n".encode())


def _contents(campaign: SourceDocument) -> list[str]:
    """Return the names of the contents of a campaign's file, of its tables, and of the files that it extends."""
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
    """Write contents to files with their names, unless they exist already."""
    for name, content in contents.items():
        if not (folder / name).is_file():
            write_atomically(folder / name, content)


def remove_contents(folder: Path) -> None:
    """Remove the contents from a folder, but no other files."""
    for path in folder.glob("*"):
        if NAMED.fullmatch(path.name):
            path.unlink()


def content_path(folder: Path, name: str) -> Path:
    """Return the path of a content after comparing its hash with its name. Raises InputError."""
    path = folder / name
    content = read_regular(path, COPY_AGAIN, INPUT_BYTES.limit)
    if content_name(content, path.suffix) != name:
        raise InputError(path, "", "its SHA-256 does not match its name", COPY_AGAIN)
    return path
