"""Files of a system, opened for reading only: an .ssp archive or a folder."""

from __future__ import annotations

import hashlib
import itertools
import os
import posixpath
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial
from multiprocessing import parent_process
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from ....common.bounds import ARCHIVE_BYTES, bound_of
from ....common.errors import InputError, suggestion
from ....common.paths import FLAVOURS, IS_CHECKOUT, ROOT, SYSTEMS, names_fmu, own_fmus
from ....common.regular import names_file, read_input
from ....common.zips import ZippedFiles
from ....fmus_src.export.available import find_fmu
from ....fmus_src.export.ssp_package import CAMPAIGN_FOLDER, DESCRIPTION, SYSTEM_FILE, system_files

HOW_TO_BUILD = (
    "build_fmus.py builds the FMUs of this repository, " if IS_CHECKOUT else ""
) + "perilune export FILE.py those of your blocks"
OSP_DESCRIPTION = "OspSystemStructure.xml"
OSP_SUFFIX = ".xml"
OTHER = "give another file"
EXTRA = f"{CAMPAIGN_FOLDER.rpartition('/')[0]}/"
DEFAULT_VARIANT = DESCRIPTION.removesuffix(".ssd")


@dataclass(frozen=True)
class SystemArchive:
    """Files of a system by archive name.

    ``label`` is the system's name in messages, ``description`` the name of the default SSD. ``elsewhere`` maps keys
    (`fmu_key`, `use_key`, `parameters_key`) to replacements of files outside the system; if it is not empty, no others
    are read. ``unlisted`` collects names of files that were read from the folder but are not in ``files``.
    """

    name: str
    label: str
    path: Path
    files: Mapping[str, Path | bytes]
    description: str = DESCRIPTION
    elsewhere: Mapping[str, Path] = field(default_factory=dict)
    unlisted: dict[str, None] = field(default_factory=dict)
    known_digest: str | None = None

    @property
    def is_fmu(self) -> bool:
        """True if this is a single FMU without an SSD."""
        return names_fmu(self.path) and self.path.is_file()

    def label_of(self, name: str) -> str:
        """Return the name of a file in messages, without the standard's folder for additional files."""
        return f"{self.label}!{name.removeprefix(EXTRA)}"

    def name_of(self, label: str) -> str | None:
        """Return the archive name of a file from its `label_of`, or None for a file outside this system."""
        name = label.removeprefix(f"{self.label}!")
        if name == label:
            return None
        return f"{EXTRA}{name}" if f"{EXTRA}{name}" in self.files else name

    def read(self, name: str, element: str) -> bytes:
        """Return the content of a file to which ``element`` of the description refers."""
        return self._content(self._place(name), element)

    def _place(self, source: str) -> str:
        """Return the archive name of a source URI; %20 is decoded unless a file name contains it literally."""
        name = posixpath.normpath(source)
        return name if self.has(name) else posixpath.normpath(unquote(source))

    def has(self, name: str) -> bool:
        """Return True if there is a file with this archive name."""
        return name in self.files or (self._inside(name) and names_file(self.path / name))

    def _inside(self, name: str) -> bool:
        """Return True if a name that is not in `system_files` may belong to a file in or near the system's folder."""
        return self.path.is_dir() and (not _leads_outside(name) or (self.known_digest is None and _leads_upwards(name)))

    def note(self) -> str | None:
        """Return a note on files that were read from outside the system's folder, or None."""
        paths = [Path(os.path.normpath(self.path / name)) for name in self.unlisted if _leads_upwards(name)]
        outside = [str(path) for path in paths if not path.is_relative_to(self.path)]
        if not outside:
            return None
        lie = "lies" if len(outside) == 1 else "lie"
        return f"{self.label}: reads {', '.join(outside)}, which {lie} outside the system's folder"

    def _content(self, name: str, element: str) -> bytes:
        if name not in self.files and not self._inside(name) and _leads_outside(name):
            where = "folder" if self.path.is_dir() else "archive"
            problem = f"{name} lies outside the system's {where}"
            raise InputError(self.label, element, problem, "put the file inside the system and correct the reference")
        if not self.has(name):
            raise InputError(self.label, element, f"no file {name}", "add the file or correct the reference")
        if name not in self.files:
            self.unlisted[name] = None
        content = self.files.get(name, self.path / name)
        return content if isinstance(content, bytes) else read_input(content, OTHER, bound_of(name))

    def fmu(self, source: str, element: str, flavour: str | None) -> tuple[Callable[[], bytes], str]:
        """Return a function that reads an FMU, and the FMU's name in messages.

        If the system's folder lacks the FMU, the working folder, its parent folder and this repository are searched in
        the order of `find_fmu`. Without a ``flavour``, an FMU of any flavour is accepted.
        """
        if self.is_fmu:
            return read_fmu(self.path), self.label
        if fmu_key(source) in self.elsewhere:
            return read_fmu(self.elsewhere[fmu_key(source)]), source
        name = self._place(source)
        if self.has(name) or self.path.is_file() or not self._inside(name) or _leads_upwards(name):
            return partial(self._content, name, element), self.label_of(name)
        self.refuse_elsewhere(name, element)
        flavours = FLAVOURS if flavour is None else (flavour,)
        path = find_fmu(Path(name).stem, flavours, self.path)
        if path is None:
            places = " or ".join(map(str, own_fmus(Path(name).stem, flavours[-1], self.path)))
            if not self.path.is_relative_to(SYSTEMS.resolve()):
                problem = f"no file {name} in the system's folder, and no FMU of this name is built ({places})"
                remedy = "add the file or correct the source; a block of your own is built by perilune export FILE.py"
                raise InputError(self.label, element, problem, remedy)
            problem = f"no file {name} in the system, and no {flavours[-1]} FMU of this name is built ({places})"
            raise InputError(self.label, element, problem, f"{HOW_TO_BUILD}, or add the FMU")
        return read_fmu(path), str(path)

    def refuse_elsewhere(self, name: str, element: str) -> None:
        """Raise InputError for a system in a campaign's folder, which must contain all files that it uses."""
        if self.known_digest is not None:
            problem = f"{name} is not among the files in the campaign's folder"
            raise InputError(self.label, element, problem, "prepare the campaign again, with all of its files")

    def is_own_file(self, source: str) -> bool:
        """Return True if a source is a file of the system, rather than a file that `fmu` finds elsewhere."""
        return self.is_fmu or self.has(self._place(source))

    def variants(self) -> list[str]:
        """Return the names of the archive's SSDs, including the default SSD."""
        return sorted(name.removesuffix(".ssd") for name in self.files if name.endswith(".ssd") and "/" not in name)

    def description_name(self, variant: str | None) -> str:
        """Return the archive name of the default SSD, or of a variant's SSD."""
        if self.is_fmu:
            raise InputError(self.label, DESCRIPTION, "an FMU alone has no SSD", "give a system")
        name = self.description if variant is None else f"{variant.removesuffix('.ssd')}.ssd"
        if name not in self.files:
            variants = self.variants()
            if variant is None:
                raise InputError(
                    self.label, name, "not found", f"add this SSD (SSDs here: {', '.join(variants) or 'none'})"
                )
            raise InputError(self.label, "`variant`", f"no variant {variant}", suggestion(variant, variants))
        return name

    def parameter_set(self, name: str) -> tuple[bytes, str]:
        """Return content and label of a parameter set, found by its name in the system or by its path."""
        return self._find_named(name, (f"resources/{name}", name, f"resources/{name}.ssv"), "`parameters`", ".ssv")

    def campaign(self, name: str) -> tuple[bytes, str]:
        """Return content and label of a campaign, found by its name in the system or by its path."""
        places = (self.campaign_path(name), self.campaign_path(f"{name}.toml"))
        return self._find_named(name, places, "`campaign`", ".toml")

    @staticmethod
    def campaign_path(name: str) -> str:
        """Return the path of a campaign's file inside an archive."""
        return f"{CAMPAIGN_FOLDER}/{name}"

    def campaign_names(self) -> list[str]:
        """Return the names of the system's campaigns; files in subfolders are fragments that campaigns extend."""
        files = (PurePosixPath(name) for name in self.files)
        return [file.stem for file in files if file.suffix == ".toml" and str(file.parent) == CAMPAIGN_FOLDER]

    def _find_named(self, name: str, places: tuple[str, ...], option: str, suffix: str) -> tuple[bytes, str]:
        for place in places:
            if place in self.files:
                content, label = self._content(place, option), self.label_of(place)
                _warn_of_another(name, content, label, option, suffix)
                return content, label
        if parameters_key(name) in self.elsewhere:
            return read_input(self.elsewhere[parameters_key(name)], OTHER, bound_of(suffix)), name
        self.refuse_elsewhere(name, option)
        if os.path.lexists(name):
            return read_input(name, OTHER, bound_of(suffix)), name
        known = sorted(Path(entry).name for entry in self.files if entry.endswith(suffix))
        raise InputError(
            self.label, option, f"neither the system nor the working folder has a file {name}", suggestion(name, known)
        )

    @cached_property
    def digest(self) -> str:
        """SHA-256 of all names and contents, or the known digest."""
        if self.known_digest is not None:
            return self.known_digest
        total = hashlib.sha256()
        for name in sorted(self.files):
            total.update(name.encode() + b"\0" + hashlib.sha256(self._content(name, name)).digest())
        return total.hexdigest()


