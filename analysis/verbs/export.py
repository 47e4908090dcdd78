"""`perilune.export` and `perilune export`: an FMU, a system with its FMUs inside, or the blocks of a file, built."""

from __future__ import annotations

import os
import shutil
import tempfile
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, Unpack

from ...fmus_src.block import Block
from ...fmus_src.catalogue import catalogue
from ...fmus_src.evidence.block import add_evidence
from ...fmus_src.export.archive import read_zip, write_zip
from ...fmus_src.export.available import fmu_file
from ...fmus_src.export.compilers import PLATFORMS, CompilationFailed, CompilerMissing, available_platforms
from ...fmus_src.export.judge.subset import SubsetError
from ...fmus_src.export.native_fmu import build_native_fmu
from ...fmus_src.export.own_blocks import build_own_blocks, defines, files_with, own_blocks
from ...fmus_src.export.pythonfmu_fmu import build_python_fmu
from ...fmus_src.export.sources import record_source, remove_outdated
from ...fmus_src.export.ssp_package import SSD_NAMESPACE, pack_system
from ...fmus_src.paths import FLAVOURS, IS_CHECKOUT, own_fmu, own_fmus, shipped_fmu
from ..common.atomic import write_atomically
from ..common.errors import InputError, SeveralProblemsError, suggestion
from ..common.targets import check_file
from ..evidence.system import add_system_evidence, check_studies
from ..runtime.ssp.archive import SystemArchive, open_system, system_names
from ..runtime.ssp.documents import parse_xml
from ..runtime.ssp.version_2.package import convert_package
from .options.library import EXPORT, ExportOptions
from .options.option import FilePath
from .options.verb import verb
from .result import NoProblems

Flavour = Literal["native", "python"]


@dataclass(frozen=True)
class Exported(NoProblems):
    """What was written, in which flavours, for which platforms: none where all of it is Python."""

    paths: tuple[Path, ...]
    flavours: tuple[str, ...]
    platforms: tuple[str, ...]

    def lines(self) -> list[str]:
        """What `perilune export` prints: a path each."""
        return [str(path) for path in self.paths]

    def to_json(self) -> dict[str, object]:
        """The same for other programs."""
        return {"paths": self.lines(), "flavours": list(self.flavours), "platforms": list(self.platforms)}


@verb(EXPORT)
def export(name: FilePath, **options: Unpack[ExportOptions]) -> Exported:
    """Build an FMU, a system as one .ssp with its FMUs, or the blocks of a .py file: `perilune export`.

    ``name`` is a block's, a system's (or its folder), or a file; a block of one's own is looked up by its name in the
    .py files of the working folder. ``platforms`` are of native FMUs (linux64, win64, darwin64), by default those that
    are prebuilt, or for which a compiler is installed; ``flavour`` is native by default, of a file both where one
    is installed; of a system ``ssp`` is the version of its documents, ``studies`` are campaigns, stability or all,
    whose reports the .ssp has as evidence; ``output`` is NAME.fmu or NAME.ssp in the working folder, of a file its
    build/fmus. Raises InputError, with a line for each thing that is wrong with a block.
    """
    platforms, flavour = options["platforms"], options["flavour"]
    text = os.fspath(name)
    target = None if options["output"] is None else Path(options["output"])
    if platforms and flavour == "python":
        raise InputError("`platforms`", platforms[0], "Python FMUs have no platform to choose", "leave it out")
    check_file("`output`", target)
    try:
        exported = _export(text, platforms, flavour, target, options)
    except CompilerMissing as error:
        raise InputError("export", text, "cannot be compiled here", str(error)) from error
    except CompilationFailed as error:
        raise InputError("export", text, "the compiler refused it", " ".join(str(error).split())) from error
    except InputError:
        raise
    except SubsetError as error:
        raise SeveralProblemsError(*(f"{error.block}: {violation}" for violation in error.violations)) from error
    except ValueError as error:  # of a block: its declaration, its imports
        raise SeveralProblemsError(" ".join(str(error).split())) from error
    if flavour is None and "native" not in exported.flavours and not available_platforms():
        warnings.warn("no C compiler here: the Python flavour only; pip install ziglang for both", stacklevel=2)
    return exported


