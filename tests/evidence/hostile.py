"""Evidence of FMUs that is no manifest, no number, no list of digests."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from pathlib import Path

from perilune.fmus_src.evidence.manifest import FOLDER, MANIFEST, NAMESPACE, STANDARD, SUMS
from tests.hostile.case import Case, Write
from tests.support.builders import write_zip

VERIFY = ("verify x.fmu",)
ATTRIBUTES = {"name": STANDARD, "version": "1.0.0-beta.1", "description": "d"}
NAMES = " ".join(f'l:fmi-ls-{name}="{text}"' for name, text in ATTRIBUTES.items())
OUT = f"{FOLDER}/out.csv"
TOLERANT = (
    '<Experiment name="e"><References source="out.csv"/><Annotations><Annotation type="org.perilune.tolerances">'
    '<Tolerances><Signal name="y" absolute="-1"/></Tolerances></Annotation></Annotations></Experiment>'
)
LAUGHS = '<!DOCTYPE a [<!ENTITY b "ha"><!ENTITY c "&b;&b;">]><fmiReferences>&c;</fmiReferences>'


def fmu(files: Mapping[str, str | bytes]) -> Write:
    """Return a writer of x.fmu: the gain of the good FMUs with other evidence."""

    def write(folder: Path, good: Path) -> None:
        with zipfile.ZipFile(good / "gain.fmu") as archive:
            names = [name for name in archive.namelist() if not name.startswith("extra/")]
            content: dict[str, str | bytes] = {name: archive.read(name) for name in names}
        write_zip(folder / "x.fmu", content | dict(files))

    return write


def manifest(inner: str) -> dict[str, str | bytes]:
    """Return a manifest, and a trajectory."""
    return {
        MANIFEST: f'<fmiReferences xmlns:l="{NAMESPACE}" {NAMES}>{inner}</fmiReferences>',
        OUT: "time,y\n0,0\n1,0\n",
    }


def experiment(attributes: str, references: str = "out.csv") -> dict[str, str | bytes]:
    """Return a manifest of one experiment."""
    return manifest(f'<Experiment name="e" {attributes}><References source="{references}"/></Experiment>')


CASES = {
    "evidence: entities": Case(fmu({MANIFEST: LAUGHS}), VERIFY, ("fmi-ls-manifest.xml: DOCTYPE",)),
    "evidence: a time of nan": Case(
        fmu(experiment('stepSize="nan"')), VERIFY, ("Experiment (line 1), stepSize", "'nan' is not a finite number")
    ),
    "evidence: steps of 0 s": Case(
        fmu(experiment('stepSize="0"')), VERIFY, ("stepSize: '0' is not a positive number of seconds",)
    ),
    "evidence: a tolerance below 0": Case(
        fmu({MANIFEST: manifest(TOLERANT)[MANIFEST]}), VERIFY, ("Signal (line 1), absolute: '-1' is less than 0",)
    ),
    "evidence: 10^5 nested elements": Case(
        fmu({MANIFEST: "<fmiReferences>" * 100_000}), VERIFY, ("fmi-ls-manifest.xml",)
    ),
    "evidence: sums that are none": Case(
        fmu(manifest("") | {SUMS: "x" * 100}), VERIFY, ("SHA256SUMS: line 1: not in the format of sha256sum",)
    ),
    "evidence: another standard's": Case(
        fmu({MANIFEST: experiment("")[MANIFEST].replace("fmi-ls-ref", "fmi-ls-bus")}),  # type: ignore[arg-type]
        VERIFY,
        ("fmi-ls-name: 'org.fmi-standard.fmi-ls-bus' is a different layered standard",),
    ),
}
