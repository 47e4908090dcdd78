"""Locations of a system's files as written by other tools: archives, folders, parent folders, capital letters.

Truth: the same system as written by Perilune, sample by sample.
"""

import zipfile

import numpy as np
import pytest

from perilune.analysis.cli import main
from perilune.common.errors import InputError
from tests.support.builders import (
    component,
    connection,
    document,
    fly,
    pack,
    parameter_set,
    system,
    write_zip,
)
from tests.support.foreign.plain_system import GAIN, RAMP, ROOT, WIRED, same

CAMPAIGN = """
system = "{}"
trials = 2
seed = 1
[draw."ramp.slope"]
distribution = "uniform"
low = 1.0
high = 2.0
[metric.end]
expression = "ramp.y"
reduction = "final"
[success]
expression = "end > 0"
"""


def test_fmus_beside_the_description(tiny, tmp_path, plain):
    folder = tmp_path / "beside"
    folder.mkdir()
    for name in ("ramp", "gain"):
        (folder / f"{name} one.fmu").write_bytes((tiny / f"{name}.fmu").read_bytes())
    root = system(
        component("ramp", "ramp%20one", "output y Real m"),
        component("gain", "gain one", "input u Real m; output y Real m"),
        connections=WIRED + connection("gain.y", "out"),
        declared=ROOT,
    )
    text = document(root).replace("resources/ramp", "ramp").replace("resources/gain", "./x/../gain")
    (folder / "SystemStructure.ssd").write_text(text)
    same(fly(folder), plain)


def test_encoded_sources_in_an_archive(tiny, tmp_path, plain):
    root = system(RAMP, GAIN, connections=WIRED + connection("gain.y", "out"), declared=ROOT)
    text = document(root).replace("resources/gain.fmu", "resources/the%20gain.fmu")
    fmu = {"resources/the gain.fmu": (tiny / "gain.fmu").read_bytes()}
    same(fly(pack(tmp_path / "s.ssp", tiny, text, **fmu)), plain)


def test_sources_that_go_up_and_stay_inside(tiny, tmp_path, plain):
    folder = tmp_path / "system"
    (folder / "models" / "deep").mkdir(parents=True)
    (folder / "models" / "ramp.fmu").write_bytes((tiny / "ramp.fmu").read_bytes())
    (folder / "models" / "gain.fmu").write_bytes((tiny / "gain.fmu").read_bytes())
    root = system(RAMP, GAIN, connections=WIRED + connection("gain.y", "out"), declared=ROOT)
    text = document(root).replace("resources/ramp.fmu", "models/deep/../ramp.fmu")
    text = text.replace("resources/gain.fmu", "./models/gain.fmu")
    (folder / "SystemStructure.ssd").write_text(text)
    same(fly(folder), plain)
    same(fly(folder / "SystemStructure.ssd"), plain)


@pytest.mark.parametrize("source", ["/ramp.fmu", "file:///ramp.fmu"])
def test_sources_that_leave_the_folder(tiny, tmp_path, source):
    folder = tmp_path / "system"
    folder.mkdir()
    (tmp_path / "ramp.fmu").write_bytes((tiny / "ramp.fmu").read_bytes())
    text = document(system(RAMP)).replace("resources/ramp.fmu", source)
    (folder / "SystemStructure.ssd").write_text(text)
    with pytest.raises(InputError, match=r"ramp \(line \d+\): .*ramp\.fmu lies outside the system's folder; put"):
        fly(folder)
    with pytest.raises(InputError, match=r"ramp \(line \d+\): .*ramp\.fmu lies outside the system's archive; put"):
        fly(pack(tmp_path / "s.ssp", tiny, text))