def _export(
    text: str, platforms: Sequence[str], flavour: Flavour | None, target: Path | None, options: ExportOptions
) -> Exported:
    is_system = text in system_names() or (Path(text).is_dir() and text not in catalogue())
    if not is_system:
        for name, given in (("studies", ", ".join(options["studies"])), ("ssp", options["ssp"])):
            if given:
                raise InputError(f"`{name}`", given, f"{text} is no system, which it is for", "leave it out")
    if text.endswith(".py"):
        _check_there(Path(text))
        return _export_file(Path(text), platforms, flavour, target)
    own = _own_file(text)
    if own is not None:
        return _export_file(own, platforms, flavour, target, text if text in defines(own) else None)
    return _export_named(text, platforms, flavour or "native", target, options)


def _check_there(file: Path) -> None:
    """Refuse a Python file that is not there, with the names of those that are."""
    if file.is_file():
        return
    beside = [path.name for path in file.parent.glob("*.py")] if file.parent.is_dir() else []
    remedy = "give the .py file that defines the blocks"
    raise InputError(str(file), "", "no such file", f"{remedy}: {suggestion(file.name, beside)}" if beside else remedy)


def _own_file(name: str) -> Path | None:
    """The file of the working folder that a block's name means: NAME.py, or the one with a class of that name.

    None for what is known by this name otherwise, and where there is none. Raises InputError for several.
    """
    is_system = name in system_names() or Path(name, "SystemStructure.ssd").is_file()
    if not name.isidentifier() or name in catalogue() or is_system:
        return None
    file = Path(f"{name}.py")
    if file.is_file():
        return file
    files = [path for path in sorted(Path().glob("*.py")) if name in defines(path)]
    if len(files) > 1:
        raise InputError("export", name, f"defined in {', '.join(map(str, files))}", "give the file")
    return files[0] if files else None


def _export_named(
    name: str, requested: Sequence[str], flavour: Flavour, output: Path | None, options: ExportOptions
) -> Exported:
    """An FMU or a system of this repository or of a folder."""
    platforms = [] if flavour == "python" else _platforms(requested, own=False)
    blocks = catalogue()
    if name in blocks:
        path = output or Path(f"{name}.fmu")
        check_file("`output`", path, (".fmu",))
        _build(blocks[name], path, flavour, platforms)
    elif name in system_names() or Path(name).is_dir():
        path = output or Path(f"{Path(name).resolve().name}.ssp")
        check_file("`output`", path, (".ssp",))
        _export_system(open_system(name), path, flavour, platforms, options)
    else:
        problem = "neither an FMU, a system nor a .py file, and no block of a .py file here"
        own = [block for path in sorted(Path().glob("*.py")) for block in (path.stem, *defines(path))]
        raise InputError("export", name, problem, suggestion(name, [*blocks, *system_names(), *own]))
    return Exported((path,), (flavour,), tuple(platforms))


def _platforms(requested: Sequence[str], *, own: bool) -> list[str]:
    if requested:
        return list(requested)
    return available_platforms() if IS_CHECKOUT or own else list(PLATFORMS)


def _build(block: type[Block], path: Path, flavour: str, platforms: list[str]) -> None:
    """One FMU of this repository: an installed package has its native ones with all their libraries inside."""
    if flavour == "python":
        build_python_fmu(block, path)
    elif block.python_only:
        raise InputError("export", block.fmu_name, "needs Python and has no native form", "give `flavour` python")
    elif not IS_CHECKOUT:
        files = read_zip(shipped_fmu(block.fmu_name, flavour))
        left_out = tuple(f"binaries/{name}/" for name in PLATFORMS if name not in platforms)
        files = {name: content for name, content in files.items() if not name.startswith(left_out)}
        write_zip(path, add_evidence(block, files))  # with the digests of these files alone
    elif not platforms:
        raise InputError(
            "export", block.fmu_name, "no C compiler here", "pip install ziglang, or give `flavour` python"
        )
    else:
        build_native_fmu(block, path, platforms=platforms, portable=_zig_is_here())


