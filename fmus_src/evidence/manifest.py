"""Manifest of the evidence of an FMU or system: role and digest of each file.

Format: FMI Layered Standard for References (FMI-LS-REF), Modelica Association 2025, for FMI 2.0 and 3.0.
"""

from __future__ import annotations

import hashlib
import posixpath
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from urllib.parse import quote

from lxml import etree

STANDARD = "org.fmi-standard.fmi-ls-ref"
FOLDER = f"extra/{STANDARD}"
MANIFEST = f"{FOLDER}/fmi-ls-manifest.xml"
NAMESPACE = "http://fmi-standard.org/fmi-ls-manifest"
VERSION = "1.0.0-beta.1"
DESCRIPTION = "Layered Standard providing information on related files included in an FMU."
CHECKSUM = "SHA3-256"  # the standard's default
SUMS = f"{FOLDER}/SHA256SUMS"
NOT_LISTED = (MANIFEST, SUMS)

STUDY = "org.perilune.study"
STABILITY = "stability"

CSV = "text/csv"
PARAMETERS = "application/x-ssp-parameter-set"
EXPERIMENTS = "application/x-ma-hs-experiments"
MIME_TYPES = {
    ".csv": CSV,
    ".exp": EXPERIMENTS,
    ".fmu": "application/x-fmu-sharedlibrary",
    ".html": "text/html",
    ".json": "application/json",
    ".md": "text/markdown",
    ".parquet": "application/vnd.apache.parquet",
    ".pdf": "application/pdf",
    ".png": "image/png",
    ".ssb": "application/x-ssp-signal-dictionary",
    ".ssd": "application/x-ssp-definition",
    ".ssm": "application/x-ssp-parameter-mapping",
    ".ssv": PARAMETERS,
    ".svg": "image/svg+xml",
    ".toml": "application/toml",
    ".txt": "text/plain",
}


def mime_type(name: str) -> str:
    """Return the MIME type of a file by its suffix."""
    return MIME_TYPES.get(posixpath.splitext(name)[1].lower(), "application/octet-stream")


@dataclass(frozen=True)
class Related:
    """File of the archive at the path ``name``, with its role in FMI-LS-REF and its MIME ``type``."""

    name: str
    role: str
    type: str
    description: str
    study: str | None = None  # for a report: the name of its campaign, or `STABILITY`


def add_manifest(files: Mapping[str, bytes], related: Sequence[Related]) -> dict[str, bytes]:
    """Return the files of an archive with the manifest and with SHA256SUMS, a list in the format of sha256sum."""
    sums = "".join(
        f"{hashlib.sha256(files[name]).hexdigest()}  {name}\n" for name in sorted(files) if name not in NOT_LISTED
    )
    complete = {**files, SUMS: sums.encode()}
    listed = Related(SUMS, "meta-data", "text/plain", "SHA-256 of every file but this one and the manifest")
    return {**complete, MANIFEST: _write_manifest(complete, [*related, listed])}


def _write_manifest(files: Mapping[str, bytes], related: Sequence[Related]) -> bytes:
    root = etree.Element("fmiReferences", nsmap={"fmi-ls": NAMESPACE})
    for name, text in (("name", STANDARD), ("version", VERSION), ("description", DESCRIPTION)):
        root.set(f"{{{NAMESPACE}}}fmi-ls-{name}", text)
    for each in related:
        element = etree.SubElement(
            root,
            "Related",
            type=each.type,
            source=quote(posixpath.relpath(each.name, FOLDER)),
            role=each.role,
            description=each.description,
            checksum=hashlib.sha3_256(files[each.name]).hexdigest(),
            checksumType=CHECKSUM,
        )
        if each.study is not None:
            annotation = etree.SubElement(etree.SubElement(element, "Annotations"), "Annotation", type=STUDY)
            etree.SubElement(annotation, "Study", name=each.study)
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
