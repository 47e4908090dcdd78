"""Systems, parameter sets, campaigns and descriptions of FMUs that were changed: accepted, or refused in one line.

``fmus`` is a folder with the tiny FMUs of `tests/support/builders.py`, ``folder`` where files may be written.
"""

from __future__ import annotations

import warnings
import zipfile
from collections.abc import Callable
from pathlib import Path

from hypothesis import given
from hypothesis.strategies import SearchStrategy

from perilune.analysis.campaigns.definition.checks import check_plan
from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.documents.figures.figure_reader import read_figures
from perilune.analysis.runtime.ssp.archive import SystemArchive, open_system
from perilune.analysis.runtime.ssp.parameter_sets import read_parameter_file
from perilune.analysis.runtime.system.fmu import Fmu
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.analysis.stability.request.loop_declaration import read_declaration
from perilune.common.errors import InputError
from tests.fuzz.changes import changed_text, changed_xml, flipped
from tests.fuzz.originals import CAMPAIGN, SOURCE, SSD, SSD_2, SSV, SSV_2
from tests.support.builders import pack
from tests.support.fmi3.strict_fmu import strict_fmu

SSD_NAME = "SystemStructure.ssd"
Reader = Callable[[bytes], object]
Target = Callable[[], None]


def check(read: Callable[[], object]) -> None:
    """Let a reader accept, or refuse in one line; it warns of nothing."""
    refusal = None
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        try:
            read()
        except InputError as error:
            refusal = error
    assert refusal is None or ("\n" not in str(refusal) and refusal.problem)


def system_reader(fmus: Path, folder: Path) -> Reader:
    """Return a reader of a system's SSD, with its FMUs read once."""
    archive = make_archive(fmus, folder)
    loaded: dict[str, Fmu] = {}

    def read(content: bytes) -> None:
        files = {**{name: archive.files[name] for name in archive.files}, SSD_NAME: content}
        changed = SystemArchive("good", "good.ssp", archive.path, files)
        prepared = prepare_system(changed, SystemOptions(allow_unmatched=True, open_inputs="start"), loaded)
        read_declaration(prepared.network.description)
        read_figures(prepared)

    return read


def campaign_reader(fmus: Path, folder: Path) -> Reader:
    """Return a reader of a campaign of that system, which checks its plan."""
    archive = make_archive(fmus, folder)

    def read(content: bytes) -> None:
        path = folder / "hostile.toml"
        path.write_bytes(content)
        check_plan(read_plan(archive.path, str(path), SystemOptions()))

    return read


def read_parameters(content: bytes) -> object:
    """Read a parameter set."""
    return read_parameter_file(content, "a.ssv")


def reads(contents: SearchStrategy[bytes], read: Reader) -> Target:
    """Return a test of a reader with any of some contents."""

    @given(content=contents)
    def change(content: bytes) -> None:
        check(lambda: read(content))

    return change


def any_system(fmus: Path, folder: Path) -> Target:
    """Test a system's SSD with a change."""
    return reads(changed_xml(SSD) | flipped(SSD), system_reader(fmus, folder))


def any_parameter_set(_fmus: Path, _folder: Path) -> Target:
    """Test a parameter set with a change."""
    return reads(changed_xml(SSV) | flipped(SSV), read_parameters)


def any_system_with_arrays(fmus: Path, folder: Path) -> Target:
    """Test a system's SSD of SSP 2.0 with a change."""
    return reads(changed_xml(SSD_2) | flipped(SSD_2), system_reader(fmus, folder))


def any_parameter_set_with_arrays(_fmus: Path, _folder: Path) -> Target:
    """Test a parameter set of SSP 2.0 with a change."""
    return reads(changed_xml(SSV_2) | flipped(SSV_2), read_parameters)


def any_campaign(fmus: Path, folder: Path) -> Target:
    """Test a campaign with a change."""
    return reads(changed_text(CAMPAIGN) | flipped(CAMPAIGN), campaign_reader(fmus, folder))


def any_description(fmus: Path, folder: Path) -> Target:
    """Test the modelDescription.xml of an FMU with a change."""
    return _description_of(fmus / "native" / "whole.fmu", folder)


def any_fmi3_description(_fmus: Path, folder: Path) -> Target:
    """Test that of an FMU of FMI 3.0, with arrays, sizes and all types, likewise."""
    return _description_of(strict_fmu(folder), folder)


def _description_of(fmu: Path, folder: Path) -> Target:
    with zipfile.ZipFile(fmu) as good:
        files = {name: good.read(name) for name in good.namelist()}
    text = files.pop("modelDescription.xml").decode()
    path = folder / "changed.fmu"

    def read(content: bytes) -> None:
        with zipfile.ZipFile(path, "w") as archive:
            for name, each in {**files, "modelDescription.xml": content}.items():
                archive.writestr(name, each)
        prepare_system(path, SystemOptions(open_inputs="start"))

    return reads(changed_xml(text) | flipped(text), read)


def make_archive(fmus: Path, folder: Path) -> SystemArchive:
    """Write a good system, as a file."""
    path = pack(folder / "good.ssp", fmus / "native", SSD, resources___a__ssv=SOURCE)
    return open_system(path)