def _zig_is_here() -> bool:
    """Whether libraries are compiled against an old C library; only zig serves both of these platforms."""
    return "win64" in available_platforms()


def _export_system(
    archive: SystemArchive, path: Path, flavour: str, platforms: list[str], options: ExportOptions
) -> None:
    """The system's folder as one archive, with the FMUs of this repository and of the working folder that it names."""
    blocks = catalogue()
    requested = check_studies(archive, options["studies"])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for entry in [entry for entry in archive.files if entry.endswith(".ssd")]:
            root = parse_xml(archive.read(entry, entry), f"{archive.label}/{entry}")
            for component in root.iter(f"{{{SSD_NAMESPACE}}}Component"):
                source = component.get("source", "")
                target = folder / f"{Path(source).stem}.fmu"
                if source in archive.files or target.exists():
                    continue
                own = fmu_file(target.stem, flavour, archive.path)
                if target.stem in blocks:
                    _build(blocks[target.stem], target, flavour, platforms)
                elif own is not None:
                    shutil.copyfile(own, target)
                else:
                    element = f"{component.get('name')} (line {component.sourceline})"
                    places = " or ".join(map(str, own_fmus(target.stem, flavour, archive.path)))
                    problem = f"no {source} in the system, no FMU of this repository, no {places}"
                    remedy = f"build your own with perilune export FILE.py and `flavour` {flavour}, or add the FMU"
                    raise InputError(f"{archive.label}/{entry}", element, problem, remedy)
        packed = pack_system(archive.path, [folder], folder / "packed")
        if options["ssp"] == "2":
            write_zip(packed, convert_package(read_zip(packed), archive.label))
        write_zip(path, add_system_evidence(packed, requested))


def _export_file(
    file: Path, requested: Sequence[str], flavour: Flavour | None, output: Path | None, only: str | None = None
) -> Exported:
    """The blocks of a file, or ``only`` one, into the working folder's build/fmus, where ``use`` finds them by name."""
    platforms = _platforms(requested, own=True)
    flavours = [flavour] if flavour else [name for name in FLAVOURS if platforms or name == "python"]
    blocks = [block for block in own_blocks(file) if only in (None, block.fmu_name)]
    if requested and all(block.python_only for block in blocks):
        problem = f"{', '.join(block.fmu_name for block in blocks)}: needs Python and has no native form"
        raise InputError("`platforms`", requested[0], problem, "leave it out")
    if output is None:
        for each in flavours:
            check_file("export", own_fmu(file.stem, each), new_folders=3)  # build/fmus/FLAVOUR
        folder = own_fmu("x", "x").parents[1]
        written = build_own_blocks(file, folder, flavours, platforms, only=only, portable=_zig_is_here())
        if not written:
            raise InputError(file, only or file.stem, "needs Python and has no native form", "give `flavour` python")
        record_source(folder, file, written, files_with(file))
        for block in own_blocks(file) if "native" in flavours else ():
            if block.python_only:
                remove_outdated(folder, file, own_fmu(block.fmu_name, "native"))
        built = tuple(name for name in flavours if any(path.parent.name == name for path in written))
        paths = tuple(path.relative_to(Path.cwd()) for path in written)
        return Exported(paths, built, tuple(platforms) if "native" in built else ())
    if output.suffix != ".fmu" or len(blocks) > 1:
        problem = "not an .fmu" if output.suffix != ".fmu" else f"the {len(blocks)} blocks of {file} are no one FMU"
        raise InputError("`output`", str(output), problem, "leave it out: FMUs go to build/fmus")
    if flavour is None and blocks[0].python_only:
        flavours = ["python"]
    with tempfile.TemporaryDirectory() as name:
        written = build_own_blocks(file, Path(name), flavours[:1], platforms, only=only, portable=_zig_is_here())
        if not written:
            raise InputError(file, blocks[0].__name__, "needs Python and has no native form", "give `flavour` python")
        write_atomically(output, written[0].read_bytes())
    return Exported((output,), tuple(flavours[:1]), tuple(platforms) if flavours[0] == "native" else ())
