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
from ...fmus_src.export.compilers import (
    PLATFORMS,
    CompilationFailed,
    CompilerMissing,
    available_platforms,
    platforms_of,
)
from ...fmus_src.export.judge.subset import SubsetError
from ...fmus_src.export.native_fmu import build_native_fmu
from ...fmus_src.export.own_blocks import build_own_blocks, defines, files_with, folder_of, own_blocks
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
    fmi: int

    def lines(self) -> list[str]:
        """What `perilune export` prints: a path each."""
        return [str(path) for path in self.paths]

    def to_json(self) -> dict[str, object]:
        """The same for other programs."""
        kind = {"flavours": list(self.flavours), "platforms": list(self.platforms), "fmi": self.fmi}
        return {"paths": self.lines(), **kind}


@dataclass(frozen=True)
class _Request:
    """What is to be exported, and how; ``fmi`` and ``ssp`` are versions."""

    name: str
    platforms: Sequence[str]
    flavour: Flavour | None
    output: Path | None
    fmi: int
    ssp: str | None
    studies: Sequence[str]

    def find_platforms(self, *, prebuilt: bool) -> list[str]:
        """The requested platforms; else those that an installed package has, or a compiler is here for."""
        if self.platforms:
            return list(self.platforms)
        return platforms_of(2) if prebuilt and self.fmi == 2 and not IS_CHECKOUT else available_platforms(self.fmi)


@verb(EXPORT)
def export(name: FilePath, **options: Unpack[ExportOptions]) -> Exported:
    """Build an FMU, a system as one .ssp with its FMUs, or the blocks of a .py file: `perilune export`.

    ``name`` is a block's, a system's (or its folder), or a file; a block of one's own is looked up by its name in the
    .py files of the working folder. ``fmi`` 3 writes native FMUs of FMI 3.0, for which a compiler is needed.
    ``platforms`` are of native FMUs (linux64, win64, darwin64; of FMI 3.0 x86_64-linux and the like), by default those
    that are prebuilt, or for which a compiler is installed; ``flavour`` is native by default, of a file both where one
    is installed; ``ssp`` is the version of a system's documents, 2 with FMUs of FMI 3.0, which have arrays, and
    ``studies`` are its campaigns, stability or all, whose reports the .ssp has as evidence; ``output`` is NAME.fmu or
    NAME.ssp in the working folder, of a file its build/fmus. Raises InputError, with a line for each thing that is
    wrong with a block.
    """
    platforms, flavour, fmi = options["platforms"], options["flavour"], options["fmi"]
    text = os.fspath(name)
    target = None if options["output"] is None else Path(options["output"])
    request = _Request(text, platforms, flavour, target, fmi, options["ssp"], options["studies"])
    if platforms and flavour == "python":
        raise InputError("`platforms`", platforms[0], "Python FMUs have no platform to choose", "leave it out")
    if fmi == 3 and flavour == "python":
        raise InputError("`flavour`", flavour, "Python FMUs are of FMI 2.0", "leave it out, or leave out `fmi`")
    for platform in platforms:
        if PLATFORMS[platform].fmi != fmi:
            problem = f"a name of FMI {PLATFORMS[platform].fmi}.0"
            raise InputError("`platforms`", platform, problem, f"for FMI {fmi}.0 give {', '.join(platforms_of(fmi))}")
    check_file("`output`", target)
    try:
        exported = _export(request)
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


def _export(request: _Request) -> Exported:
    text = request.name
    is_system = text in system_names() or (Path(text).is_dir() and text not in catalogue())
    for option, given in (("ssp", request.ssp), ("studies", ", ".join(request.studies))):
        if given and not is_system:
            raise InputError(f"`{option}`", given, f"{text} is no system, which it is for", "leave it out")
    if text.endswith(".py"):
        _check_there(Path(text))
        return _export_file(Path(text), request)
    file = _block_file(text)
    if file is not None:
        return _export_file(file, request, text if text in defines(file) else None)
    return _export_named(request)


def _check_there(file: Path) -> None:
    """Refuse a Python file that is not there, with the names of those that are."""
    if file.is_file():
        return
    beside = [path.name for path in file.parent.glob("*.py")] if file.parent.is_dir() else []
    remedy = "give the .py file that defines the blocks"
    raise InputError(str(file), "", "no such file", f"{remedy}: {suggestion(file.name, beside)}" if beside else remedy)


def _block_file(name: str) -> Path | None:
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


def _export_named(request: _Request) -> Exported:
    """An FMU or a system of this repository or of a folder."""
    name, flavour, fmi = request.name, request.flavour or "native", request.fmi
    platforms = [] if flavour == "python" else request.find_platforms(prebuilt=True)
    blocks = catalogue()
    if name in blocks:
        path = request.output or Path(f"{name}.fmu")
        check_file("`output`", path, (".fmu",))
        _build(blocks[name], path, flavour, platforms, fmi)
    elif name in system_names() or Path(name).is_dir():
        path = request.output or Path(f"{Path(name).resolve().name}.ssp")
        check_file("`output`", path, (".ssp",))
        if fmi == 3 and request.ssp == "1":
            problem = "FMUs of FMI 3.0 have arrays, which SSP 1.0 has not"
            raise InputError("`ssp`", request.ssp, problem, "give 2, or leave out `fmi`")
        _export_system(open_system(name), path, flavour, platforms, request)
    else:
        problem = "neither an FMU, a system nor a .py file, and no block of a .py file here"
        own = [block for path in sorted(Path().glob("*.py")) for block in (path.stem, *defines(path))]
        raise InputError("export", name, problem, suggestion(name, [*blocks, *system_names(), *own]))
    return Exported((path,), (flavour,), tuple(platforms), fmi)


