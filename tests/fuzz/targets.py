"""Fuzz targets in Python: by name a function from a separate folder to a test of hypothesis."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from tests.fuzz import documents, tables
from tests.fuzz.documents import Target
from tests.fuzz.folders import any_manifest, any_shard, make_folder
from tests.support.builders import build_tiny_fmus
from tests.support.graphs.random_systems import any_flight


def _of_document(make: Callable[[Path, Path], Target]) -> Callable[[Path], Target]:
    def target(folder: Path) -> Target:
        build_tiny_fmus(folder / "fmus")
        return make(folder / "fmus", folder)

    return target


TARGETS: dict[str, Callable[[Path], Target]] = {
    "manifests": lambda folder: any_manifest(make_folder(folder / "campaign")),
    "shards": lambda folder: any_shard(make_folder(folder / "campaign")),
    "systems": _of_document(documents.any_system),
    "systems_with_arrays": _of_document(documents.any_system_with_arrays),
    "parameter_sets": _of_document(documents.any_parameter_set),
    "parameter_sets_with_arrays": _of_document(documents.any_parameter_set_with_arrays),
    "campaigns": _of_document(documents.any_campaign),
    "descriptions": _of_document(documents.any_description),
    "fmi3_descriptions": _of_document(documents.any_fmi3_description),
    "mappings": _of_document(tables.any_mapping),
    "inputs": _of_document(tables.any_series),
    "draws": _of_document(tables.any_draws),
    "expressions": _of_document(tables.any_expression),
    "archives": _of_document(tables.any_archive),
    "flights": _of_document(any_flight),
}
