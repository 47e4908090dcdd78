"""What is fuzzed in Python: by name a function that makes a test of hypothesis, given a folder of its own."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from tests.fuzz.folders import any_manifest, any_shard, make_folder

TARGETS: dict[str, Callable[[Path], Callable[[], None]]] = {
    "manifests": lambda folder: any_manifest(make_folder(folder / "campaign")),
    "shards": lambda folder: any_shard(make_folder(folder / "campaign")),
}
