"""Origin and licences of an FMU: attributes of modelDescription.xml, files, icon."""

from __future__ import annotations

import os
import re
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import distribution, version
from pathlib import Path

import fmpy

from ....common.errors import InputError
from ....common.paths import IS_CHECKOUT, PACKAGE, ROOT

# Release date of this version, with which its FMUs are dated for reproducible builds.
RELEASED = datetime(2026, 11, 29, tzinfo=UTC)
EPOCH = "SOURCE_DATE_EPOCH"  # s since 1970; of reproducible-builds.org
STANDARD = Path(fmpy.__file__).parent / "c-code"  # headers under BSD-2, with the licence in them
STANDARD_HEADERS = {
    2: ("fmi2FunctionTypes.h", "fmi2Functions.h", "fmi2TypesPlatform.h"),
    3: ("fmi3FunctionTypes.h", "fmi3Functions.h", "fmi3PlatformTypes.h"),
}
LICENCES = "documentation/licenses"  # FMI 3.0, 2.5.1.2, where license.txt is the entry; FMI 2.0.4 has the folder, too
ICONS = {2: "model.png", 3: "terminalsAndIcons/icon.png"}
ENTRY = """\
Licences of what this FMU holds

perilune.txt     Perilune {version}, which wrote this FMU: {ours}
fmi_headers.txt  headers of the FMI standard, which the libraries are compiled with
{others}"""
PYTHONFMU = "pythonfmu.txt    PythonFMU, whose libraries and modules run the Python code\n"


def origin(tool: str, *, is_ours: bool, is_final: bool = True) -> dict[str, str]:
    """Return the attributes of modelDescription.xml on tool, date and, for Perilune's models, version and licence.

    The date is SOURCE_DATE_EPOCH if set, else the release date. A description that is not ``is_final`` always has the
    release date, since the GUID is its hash. Raises InputError if SOURCE_DATE_EPOCH is not a time.
    """
    attributes = {"generationTool": tool, "generationDateAndTime": _date() if is_final else _text_of(RELEASED)}
    if not is_ours:
        return attributes
    metadata = distribution("perilune").metadata
    copyright_line, author = _copyright()
    about = {"author": author, "version": version("perilune")}
    return attributes | about | {"copyright": copyright_line, "license": metadata["License-Expression"]}


def accompanying_files(fmi: int, *, is_ours: bool, runs_python: bool = False) -> dict[str, bytes]:
    """Return the licences and the icon of an FMU by their paths in it, for an FMI version."""
    entry = ENTRY.format(
        version=version("perilune"),
        ours="all of its own code" if is_ours else "the code around the model, which is its author's",
        others=PYTHONFMU if runs_python else "",
    )
    texts = {"license.txt": entry, "perilune.txt": _licence("perilune"), "fmi_headers.txt": _licence_of_headers(fmi)}
    if runs_python:
        texts["pythonfmu.txt"] = _licence("pythonfmu")
    files = {f"{LICENCES}/{name}": text.encode() for name, text in texts.items()}
    return files | {ICONS[fmi]: Path(__file__).with_name("icon.png").read_bytes()}


def _date() -> str:
    seconds = os.environ.get(EPOCH)
    if seconds is None:
        return _text_of(RELEASED)
    try:
        return _text_of(datetime.fromtimestamp(int(seconds), UTC))
    except (ValueError, OverflowError, OSError):
        remedy = f"give whole seconds since 1970, or unset {EPOCH}"
        raise InputError(EPOCH, seconds, "is not a time", remedy) from None


def _text_of(date: datetime) -> str:
    return date.strftime("%Y-%m-%dT%H:%M:%SZ")


@cache
def _licence(package: str) -> str:
    """Return the licence text of an installed package, or of Perilune in a checkout."""
    if package == "perilune" and IS_CHECKOUT:  # metadata next to the sources, without the licence, may be found first
        return (ROOT / "LICENSE").read_text(encoding="utf-8")
    text = distribution(package).read_text("licenses/LICENSE")
    if text is None and package == "perilune":  # an unpacked source distribution from which a wheel is built
        text = (PACKAGE.parent / "LICENSE").read_text(encoding="utf-8")
    assert text is not None, f"{package} is installed without its licence"
    return text


def _copyright() -> tuple[str, str]:
    """Return the copyright line of Perilune's licence, and its owner."""
    line = re.search(r"^Copyright \(c\) [\d-]+ (.+)$", _licence("perilune"), re.MULTILINE)
    assert line is not None
    return line[0], line[1]


@cache
def _licence_of_headers(fmi: int) -> str:
    """Return the licence in the comment at the top of a header of the FMI standard."""
    text = (STANDARD / f"fmi{fmi}Functions.h").read_text(encoding="utf-8")
    first = text.index("Copyright (C)")
    lines = [line.strip() for line in text[first : text.index("*/", first)].splitlines()]
    return "\n".join(lines).rstrip("-\n ") + "\n"
