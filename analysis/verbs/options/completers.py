"""Completers for a shell: names of systems, campaigns, parameter sets and FMUs, as far as they are cheap to find."""

from __future__ import annotations

import argparse
from pathlib import Path

from argcomplete.completers import FilesCompleter

from ....common.errors import InputError
from ....common.paths import LAWS, SEARCHES
from ....fmus_src.export.available import fmu_flavours
from ...runtime.ssp.archive import SystemArchive, open_system, system_names
from ...runtime.ssp.ssd_reader import read_description
from ...runtime.ssp.system_description import Component

SLOT_TEMPLATES = Path(__file__).parents[2] / "authoring" / "templates" / "slots"


def csv_files(prefix: str, **_: object) -> list[str]:
    return _paths(prefix, "csv")


def parquet_files(prefix: str, **_: object) -> list[str]:
    return _paths(prefix, "parquet")


def systems(prefix: str, **_: object) -> list[str]:
    return [*system_names(), *_paths(prefix, "ssp")]


def systems_and_fmu_files(prefix: str, **_: object) -> list[str]:
    return [*system_names(), *_paths(prefix, "ssp", "fmu")]


def systems_and_files(prefix: str, **_: object) -> list[str]:
    return [*system_names(), *_paths(prefix)]


def fmus(prefix: str, **_: object) -> list[str]:
    return [*fmu_flavours(), *_paths(prefix, "fmu")]


def systems_and_fmus(prefix: str, **_: object) -> list[str]:
    return [*system_names(), *fmu_flavours(), *_paths(prefix)]


def campaigns(prefix: str, parsed_args: argparse.Namespace, **_: object) -> list[str]:
    archive = _system(parsed_args)
    return [*(archive.campaign_names() if archive is not None else ()), *_paths(prefix, "toml")]


def parameter_sets(prefix: str, parsed_args: argparse.Namespace, **_: object) -> list[str]:
    return [*_inside(parsed_args, ".ssv"), *_paths(prefix, "ssv")]


def slots_with_fmus(prefix: str, parsed_args: argparse.Namespace, **_: object) -> list[str]:
    """Return ``SLOT=`` for each component of the system, or after a slot ``SLOT=FMU`` for each FMU."""
    slot, equals, remainder = prefix.partition("=")
    if equals:
        return [f"{slot}={name}" for name in fmus(remainder)]
    archive = _system(parsed_args)
    if archive is None:
        return []
    try:
        elements = read_description(archive).system.elements
    except InputError:  # the command itself will report it
        return []
    return [f"{name}=" for name, element in elements.items() if isinstance(element, Component)]


def laws(prefix: str, **_: object) -> list[str]:
    return [*(path.stem for path in LAWS.glob("*.json")), *_paths(prefix, "json")]


def searches(prefix: str, **_: object) -> list[str]:
    return [*(path.stem for path in SEARCHES.glob("*.toml")), *_paths(prefix, "toml")]


def block_slots(prefix: str, **_: object) -> list[str]:
    return sorted(path.name.partition(".")[0] for path in SLOT_TEMPLATES.glob("*.py.jinja"))


def _system(parsed_args: argparse.Namespace) -> SystemArchive | None:
    """Return the system named on the command line so far."""
    try:
        return open_system(parsed_args.system) if getattr(parsed_args, "system", None) else None
    except InputError:
        return None


def _inside(parsed_args: argparse.Namespace, suffix: str, stem: bool = False) -> list[str]:
    archive = _system(parsed_args)
    paths = [Path(name) for name in archive.files if name.endswith(suffix)] if archive is not None else []
    return sorted(path.stem if stem else path.name for path in paths)


def _paths(prefix: str, *suffixes: str) -> list[str]:
    return list(FilesCompleter(suffixes)(prefix))
