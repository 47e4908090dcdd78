"""Platforms without a name in FMI 2.0, and platforms for which an FMU has no library: one line each.

Truth: the platforms of FMI 2.0.4, section 2.3, all x86, and the further platforms of FMI 3.0.1; macOS loads universal
libraries under the name of FMI 2.0.
"""

import platform
import sys

import fmpy
import pytest

from perilune.analysis.runtime.system.fmu import load_fmu
from perilune.common.errors import InputError
from perilune.fmus_src.export.compilers import local_platform
from tests.support.fmi3.reference import reference_fmu


@pytest.mark.parametrize(("system", "named"), [("linux", False), ("windows", False), ("darwin", True)])
def test_an_arm_processor(tiny_folder, monkeypatch, system, named):
    data = (tiny_folder / "native" / "ramp.fmu").read_bytes()
    monkeypatch.setattr(fmpy, "architecture", "aarch64")
    monkeypatch.setattr(fmpy, "system", system)
    monkeypatch.setattr(fmpy, "platform_tuple", f"aarch64-{system}")
    if named:
        assert load_fmu(data, "ramp.fmu").name == "ramp"
        return
    with pytest.raises(InputError, match=f"ramp.fmu: binaries: FMI 2.0 does not define the platform aarch64-{system}"):
        load_fmu(data, "ramp.fmu")


@pytest.mark.parametrize(("system", "suffix"), [("linux", ".so"), ("darwin", ".dylib"), ("windows", None)])
def test_fmi3_names_arm_processors(monkeypatch, system, suffix):
    """The Reference-FMUs have libraries for two of them."""
    content = reference_fmu(3, "Dahlquist").read_bytes()
    monkeypatch.setattr(fmpy, "platform_tuple", f"aarch64-{system}")
    monkeypatch.setattr(fmpy, "architecture", "aarch64")
    monkeypatch.setattr(fmpy, "sharedLibraryExtension", suffix or ".dll")
    if suffix is not None:
        assert (load_fmu(content, "D.fmu").folder / "binaries" / f"aarch64-{system}" / f"Dahlquist{suffix}").is_file()
        return
    with pytest.raises(
        InputError, match=r"binaries/aarch64-windows/Dahlquist\.dll: no binary for this platform; compile"
    ):
        load_fmu(content, "D.fmu")


@pytest.mark.parametrize(
    ("system", "processor", "name"),
    [
        ("linux", "x86_64", "linux64"),
        ("win32", "AMD64", "win64"),
        ("darwin", "x86_64", "darwin64"),
        ("darwin", "arm64", "darwin64"),
        ("linux", "aarch64", None),
    ],
)
def test_the_name_of_this_platform(monkeypatch, system, processor, name):
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(platform, "machine", lambda: processor)
    assert local_platform() == name
