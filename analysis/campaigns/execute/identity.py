"""Identity of a campaign: the inputs that determine its numbers, without names, limits and flavours of FMUs."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from typing import Any

from ....fmus_src.export.identity import guid_of_module
from ...runtime.system.fmu import Fmu
from ..folder.campaign_manifest import CampaignManifest

LIMITS = ("call_timeout", "memory")  # options that may end trials but change no results
MOST_DIFFERENCES = 3  # most differences named in one line
SCRIPT = "resources/slavemodule.txt"  # file of pythonfmu with the name of the module that an FMU runs


def identity_of(fmu: Fmu) -> str:
    """Return the identity of an FMU: for both flavours of Perilune's blocks, the GUID of the native FMU.

    For other FMUs it is the SHA-256 of the file, also for Python FMUs with a block that is not installed here or has
    other sources.
    """
    if not fmu.is_self_contained:
        return fmu.digest
    if fmu.is_native:
        return str(fmu.description.guid)
    module = (fmu.folder / SCRIPT).read_text(encoding="utf-8").strip()
    return guid_of_module(fmu.name, module) or fmu.digest


def campaign_key(manifest: CampaignManifest) -> str:
    """Return the identity of a campaign, independent of its number of trials.

    It does not depend on names of the system and of files, on the executor, on limits of time and memory, or on the
    flavour of Perilune's FMUs, except for a manifest of an earlier version.
    """
    document = {**manifest.document(), "trials": None}
    if manifest.identities is not None:
        document = _content(document, manifest.identities)
    return hashlib.sha256(json.dumps(document, sort_keys=True).encode()).hexdigest()


def differences(stored: CampaignManifest, requested: CampaignManifest) -> str:
    """Return the differences of two manifests as a phrase.

    The phrase is empty if only the number of trials, names and limits differ; in a manifest of an earlier version
    limits count as differences.
    """
    one, other = ({**_without_names(manifest.document()), "trials": None} for manifest in (stored, requested))
    for document in (one, other):
        for name in ("identities", "resets"):  # they depend on this machine
            document.pop(name, None)
        if stored.identities is not None:
            _drop_limits(document)
    phrases = [
        f"{name} was {_short(left)}, is {_short(right)}" for name, left, right in _iterate_differences("", one, other)
    ]
    more = f"; and {len(phrases) - MOST_DIFFERENCES} more" if len(phrases) > MOST_DIFFERENCES else ""
    return "; ".join(phrases[:MOST_DIFFERENCES]) + more


def _content(document: dict[str, Any], identities: Mapping[str, str]) -> dict[str, Any]:
    """Return a manifest's document with FMUs replaced by their identities, without entries that affect no number."""

    def identify(stored: str) -> str:
        return identities.get(stored.partition(".")[0], stored)

    content = _without_names(document)
    _drop_limits(content)
    content["options"].pop("flavour", None)
    del content["identities"], content["resets"], content["system"]["sha256"]
    files = {name: identify(stored) for name, stored in content["system"]["files"].items()}
    is_alone = content["system"].pop("fmu") is not None
    content["system"]["files"] = sorted(files.values()) if is_alone else files
    content["elsewhere"] = {request: identify(name) for request, name in content["elsewhere"].items()}
    content["fmus"] = {
        variant: {component: identify(digest) for component, digest in fmus.items()}
        for variant, fmus in content["fmus"].items()
    }
    return content


def _drop_limits(document: dict[str, Any]) -> None:
    document["timeout"] = None
    document["options"] = {name: content for name, content in document["options"].items() if name not in LIMITS}


def _without_names(document: Any) -> Any:
    """Return a manifest's document without the user's names of the system, the campaign's files and tables."""
    if isinstance(document, list):
        return [_without_names(each) for each in document]
    if not isinstance(document, dict):
        return document
    content = {name: _without_names(each) for name, each in document.items() if name not in ("label", "compared_by")}
    if "system" in content:
        del content["system"]["name"]
    return content


def _iterate_differences(name: str, left: object, right: object) -> Iterator[tuple[str, object, object]]:
    """Yield the dotted name and both values of each entry that differs between two documents."""
    if isinstance(left, dict) and isinstance(right, dict):
        for key in {**left, **right}:
            yield from _iterate_differences(f"{name}.{key}" if name else key, left.get(key), right.get(key))
    elif left != right:
        yield name, left, right


def _short(content: object) -> str:
    text = "nothing" if content is None else content if isinstance(content, str) else json.dumps(content)
    return text if len(text) <= 40 else f"{text[:16]}..."