def _warn_of_another(name: str, content: bytes, label: str, option: str, suffix: str) -> None:
    """Warn that a different file of the same name in the working folder is ignored."""
    if parent_process() is not None:
        return  # in a worker: its parent process has warned already
    for path in dict.fromkeys((Path(name), Path(f"{name}{suffix}"))):
        if names_file(path) and read_input(path, OTHER, bound_of(suffix)) != content:
            other = path if path.is_absolute() else f"./{path}"
            warnings.warn(
                f"{option} {name}: read from {label}, not from the different file {path} in the working folder; "
                f"write {option} {other} to use that file",
                stacklevel=4,
            )
            return


def read_fmu(path: Path) -> Callable[[], bytes]:
    """Return a function that reads an FMU's file and may raise InputError."""
    return partial(read_input, path, OTHER, ARCHIVE_BYTES)


def fmu_key(source: str) -> str:
    """Return the key in `SystemArchive.elsewhere` for the FMU of a component's source."""
    return f"source:{source}"


def use_key(name: str) -> str:
    """Return the key in `SystemArchive.elsewhere` for an FMU named by the option `use`."""
    return f"use:{name}"


def parameters_key(name: str) -> str:
    """Return the key in `SystemArchive.elsewhere` for a parameter set."""
    return f"parameters:{name}"


