"""Shipped systems as SSP 2.0: valid, smaller, and equal simulations to the last bit.

Truth: the systems as SSP 1.0; the schemas of SSP 2.0; the counts of elements by their names.
"""

from __future__ import annotations

import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from lxml import etree

from perilune.analysis.cli import main
from perilune.analysis.runtime.ssp.archive import system_names
from perilune.analysis.runtime.ssp.dimensions import array_shapes
from perilune.analysis.runtime.ssp.documents import check_schema
from perilune.analysis.runtime.ssp.version_2 import package
from perilune.analysis.runtime.ssp.version_2.package import convert_package
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.analysis.verbs.export import export
from perilune.common.errors import InputError
from perilune.common.paths import BUILD
from perilune.fmus_src.export.archive import read_zip, write_zip
from tests.support.builders import fly
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")
NAMES = system_names()


def grouped(description: etree._Element) -> dict[str, tuple[int, ...]]:
    """Return the arrays of an FMU by the names of its variables, as if it were one of FMI 3.0."""
    return array_shapes(each.get("name", "") for each in description.iterfind("ModelVariables/ScalarVariable"))


def documents(files: dict[str, bytes]) -> dict[str, etree._Element]:
    return {name: etree.fromstring(text) for name, text in files.items() if name.endswith((".ssd", ".ssv"))}


def count(files: dict[str, bytes], name: str) -> int:
    return sum(len(root.findall(f".//{{*}}{name}")) for root in documents(files).values())


@pytest.mark.parametrize("name", either(NAMES, ["lunar_terminal_guidance", "lunar_descent_2d"]))
def test_with_arrays_they_are_smaller_and_run_alike(name, tmp_path, monkeypatch):
    monkeypatch.setattr(package, "arrays_of_fmu", grouped)
    one = read_zip(BUILD / "ssp" / f"{name}.ssp")
    two = convert_package(one, name)
    for file, root in documents(two).items():
        check_schema(root, file[-3:], file)
    assert count(two, "Connector") < count(one, "Connector") or name == "lunar_descent_2d"  # whose signals are scalars
    assert count(two, "Connection") < count(one, "Connection") or name == "lunar_descent_2d"
    assert count(two, "Parameter") < count(one, "Parameter")
    assert sum(map(len, two.values())) < sum(map(len, one.values()))
    before, after = fly(BUILD / "ssp" / f"{name}.ssp"), fly(write_zip_at(tmp_path / f"{name}.ssp", two))
    assert list(after.signals) == list(before.signals)
    for signal, values in before.signals.items():
        np.testing.assert_array_equal(after.signals[signal].view(np.uint8), values.view(np.uint8), err_msg=signal)


def write_zip_at(path: Path, files: dict[str, bytes]) -> Path:
    write_zip(path, files)
    return path


@pytest.mark.parametrize("name", either(NAMES, ["lunar_terminal_guidance", "orbital_attitude"]))
def test_every_parameter_set_gives_what_it_gave(name, tmp_path, monkeypatch):
    monkeypatch.setattr(package, "arrays_of_fmu", grouped)
    one = read_zip(BUILD / "ssp" / f"{name}.ssp")
    path = write_zip_at(tmp_path / f"{name}.ssp", convert_package(one, name))
    for file in (each for each in one if each.endswith(".ssv")):
        options = SystemOptions(parameters=(Path(file).name,), allow_unmatched=True)
        before, after = (prepare_system(each, options).settings for each in (BUILD / "ssp" / f"{name}.ssp", path))
        assert after.variables == before.variables, file
        assert after.nodes == before.nodes, file


def test_exported_with_fmus_of_fmi_2_every_variable_has_a_connector(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["export", "lunar_terminal_guidance", "--ssp", "2", "--flavour", "python"]) == 0
    path = tmp_path / "lunar_terminal_guidance.ssp"
    with zipfile.ZipFile(path) as archive:
        root = etree.fromstring(archive.read("SystemStructure.ssd"))
    check_schema(root, "ssd", "s.ssd")
    assert root.get("version") == "2.0"
    names = [each.get("name") for each in root.iterfind(".//{*}Component/{*}Connectors/{*}Connector")]
    assert "position[1]" in names
    assert "position" not in names
    assert not [note for note in prepare_system(path, SystemOptions()).network.notes if "FMI 2.0" in note]
    before, after = fly(BUILD / "ssp" / "lunar_terminal_guidance.ssp"), fly(path)
    for signal, values in before.signals.items():
        np.testing.assert_array_equal(after.signals[signal], values, err_msg=signal)


@pytest.mark.parametrize("name", either(NAMES, ["lunar_terminal_guidance"]))
def test_exported_with_fmus_of_fmi_3_every_array_has_a_connector(name, tmp_path):
    path = tmp_path / f"{name}.ssp"
    export(name, fmi=3, platforms=[fmpy.platform_tuple], output=path)
    files = read_zip(path)
    for file, root in documents(files).items():
        check_schema(root, file[-3:], file)
    description = etree.fromstring(files["SystemStructure.ssd"])
    assert not [each.get("name") for each in description.iterfind(".//{*}Connector") if "[" in each.get("name")]
    before, after = fly(BUILD / "ssp" / f"{name}.ssp"), fly(path)
    assert set(after.signals) == set(before.signals)
    for signal, values in before.signals.items():
        np.testing.assert_array_equal(after.signals[signal], values, err_msg=signal)


def test_fmus_of_fmi_3_need_version_2(tmp_path):
    with pytest.raises(InputError, match=r"FMI 3\.0 FMUs have arrays, which SSP 1\.0 does not support"):
        export("lunar_terminal_guidance", fmi=3, ssp="1", output=tmp_path / "s.ssp")


@pytest.mark.parametrize("ssp", ["1", "2"])
def test_a_version_of_ssp_is_for_systems(tmp_path, monkeypatch, ssp):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(
        InputError,
        match="forming_filter is not a system, and the option applies only to systems; leave out this option",
    ):
        export("forming_filter", ssp=ssp)
    assert not list(tmp_path.iterdir())
