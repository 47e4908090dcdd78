"""Reader of the FMI-LS-REF manifest in an FMU or a system, written by any tool; violations of the schema are listed."""

from __future__ import annotations

import hashlib
import posixpath
import re
from collections.abc import Mapping
from dataclasses import dataclass
from urllib.parse import unquote, urlsplit

from lxml import etree

from ...common.errors import InputError
from ...fmus_src.evidence.manifest import CHECKSUM, MANIFEST, NAMESPACE, STANDARD, STUDY
from ..runtime.ssp.documents import parse_xml

ROOT = "fmiReferences"
ATTRIBUTES = ("name", "version", "description")
ROLES = re.compile(
    "document|requirement|specification|model|parameter|system|testcase|"
    "experiment(/(smoke-test|validation|uncertainty-analysis))?|result|method|rationale|report|request|delivery|"
    "configuration|signature|serialized-state(/.*)?|meta-data|other"
)
ALGORITHMS = {f"SHA-{bits}": f"sha{bits}" for bits in (224, 256, 384, 512)} | {
    f"SHA3-{bits}": f"sha3_{bits}" for bits in (224, 256, 384, 512)
}


@dataclass(frozen=True)
class RelatedFile:
    """A file listed in a manifest.

    ``name`` is its name in the archive, or None if the file is elsewhere; ``checksum`` is None if the manifest states
    none. ``study`` is set for a report by Perilune: it names the reported campaign, or the stability study.
    """

    source: str
    name: str | None
    role: str
    type: str
    checksum: str | None
    algorithm: str
    study: str | None = None


@dataclass(frozen=True)
class Manifest:
    """Content of a manifest; ``flaws`` describes its violations of the schema, one line each."""

    root: etree._Element
    files: tuple[RelatedFile, ...]
    flaws: tuple[str, ...]


def read_manifest(files: Mapping[str, bytes], label: str) -> Manifest:
    """Read the manifest among an archive's files. Raises InputError if there is none, or if it is not of FMI-LS-REF."""
    if MANIFEST not in files:
        problem = f"contains no {MANIFEST}, so there is nothing to verify"
        raise InputError(label, "evidence", problem, "export it with Perilune, or add reference trajectories")
    file = f"{label}!{MANIFEST}"
    root = parse_xml(files[MANIFEST], file)
    if root.tag != ROOT:
        raise InputError(file, str(root.tag), f"the root element is not {ROOT}", "write a manifest of FMI-LS-REF")
    flaws = [
        f"line {root.sourceline}: no attribute fmi-ls-{name}"
        for name in ATTRIBUTES
        if root.get(f"{{{NAMESPACE}}}fmi-ls-{name}") is None
    ]
    name = root.get(f"{{{NAMESPACE}}}fmi-ls-name", STANDARD)
    if name != STANDARD:
        raise InputError(file, "fmi-ls-name", f"{name!r} is a different layered standard", f"write {STANDARD}")
    related = []
    for element in root.iterfind("Related"):
        line = f"Related (line {element.sourceline})"
        for required in ("source", "role"):
            if element.get(required) is None:
                flaws.append(f"{line}: no attribute {required}")
        if not ROLES.fullmatch(element.get("role", "other")):
            flaws.append(f"{line}: role {element.get('role')!r} is not defined by the standard")
        if element.get("checksumType", CHECKSUM) not in ALGORITHMS:
            flaws.append(
                f"{line}: checksumType {element.get('checksumType')!r} is not defined by the standard; the "
                "checksum was not checked"
            )
        related.append(_read_related(element))
    return Manifest(root, tuple(related), tuple(dict.fromkeys(flaws)))


def file_of(source: str, base: str) -> str | None:
    """Return the archive's file to which a URI relative to ``base`` refers, by name; None if there is no such file."""
    try:
        uri = urlsplit(source)
    except ValueError:
        return None
    name = posixpath.normpath(posixpath.join(base, unquote(uri.path)))
    return None if uri.scheme or uri.netloc or name.startswith(("/", "../")) else name


def check_listed(manifest: Manifest, files: Mapping[str, bytes]) -> dict[str, str]:
    """Return a problem, by file name, for each listed file that is missing or changed."""
    digests: dict[tuple[str, str], str] = {}  # computed once for a file listed several times
    problems = {}
    for related in manifest.files:
        name, algorithm = related.name, related.algorithm
        if name is None:
            continue
        if name not in files:
            problems[name] = "missing, though the manifest lists it"
        elif related.checksum is not None and algorithm in ALGORITHMS:
            if (name, algorithm) not in digests:
                digests[name, algorithm] = hashlib.new(ALGORITHMS[algorithm], files[name]).hexdigest()
            if digests[name, algorithm] != related.checksum.strip().lower():
                problems[name] = f"changed: its {algorithm} checksum differs from the manifest"
    return problems


def _read_related(element: etree._Element) -> RelatedFile:
    source = element.get("source", "")
    study = element.find(f"Annotations/Annotation[@type='{STUDY}']/Study")
    return RelatedFile(
        source,
        file_of(source, posixpath.dirname(MANIFEST)),
        element.get("role", "other"),
        element.get("type", "application/octet-stream"),
        element.get("checksum"),
        element.get("checksumType", CHECKSUM),
        None if study is None else study.get("name"),
    )
