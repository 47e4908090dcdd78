"""`perilune.export` and `perilune export`: build of an FMU, of a system with its FMUs, or of the blocks of a file."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Unpack

from ...common.errors import InputError, SeveralProblemsError, suggestion
from ...common.targets import check_file
from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.compilers import CompilationFailed, CompilerMissing, available_platforms, platforms_of
from ...fmus_src.export.judge.subset import SubsetError
from ...fmus_src.export.own_blocks import defines
from ...fmus_src.export.ssp_package import DESCRIPTION
from ..documents.model import Document
from ..documents.of.written_files import exported_document
from ..exports.block_files import check_file_exists, export_file, find_block_file
from ..exports.fmus import build_fmu, has_zig
from ..exports.request import ExportedFiles, ExportRequest
from ..exports.system_fmu.build import build_system_fmu
from ..exports.system_fmu.one_fmu import OneFmu
from ..exports.systems import export_system
from ..options.declared.library import EXPORT, ExportOptions
from ..options.option import FilePath, defaults_of, options_of
from ..options.simulation_options import AssemblyOptions
from ..options.verb import verb
from ..runtime.ssp.archive import open_system, system_names
from ..runtime.system.options import system_options
from .common.documented import Documented


@dataclass(frozen=True)
class Exported(Documented, ExportedFiles):
    """Files that were written, and their version of FMI."""

    fmi: int

    def document(self) -> Document:
        """Return a document with the written paths."""
        return exported_document(**vars(self))


@verb(EXPORT)
def export(name: FilePath, **options: Unpack[ExportOptions]) -> Exported:
    """Build an FMU, a system as one .ssp with its FMUs, or the blocks of a .py file: `perilune export`.

    ``name`` is a block, a system or its folder, or a file; a user's block is searched by name in the .py files of the
    working folder. ``fmi`` 3 builds native FMUs of FMI 3.0, which needs a compiler. ``platforms`` of native FMUs are by
    default all that are prebuilt or for which a compiler is installed. ``flavour`` is native by default; blocks of a
    file are built in both flavours if a compiler is installed. ``ssp`` is the version of a system's documents (default:
    2 with FMUs of FMI 3.0), and ``studies`` are campaigns, stability or all, whose reports the .ssp contains as
    evidence. ``output`` is by default NAME.fmu or NAME.ssp in the working folder, or build/fmus for a file.

    ``as_fmu`` builds one FMU of a system, for all platforms with a compiler. ``slots`` maps a component to FMUs (names
    or paths separated by commas), among which the FMU's parameter SLOT.use selects; ``expose`` are signals that become
    local variables, ``faults`` connectors and tunable parameters that get fault inputs. ``use``, ``parameters``,
    ``set``, ``step``, ``stop_time``, ``algorithm`` and ``variant`` are as in `simulate`. Raises InputError, with a line
    for each problem of a block.
    """
    text, flavour = os.fspath(name), options["flavour"]
    target = None if options["output"] is None else Path(options["output"])
    request = ExportRequest(
        text, options["platforms"], flavour, target, options["fmi"], options["ssp"], options["studies"]
    )
    one_fmu = _read_one_fmu(options)
    try:
        written = _export(request) if one_fmu is None else _export_as_fmu(request, one_fmu)
    except CompilerMissing as error:
        raise InputError("export", text, "cannot be compiled here", str(error)) from error
    except CompilationFailed as error:
        raise InputError("export", text, "the compiler rejected its C source", " ".join(str(error).split())) from error
    except InputError:
        raise
    except SubsetError as error:
        raise SeveralProblemsError(*(f"{error.block}: {violation}" for violation in error.violations)) from error
    except ValueError as error:  # from a block: its declaration or its imports
        raise SeveralProblemsError(" ".join(str(error).split())) from error
    if flavour is None and "native" not in written.flavours and not available_platforms():
        warnings.warn(
            "no C compiler was found, so only the Python flavour was written; pip install ziglang for both",
            stacklevel=2,
        )
    return Exported(written.paths, written.flavours, written.platforms, request.fmi)


def _read_one_fmu(options: ExportOptions) -> OneFmu | None:
    """Return the request for a system as one FMU, if any. Raises InputError for its options without `as_fmu`."""
    if options["as_fmu"]:
        assembly = {name: value for name, value in options.items() if name in options_of(AssemblyOptions)}
        slots = {slot: _candidates(slot, fmus) for slot, fmus in options["slots"].items()}
        system = system_options({**assembly, "flavour": "native"})
        return OneFmu(slots, options["expose"], options["faults"], system)
    defaults = defaults_of(ExportOptions)
    for name in (*options_of(AssemblyOptions), "slots", "expose", "faults"):
        value = options[name]  # type: ignore[literal-required]
        if value != defaults[name]:
            text = ", ".join(map(str, value)) if isinstance(value, Mapping | list | tuple) else str(value)
            raise InputError(
                f"`{name}`", text, "applies only to a system as one FMU", "give `as_fmu`, or leave out this option"
            )
    return None


def _candidates(slot: str, fmus: object) -> list[str]:
    """Return the candidates of a slot from a name, a text with commas, or a list. Raises InputError."""
    several = fmus if isinstance(fmus, list | tuple) else str(fmus).split(",") if isinstance(fmus, str | Path) else ()
    if not several or not all(isinstance(each, str | Path) for each in several):
        raise InputError(
            "`slots`", slot, f"{fmus!r} is not a list of FMUs", "give names or paths, as a list or with commas"
        )
    return [os.fspath(each).strip() for each in several]


def _export_as_fmu(request: ExportRequest, one_fmu: OneFmu) -> ExportedFiles:
    """Export a system as one FMU from its name, its folder or an .ssp."""
    request.check_one_fmu()
    name = request.name
    if not _names_system(name) and not name.endswith(".ssp"):
        problem = "only a system can become one FMU"
        raise InputError("`as_fmu`", name, problem, suggestion(name, system_names()))
    archive = open_system(name)
    path = request.output or Path(f"{_archive_name(name).removesuffix('.ssp')}.fmu")
    check_file("`output`", path, (".fmu",))
    platforms = request.platforms or (platforms_of(2) if has_zig() else available_platforms())
    if not platforms:
        raise InputError(
            "export", name, "needs a C compiler, and none is installed", "install cc, or pip install ziglang"
        )
    build_system_fmu(archive, path, one_fmu, platforms, portable=has_zig())
    return ExportedFiles((path,), ("native",), tuple(platforms))


def _names_system(name: str) -> bool:
    """Return True if ``name`` is the name of a system, its folder, or an SSD in its folder."""
    return name in system_names() or Path(name).is_dir() or (name.endswith(".ssd") and Path(name).is_file())


def _archive_name(name: str) -> str:
    """Return the file name of an exported system: the name of its folder, or of an SSD other than the default one."""
    path = Path(name).resolve()
    if path.suffix != ".ssd":
        return path.name
    return path.parent.name if path.name == DESCRIPTION else path.stem


def _export(request: ExportRequest) -> ExportedFiles:
    text = request.name
    is_system = _names_system(text) and (text in system_names() or text not in catalogue())
    for option, value in (("ssp", request.ssp), ("studies", ", ".join(request.studies))):
        if value and not is_system:
            raise InputError(
                f"`{option}`",
                value,
                f"{text} is not a system, and the option applies only to systems",
                "leave out this option",
            )
    if text.endswith(".py"):
        check_file_exists(Path(text))
        return export_file(Path(text), request)
    file = find_block_file(text)
    if file is not None:
        return export_file(file, request, text if text in defines(file) else None)
    return _export_named(request)


def _export_named(request: ExportRequest) -> ExportedFiles:
    """Export an FMU or a system by name or folder."""
    name, flavour, fmi = request.name, request.flavour or "native", request.fmi
    platforms = [] if flavour == "python" else request.find_platforms(prebuilt=True)
    blocks = catalogue()
    if name in blocks:
        path = request.output or Path(f"{name}.fmu")
        check_file("`output`", path, (".fmu",))
        build_fmu(blocks[name], path, flavour, platforms, fmi)
    elif _names_system(name):
        path = request.output or Path(f"{_archive_name(name)}.ssp")
        check_file("`output`", path, (".ssp",))
        if fmi == 3 and request.ssp == "1":
            problem = "FMI 3.0 FMUs have arrays, which SSP 1.0 does not support"
            raise InputError("`ssp`", request.ssp, problem, "give 2, or leave out `fmi`")
        export_system(open_system(name), path, flavour, platforms, request)
    else:
        problem = "no FMU, system, .py file or block of a .py file here has this name"
        own = [block for path in sorted(Path().glob("*.py")) for block in (path.stem, *defines(path))]
        raise InputError("export", name, problem, suggestion(name, [*blocks, *system_names(), *own]))
    return ExportedFiles((path,), (flavour,), tuple(platforms))
