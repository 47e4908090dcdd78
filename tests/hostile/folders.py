"""Folders of campaigns with files that are no files, far too large or of other forms; of manifests more is tested
in tests/campaigns/execute/shards/test_hostile_folders.py.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path

from perilune.analysis.cli import main

from .campaigns import GOOD, campaign_file
from .case import Case, Write
from .kinds import large

SHARD, MANIFEST, SUMMARY, DRAWS = "trials/000000.parquet", "manifest.json", "summary.json", "draws.parquet"
TRACED = GOOD.replace("[success]", '[record]\nevery = 1\nsignals = ["ramp.y"]\ntraces = "all"\n[success]')


@cache
def good(fmus: Path) -> Path:
    """Return the folder of a simulated campaign."""
    folder = fmus.parent / f"campaign_{os.getpid()}"  # of this worker alone
    folder.mkdir()
    campaign_file(TRACED)(folder, fmus)
    command = ["batch", str(folder / "good.ssp"), "--campaign", str(folder / "hostile.toml"), "--workers", "1"]
    assert main([*command, "--output", str(folder / "out")]) == 0
    return folder / "out"


def changed(name: str, change: Callable[[Path], object]) -> Write:
    """Return a writer of the folder with one file changed or added; `*` is the first file of a folder."""

    def write(folder: Path, fmus: Path) -> None:
        shutil.copytree(good(fmus), folder / "out")
        path = folder / "out" / name
        path = sorted(path.parent.iterdir())[0] if path.name == "*" else path
        if path.is_dir():
            shutil.rmtree(path)
        path.unlink(missing_ok=True)
        change(path)

    return write


def edited(name: str, change: Callable[[dict], object]) -> Write:
    """Return a writer of the folder with another JSON document."""

    def write(folder: Path, fmus: Path) -> None:
        shutil.copytree(good(fmus), folder / "out")
        path = folder / "out" / name
        document = json.loads(path.read_text())
        change(document)
        path.write_text(json.dumps(document))

    return write


def text(content: str | bytes) -> Callable[[Path], object]:
    return lambda path: path.write_bytes(content.encode() if isinstance(content, str) else content)


def linked(path: Path) -> None:
    path.symlink_to("/etc/passwd")


MERGE, COMPARE, REPLAY, SHARDS = "merge out", "compare out", "replay out 0", "shard out 0"
KINDS: dict[str, Callable[[Path], object]] = {
    "a pipe": os.mkfifo,
    "a link": linked,
    "a device": lambda path: path.symlink_to("/dev/zero"),
    "a folder": lambda path: path.mkdir(),
    "5 GB": large,
    "nothing": text(b""),
}
READERS = {
    MANIFEST: (MERGE, REPLAY, SHARDS),
    SUMMARY: (COMPARE,),
    DRAWS: (COMPARE, REPLAY),
    SHARD: (MERGE, COMPARE),
    "files/*": (MERGE, REPLAY),
}
CASES = {
    f"folder: {kind} for {name}": Case(changed(name, make), commands, (Path(name).name.replace("*", ""),))
    for name, commands in READERS.items()
    for kind, make in KINDS.items()
}
DIGITS = "9" * 1_000_000
DEEP = "[" * 100_000 + "]" * 100_000
FORMS: dict[str, tuple[Write, tuple[str, ...], tuple[str, ...]]] = {
    "a manifest 10^5 deep": (changed(MANIFEST, text(DEEP)), (MERGE, REPLAY), (MANIFEST,)),
    "a manifest of 10^6 digits": (
        changed(MANIFEST, text(f'{{"trials": {DIGITS}}}')),
        (MERGE,),
        (MANIFEST,),
    ),
    "a manifest of NaN": (changed(MANIFEST, text("NaN")), (MERGE,), (MANIFEST,)),
    "a manifest not UTF-8": (changed(MANIFEST, text(b'{"\xff": 1}')), (MERGE,), (MANIFEST,)),
    "a manifest with escapes": (edited(MANIFEST, lambda it: it.update({"\x1b[2J\u202e": 1})), (MERGE,), (MANIFEST,)),
    "a manifest of 5 x 10^5 lists": (changed(MANIFEST, text("[" + "[]," * 500_000 + "[]]")), (MERGE,), (MANIFEST,)),
    "a summary 10^5 deep": (changed(SUMMARY, text(DEEP)), (COMPARE,), (SUMMARY,)),
    "a summary of a number": (changed(SUMMARY, text("1")), (COMPARE,), (SUMMARY,)),
    "a summary of 10^6 digits": (changed(SUMMARY, text(DIGITS)), (COMPARE,), (SUMMARY,)),
    "a summary not UTF-8": (changed(SUMMARY, text(b"\xff")), (COMPARE,), (SUMMARY,)),
    "a trials folder that is a link": (
        changed("trials", lambda path: path.symlink_to("/tmp")),
        (MERGE, SHARDS),
        ("trials", "a link, not a folder"),
    ),
    "a folder of traces that is a link": (
        changed("traces/default", lambda path: path.symlink_to("/tmp")),
        (SHARDS,),
        ("default", "a link, not a folder"),
    ),
    "a trials folder that is a pipe": (changed("trials", os.mkfifo), (MERGE,), ("trials",)),
    "a shard of text": (changed(SHARD, text("x" * 10_000)), (MERGE,), ("000000.parquet",)),
    "a negative seed": (edited(MANIFEST, lambda it: it.update(seed=-1)), (MERGE,), ("seed",)),
    "10^18 trials": (edited(MANIFEST, lambda it: it.update(trials=10**18)), (MERGE, SHARDS), (MANIFEST, "trials")),
}
CASES |= {f"folder: {name}": Case(*case) for name, case in FORMS.items()}
CASES |= {
    f"folder: {command}": Case(changed("x", text("")), (command,), (element,))
    for command, element in {
        "shard out 1000000000000000000": "shard",
        "shard out 0-1000000000000": "shard",
        "shard out -1": "-1",
        "replay out 1000000000000000000": "trial",
        "replay out -1": "-1",
        "merge /dev/zero": "/dev/zero",
        "merge nothing": "nothing",
        "compare /etc": "/etc",
        "compare nothing\u202e": "nothing",
    }.items()
}
