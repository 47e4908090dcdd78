"""`perilune.inventory` and `perilune list`: what there is to simulate."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from fmpy import read_model_description

from ...fmus_src.block import Block
from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.available import fmu_flavours
from ...fmus_src.paths import LAWS, SEARCHES
from ..runtime.ssp.archive import SystemArchive, open_system, system_names
from ..runtime.ssp.reading import read_description
from ..stability.request.reading import read_declaration
from .common.description_text import wrap
from .options.library import LIST
from .options.verb import verb
from .result import NoProblems

TITLE = 18  # columns of a title


@dataclass(frozen=True)
class SystemFiles:
    """What a system has by name: parameter sets, campaigns, loops."""

    parameter_sets: tuple[str, ...]
    campaigns: tuple[str, ...]
    loops: tuple[str, ...]


@dataclass(frozen=True)
class FmuEntry:
    """An FMU: the interface that makes it swappable (None without one), its description, which flavours are built."""

    interface: str | None
    description: str
    built: tuple[str, ...]


@dataclass(frozen=True)
class Inventory(NoProblems):
    """``systems`` and ``fmus`` by name, those of the working folder too; names of ``laws`` and ``searches``."""

    systems: Mapping[str, SystemFiles]
    laws: tuple[str, ...]
    searches: tuple[str, ...]
    fmus: Mapping[str, FmuEntry]

    def lines(self) -> list[str]:
        """What `perilune list` prints."""
        lines = []
        for name, system in self.systems.items():
            lines.append(name)
            for title, names in asdict(system).items():
                lines += wrap(f"  {title.replace('_', ' '):{TITLE - 2}}{', '.join(names) or 'none'}", TITLE)
        lines += wrap(f"{'laws':{TITLE}}{', '.join(self.laws)}", TITLE)
        lines += [*wrap(f"{'searches':{TITLE}}{', '.join(self.searches)}", TITLE), "FMUs"]
        width = max((len(name) for name in self.fmus), default=0)
        for name, fmu in self.fmus.items():
            built = "+".join(fmu.built) or "not built"
            lines += wrap(f"  {name:{width}}  {built:13}  {fmu.description}", width + 19)
        return lines

    def to_json(self) -> dict[str, object]:
        """The same for other programs."""
        return asdict(self)


@verb(LIST)
def inventory() -> Inventory:
    """List what there is to simulate: `perilune list`.

    Systems with their parameter sets, campaigns and loops; laws; searches; FMUs, those of the working folder too.
    """
    return Inventory(
        {name: _system(open_system(name)) for name in system_names()},
        tuple(sorted(path.stem for path in LAWS.glob("*.json"))),
        tuple(sorted(path.stem for path in SEARCHES.glob("*.toml"))),
        _fmus(),
    )


def _system(archive: SystemArchive) -> SystemFiles:
    return SystemFiles(
        tuple(sorted(Path(name).name for name in archive.files if name.endswith(".ssv"))),
        tuple(sorted(archive.campaign_names())),
        tuple(loop.name for loop in read_declaration(read_description(archive)).loops),
    )


def _interface(block: type[Block]) -> str | None:
    """The interface that makes a block swappable: the class right below Block; None without one."""
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