def open_system(system: str | Path) -> SystemArchive:
    """Open a system by its name under ssp_systems, folder or .ssp file; an .fmu is a system of one component."""
    text = str(system)
    if (SYSTEMS / text).is_dir() and "/" not in text and text not in ("", ".", ".."):
        return _folder(SYSTEMS / text)
    path = Path(text)
    if path.is_dir():
        return _folder(path)
    if path.is_file() and path.suffix in (".ssd", OSP_SUFFIX):
        return _folder(path.parent, path.name)
    if names_fmu(path):
        if not path.is_file():
            raise InputError(text, "file", "not found", "give the path of an .fmu")
        return SystemArchive(path.stem, text, path, {path.name: path})
    if path.suffix == ".py":
        remedy = f"perilune export {text} builds them; simulate the folder of a system that names them"
        raise InputError(text, "", "a file of blocks is not a system", remedy)
    if path.name == SYSTEM_FILE:
        remedy = f"perilune compose {text} writes its SSD; give the folder"
        raise InputError(text, "", "the source file of a system is not a system", remedy)
    if path.suffix == ".toml":
        remedy = f"perilune batch SYSTEM --campaign {text} simulates the campaign"
        raise InputError(text, "", "a campaign is not a system", remedy)
    if path.is_file():
        return SystemArchive(path.stem, text, path, ZippedFiles(read_input(path, OTHER, ARCHIVE_BYTES), text))
    raise InputError(text, "system", "neither a system, a folder nor a file", suggestion(text, system_names()))


def system_names() -> list[str]:
    """Return the names of the systems under ssp_systems."""
    return sorted(entry.parent.name for entry in SYSTEMS.glob(f"*/{SYSTEM_FILE}"))


def _leads_outside(name: str) -> bool:
    """Return True if a normalised name refers to a file outside its starting folder."""
    return name.startswith(("/", "..")) or ":" in name.partition("/")[0]


def _leads_upwards(name: str) -> bool:
    """Return True if a normalised name begins with .. and refers to a file outside its starting folder."""
    inside = list(itertools.dropwhile("..".__eq__, name.split("/")))
    return name.startswith("../") and bool(inside) and ":" not in inside[0]


def _folder(path: Path, description: str | None = None) -> SystemArchive:
    path = path.resolve()
    label = path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else str(path)
    if description is None:
        has_ssd = any(path.glob("*.ssd"))  # checked before the folder is searched, which may be large
        if not has_ssd and not (path / OSP_DESCRIPTION).is_file():
            remedy = f"give a folder with an SSD or an {OSP_DESCRIPTION}, or such a file by its name"
            if (path / SYSTEM_FILE).is_file():
                remedy = f"perilune compose {label}/{SYSTEM_FILE} writes it"
                remedy = "run make build" if path.parent == SYSTEMS.resolve() else remedy
            raise InputError(label, DESCRIPTION, "not found", remedy)
        description = DESCRIPTION if has_ssd else OSP_DESCRIPTION
    files = system_files(path)
    if description.endswith(OSP_SUFFIX):
        files[description] = path / description
    return SystemArchive(path.name, label, path, files, description)