def _build(block: type[Block], path: Path, flavour: str, platforms: list[str], fmi: int) -> None:
    """One FMU of this repository: an installed package has its native ones of FMI 2.0 with all their libraries inside.

    Those of FMI 3.0 are compiled where they are asked for, as few users want them: they would double the package.
    """
    if flavour == "python":
        build_python_fmu(block, path)
    elif block.python_only:
        raise _needs_python("export", block.fmu_name, fmi)
    elif fmi == 2 and not IS_CHECKOUT:
        files = read_zip(shipped_fmu(block.fmu_name, flavour))
        left_out = tuple(f"binaries/{name}/" for name in PLATFORMS if name not in platforms)
        files = {name: content for name, content in files.items() if not name.startswith(left_out)}
        write_zip(path, add_evidence(block, files))  # with the digests of these files alone
    elif not platforms:
        raise _no_compiler(block.fmu_name, fmi)
    else:
        build_native_fmu(block, path, platforms=platforms, portable=_zig_is_here(), fmi=fmi)


def _no_compiler(element: FilePath, fmi: int) -> InputError:
    """That native FMUs cannot be made here, and what to do."""
    other = "give `flavour` python" if fmi == 2 else "leave out `fmi`"
    return InputError("export", str(element), "no C compiler here", f"pip install ziglang, or {other}")


def _needs_python(file: FilePath, element: str, fmi: int) -> InputError:
    """That a block cannot be compiled, and what to do."""
    if fmi == 3:
        return InputError(file, element, "needs Python, and Python FMUs are of FMI 2.0", "leave out `fmi`")
    return InputError(file, element, "needs Python and has no native form", "give `flavour` python")


def _zig_is_here() -> bool:
    """Whether libraries are compiled against an old C library; only zig serves both of these platforms."""
    return "win64" in available_platforms()


def _export_system(archive: SystemArchive, path: Path, flavour: str, platforms: list[str], request: _Request) -> None:
    """The system's folder as one archive, with the FMUs of this repository and of the working folder that it names."""
    blocks, studies = catalogue(), check_studies(archive, request.studies)
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
                    _build(blocks[target.stem], target, flavour, platforms, request.fmi)
                elif own is not None:
                    shutil.copyfile(own, target)
                else:
                    element = f"{component.get('name')} (line {component.sourceline})"
                    places = " or ".join(map(str, own_fmus(target.stem, flavour, archive.path)))
                    problem = f"no {source} in the system, no FMU of this repository, no {places}"
                    remedy = f"build your own with perilune export FILE.py and `flavour` {flavour}, or add the FMU"
                    raise InputError(f"{archive.label}/{entry}", element, problem, remedy)
        packed = pack_system(archive.path, [folder], folder / "packed")
        if request.ssp == "2" or request.fmi == 3:
            write_zip(packed, convert_package(read_zip(packed), archive.label))
        write_zip(path, add_system_evidence(packed, studies))


def _export_file(file: Path, request: _Request, only: str | None = None) -> Exported:
    """The blocks of a file, or ``only`` one, into the working folder's build/fmus, where ``use`` finds them by name."""
    requested, flavour, output, fmi = request.platforms, request.flavour, request.output, request.fmi
    platforms = request.find_platforms(prebuilt=False)
    flavours = [flavour] if flavour else [name for name in FLAVOURS if platforms or name == "python"]
    if fmi == 3:
        flavours = ["native"]
    blocks = [block for block in own_blocks(file) if only in (None, block.fmu_name)]
    if requested and all(block.python_only for block in blocks):
        problem = f"{', '.join(block.fmu_name for block in blocks)}: needs Python and has no native form"
        raise InputError("`platforms`", requested[0], problem, "leave it out")
    if flavours == ["native"] and not platforms:
        raise _no_compiler(file, fmi)
    if output is None:
        for each in flavours:
            check_file("export", own_fmu(file.stem, folder_of(each, fmi)), new_folders=3)  # build/fmus/FLAVOUR
        folder = own_fmu("x", "x").parents[1]
        written = _build_file(file, folder, flavours, platforms, only, fmi)
        if not written:
            raise _needs_python(file, only or file.stem, fmi)
        record_source(folder, file, written, files_with(file))
        for block in own_blocks(file) if "native" in flavours else ():
            if block.python_only:
                remove_outdated(folder, file, own_fmu(block.fmu_name, "native"))
        folders = {path.parent.name for path in written}
        built = tuple(name for name in flavours if folder_of(name, fmi) in folders)
        paths = tuple(path.relative_to(Path.cwd()) for path in written)
        return Exported(paths, built, tuple(platforms) if "native" in built else (), fmi)
    if output.suffix != ".fmu" or len(blocks) > 1:
        problem = "not an .fmu" if output.suffix != ".fmu" else f"the {len(blocks)} blocks of {file} are no one FMU"
        raise InputError("`output`", str(output), problem, "leave it out: FMUs go to build/fmus")
    if flavour is None and blocks[0].python_only and fmi == 2:
        flavours = ["python"]
    with tempfile.TemporaryDirectory() as name:
        written = _build_file(file, Path(name), flavours[:1], platforms, only, fmi)
        if not written:
            raise _needs_python(file, blocks[0].__name__, fmi)
        write_atomically(output, written[0].read_bytes())
    return Exported((output,), tuple(flavours[:1]), tuple(platforms) if flavours[0] == "native" else (), fmi)


def _build_file(
    file: Path, folder: Path, flavours: Sequence[str], platforms: Sequence[str], only: str | None, fmi: int
) -> list[Path]:
    return build_own_blocks(file, folder, flavours, platforms, only=only, portable=_zig_is_here(), fmi=fmi)
