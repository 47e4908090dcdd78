"""Pipes, devices, folders and links where files are expected, and files that are too large to read."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from tests.support.builders import component, document, pack, system
from tests.support.refused import GAIN, RAMP

from .campaigns import GOOD
from .case import Case, Write


def large(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(5_000_000_000)  # sparse


KINDS: dict[str, Callable[[Path], object]] = {
    "a pipe": os.mkfifo,
    "a device": lambda path: path.symlink_to("/dev/zero"),
    "a folder": lambda path: path.mkdir(),
    "a link to itself": lambda path: path.symlink_to(path),
    "5 GB": large,
}
READERS = {
    "a.ssp": "run a.ssp",
    "a.fmu": "run a.fmu",
    "b.fmu": "validate b.fmu",
    "c.fmu": "run good.ssp --use ramp=c.fmu",
    "a.ssv": "validate a.ssv",
    "b.ssv": "run good.ssp --parameters b.ssv",
    "a.csv": "run good.ssp --input a.csv --open-inputs start",
    "a.toml": "validate a.toml",
    "b.toml": "batch good.ssp --campaign b.toml --output out",
    "c.toml": "design search c.toml",
    "a.parquet": "batch good.ssp --campaign good.toml --draws a.parquet --output out",
    "a.json": "validate a.json",
    "lookup.csv": "batch good.ssp --campaign lookup.toml --output out",
    "inside/SystemStructure.ssd": "run inside",
    "alone/OspSystemStructure.xml": "run alone/OspSystemStructure.xml",
    "within/ramp.fmu": "run within",
    "within/a.ssv": "run within --parameters a.ssv",
    "within/campaigns/a.toml": "batch within --campaign a --output out",
}
LOOKUP = '[lookup.bound]\nfile = "lookup.csv"\ncolumn = "x"\ninputs = { one = 1 }\n'
NAMED = {"within/campaigns/a.toml": "campaign"}  # in other words than by its file


def in_place_of(name: str, make: Callable[[Path], object]) -> Write:
    def write(folder: Path, fmus: Path) -> None:
        pack(folder / "good.ssp", fmus, document(system(RAMP, GAIN)))
        (folder / "good.toml").write_text(GOOD)
        (folder / "lookup.toml").write_text(GOOD + LOOKUP)
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if name.startswith("within/"):
            (folder / "within" / "ramp.fmu").write_bytes((fmus / "ramp.fmu").read_bytes())
            (folder / "within" / "SystemStructure.ssd").write_text(
                document(system(component("ramp", "ramp.fmu").replace("resources/", "")))
            )
        path.unlink(missing_ok=True)
        make(path)

    return write


CASES = {
    f"{kind} for {name}": Case(in_place_of(name, make), (command,), (NAMED.get(name, Path(name).name),))
    for name, command in READERS.items()
    for kind, make in KINDS.items()
}
