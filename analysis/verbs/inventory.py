"""`perilune.inventory` and `perilune list`: available systems, laws, searches and FMUs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from fmpy import read_model_description

from ...common.errors import InputError
from ...common.paths import LAWS, SEARCHES
from ...fmus_src.block import Block
from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.available import fmu_flavours
from ..documents.model import Document
from ..documents.of.inventory import inventory_document
from ..options.declared.library import LIST
from ..options.verb import verb
from ..runtime.ssp.archive import SystemArchive, open_system, system_names
from ..runtime.ssp.ssd_reader import read_description
from ..stability.request.loop_declaration import read_declaration
from .common.documented import Documented

KINDS = ("systems", "campaigns", "laws", "searches", "fmus")


@dataclass(frozen=True)
class SystemFiles:
    """Description of a system, and the names of its parameter sets, campaigns and loops."""

    description: str
    parameter_sets: tuple[str, ...]
    campaigns: tuple[str, ...]
    loops: tuple[str, ...]


@dataclass(frozen=True)
class FmuEntry:
    """An FMU: its interface as a slot (or None), its description, and the flavours that are built."""

    interface: str | None
    description: str
    built: tuple[str, ...]


@dataclass(frozen=True)
class Inventory(Documented):
    """Available ``systems`` and ``fmus`` by name, also of the working folder, and names of ``laws`` and ``searches``.

    ``campaigns_only`` restricts the listing of systems to their campaigns.
    """

    systems: Mapping[str, SystemFiles]
    laws: tuple[str, ...]
    searches: tuple[str, ...]
    fmus: Mapping[str, FmuEntry]
    campaigns_only: bool = False

    def document(self) -> Document:
        """Return a document that lists systems, laws, searches and FMUs."""
        content = {name: entry for name, entry in asdict(self).items() if name != "campaigns_only"}
        return inventory_document(content, ("campaigns",)) if self.campaigns_only else inventory_document(content)

    def only(self, kind: str) -> Inventory:
        """Return the inventory restricted to one of `KINDS`."""
        if kind == "campaigns":
            systems = {name: system for name, system in self.systems.items() if system.campaigns}
            return Inventory(systems, (), (), {}, campaigns_only=True)
        return replace(Inventory({}, (), (), {}), **{kind: getattr(self, kind)})

    def matching(self, text: str) -> Inventory:
        """Return the entries that contain a text, ignoring case, in name, description or contents."""
        sought = text.casefold()
        return Inventory(
            {
                name: system
                for name, system in self.systems.items()
                if sought in "\n".join((name, *map(str, asdict(system).values()))).casefold()
            },
            tuple(name for name in self.laws if sought in name.casefold()),
            tuple(name for name in self.searches if sought in name.casefold()),
            {name: fmu for name, fmu in self.fmus.items() if sought in f"{name}\n{fmu.description}".casefold()},
        )

    @property
    def is_empty(self) -> bool:
        return not (self.systems or self.laws or self.searches or self.fmus)


@verb(LIST)
def inventory(what: str | None = None) -> Inventory:
    """List what is available: `perilune list`.

    The result contains systems with their parameter sets, campaigns and loops, laws, searches, and FMUs, including the
    FMUs of the working folder. ``what`` is one of these kinds, or a text in names or descriptions. Raises InputError if
    nothing matches.
    """
    everything = Inventory(
        {name: _system(open_system(name)) for name in system_names()},
        tuple(sorted(path.stem for path in LAWS.glob("*.json"))),
        tuple(sorted(path.stem for path in SEARCHES.glob("*.toml"))),
        _fmus(),
    )
    if what is None:
        return everything
    if what in KINDS:
        return everything.only(what)
    matches = everything.matching(what)
    if matches.is_empty:
        remedy = f"give another text, or a kind: {', '.join(KINDS)}"
        raise InputError("list", what, "no name or description contains this word", remedy)
    return matches


def _system(archive: SystemArchive) -> SystemFiles:
    description = read_description(archive)
    return SystemFiles(
        description.system.about,
        tuple(sorted(Path(name).name for name in archive.files if name.endswith(".ssv"))),
        tuple(sorted(archive.campaign_names())),
        tuple(loop.name for loop in read_declaration(description).loops),
    )


def _interface(block: type[Block]) -> str | None:
    """Return the interface of a block, its base class directly below Block; None if there is none."""
    base = block.__mro__[block.__mro__.index(Block) - 1]
    return base.__name__ if base is not block else None


def _fmus() -> dict[str, FmuEntry]:
    built = fmu_flavours()
    fmus = {
        name: FmuEntry(_interface(block), block.summary(), tuple(built.get(name, ())))
        for name, block in catalogue().items()
    }
    for name, files in built.items():
        if name not in fmus:
            description = read_model_description(str(next(iter(files.values()))), validate=False).description or ""
            fmus[name] = FmuEntry(None, description, tuple(files))
    return fmus