@pytest.mark.parametrize(
    ("folder", "source"),
    [
        ("s", "../ramp.fmu"),
        ("s", "m/../../ramp.fmu"),
        ("s/t", "../../ramp.fmu"),
        ("s/t/u", "../../../ramp.fmu"),
        ("s/t/u/v/w", "../../../../../ramp.fmu"),
    ],
)
def test_files_above_a_folder(tiny, tmp_path, capsys, folder, source):
    """Any number of levels, from a folder that the user names; noted each; the campaign's folder has them, too."""
    system_folder = tmp_path / folder
    system_folder.mkdir(parents=True)
    (tmp_path / "ramp.fmu").write_bytes((tiny / "ramp.fmu").read_bytes())
    (tmp_path / "set.ssv").write_text(parameter_set("slope=Real:3"))
    sets = f'<ssd:ParameterBinding source="{source.replace("ramp.fmu", "set.ssv")}"/>'
    text = document(system(component("ramp", "ramp", "output y Real m", bindings=sets)))
    text = text.replace("resources/ramp.fmu", source)
    (system_folder / "SystemStructure.ssd").write_text(text)
    expected = fly(pack(tmp_path / "plain.ssp", tiny, document(system(RAMP))), set={"ramp.slope": 3.0})["ramp.y"]
    for path in (system_folder, system_folder / "SystemStructure.ssd"):
        np.testing.assert_array_equal(fly(path)["ramp.y"], expected)
    assert main(["validate", str(system_folder)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert said.count("outside the system's folder") == 1
    assert all(str(tmp_path / name) in said for name in ("ramp.fmu", "set.ssv"))
    campaign = tmp_path / "c.toml"
    campaign.write_text(CAMPAIGN.format(system_folder.name))
    assert main(["prepare", str(system_folder), "--campaign", str(campaign), "--output", str(tmp_path / "out")]) == 0
    (tmp_path / "ramp.fmu").unlink()
    assert main(["shard", str(tmp_path / "out"), "0"]) == 0
    with pytest.raises(InputError, match=r"ramp \(line \d+\): .*ramp\.fmu lies outside the system's archive; put"):
        fly(pack(tmp_path / "s.ssp", tiny, text))


def test_an_fmu_in_a_process_of_its_own_is_the_fmu(tiny, tmp_path, plain):
    """libcosim, Ecos and Vico: proxyfmu://localhost?file=x.fmu."""
    root = system(RAMP, GAIN, connections=WIRED + connection("gain.y", "out"), declared=ROOT)
    fmus = {f"resources___{name}__fmu": (tiny / f"{name}.fmu").read_bytes() for name in ("ramp", "gain")}
    text = document(root).replace('"resources/gain.fmu"', '"proxyfmu://localhost?file=resources/gain.fmu"')
    same(fly(pack(tmp_path / "s.ssp", tiny, text, **fmus)), plain)
    text = text.replace("localhost?", "127.0.0.1:9090?")
    same(fly(pack(tmp_path / "s.ssp", tiny, text, **fmus)), plain)
    with pytest.raises(InputError, match=r"gain \(line \d+\): source proxyfmu://lab\?file=.* is in another process or"):
        fly(pack(tmp_path / "s.ssp", tiny, text.replace("127.0.0.1:9090?", "lab?"), **fmus))


def test_suffixes_in_capitals(tiny, tmp_path, plain, capsys):
    """RAMP.FMU, as Windows tools write it: in an archive, next to an SSD, and by itself."""
    root = system(RAMP, GAIN, connections=WIRED + connection("gain.y", "out"), declared=ROOT)
    text = document(root).replace("resources/ramp.fmu", "RAMP.FMU").replace("resources/gain.fmu", "resources/GAIN.FMU")
    fmus = {"ramp.fmu": "RAMP.FMU", "gain.fmu": "resources/GAIN.FMU"}
    contents = {new: (tiny / old).read_bytes() for old, new in fmus.items()}
    archive = write_zip(tmp_path / "s.ssp", {"SystemStructure.ssd": text, **contents})
    same(fly(archive), plain)
    with zipfile.ZipFile(archive) as packed:
        packed.extractall(tmp_path / "s")
    same(fly(tmp_path / "s"), plain)
    alone = [str(tmp_path / "s" / "RAMP.FMU"), "--stop-time", "1"]
    assert main(["run", *alone]) == main(["validate", *alone]) == 0
    with pytest.raises(InputError, match=r"x\.FMU: file: not found"):
        fly(tmp_path / "x.FMU")
