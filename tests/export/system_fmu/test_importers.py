"""FMU of a system simulated by other tools: from an empty folder, in other importers, recompiled.

Truth: the system simulated by Perilune from the FMUs of its components.
"""

import json
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest

import perilune
from perilune.fmus_src.export.description.origin import STANDARD
from tests.support.builders import component, document, pack, system
from tests.support.foreign.osp import HEAD, libcosim, simulator
from tests.support.lengths import either
from tests.support.native.system_fmus import build_one, fly_one

SYSTEM = either("landing_mission", "lunar_terminal_guidance")
EXPOSED = ("plant.position", "plant.velocity")
NAMES = [f"{name}[{axis}]" for name in EXPOSED for axis in (1, 2, 3)]
ALONE = """
import json, sys
import fmpy
flown = fmpy.simulate_fmu(sys.argv[1], stop_time=float(sys.argv[2]), step_size=float(sys.argv[3]),
                          output_interval=float(sys.argv[3]), output=json.loads(sys.argv[4]))
print(json.dumps({name: flown[name].tolist() for name in flown.dtype.names}))
assert not any(name.partition(".")[0] in ("perilune", "fmus_src", "analysis", "common") for name in sys.modules)
"""


@pytest.fixture(scope="module")
def native(fmus):
    return perilune.simulate(SYSTEM, flavour="native")


@pytest.fixture(scope="module")
def fmu(fmus, tmp_path_factory):
    return build_one(tmp_path_factory.mktemp("one") / "one.fmu", SYSTEM, exposed=EXPOSED)


def test_fmpy_in_an_empty_folder(fmu, native, tmp_path):
    shutil.copy(fmu, tmp_path / "system.fmu")
    step = float(native.time[1] - native.time[0])
    arguments = ["system.fmu", str(native.time[-1]), str(step), json.dumps(NAMES)]
    ended = subprocess.run(
        [sys.executable, "-I", "-c", ALONE, *arguments], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    flown = json.loads(ended.stdout)
    for name in NAMES:
        assert np.array_equal(flown[name], native[name]), name


def test_libcosim(fmu, native, tmp_path):
    """It counts whole nanoseconds; the system counts its steps, so that bits are the same."""
    step = float(native.time[1] - native.time[0])
    shutil.copy(fmu, tmp_path / "one.fmu")
    (tmp_path / "OspSystemStructure.xml").write_text(
        f"{HEAD}\n<BaseStepSize>{step}</BaseStepSize>\n<Algorithm>fixedStep</Algorithm>\n"
        f"<Simulators>{simulator('one', 'one')}</Simulators>\n</OspSystemStructure>\n"
    )
    rows = libcosim(tmp_path, [f"one.{name}" for name in NAMES], 500)
    for column, name in enumerate(NAMES):
        assert np.array_equal(rows[:, column], native[name][1:501]), name


def test_fmucontainer(fmu, native, tmp_path):
    step = float(native.time[1] - native.time[0])
    shutil.copy(fmu, tmp_path / "one.fmu")
    outputs = "".join(f"OUTPUT;one.fmu;{name};;{name}\n" for name in NAMES)
    (tmp_path / "box.csv").write_text(f"rule;from_fmu;from_port;to_fmu;to_port\nFMU;one.fmu;;;\n{outputs}")
    tool = Path(sys.executable).with_name("fmucontainer")
    subprocess.run(
        [tool, "-container", f"box.csv:{step}", "-fmu-directory", "."], cwd=tmp_path, check=True, capture_output=True
    )
    flown = fmpy.simulate_fmu(
        str(tmp_path / "box.fmu"), stop_time=500 * step, step_size=step, output_interval=step, output=NAMES
    )
    for name in NAMES:
        assert np.array_equal(flown[name], native[name][:501]), name


ZIG = pytest.param([sys.executable, "-m", "ziglang", "cc"], marks=pytest.mark.slow, id="zig")


@pytest.mark.parametrize("compiler", [pytest.param(["gcc"], id="gcc"), ZIG])
def test_the_line_of_the_readme_compiles_it(fmu, native, tmp_path, compiler):
    """Without a warning; the same bits."""
    folder = Path(fmpy.extract(str(fmu), str(tmp_path / "unzipped")))
    line = next(each for each in (folder / "sources/README.md").read_text().splitlines() if each.startswith("    gcc"))
    arguments = line.split()[1:]
    ended = subprocess.run(
        [*compiler, "-Wall", "-Wextra", *arguments], cwd=folder / "sources", capture_output=True, text=True, check=True
    )
    assert "warning" not in ended.stderr
    library = folder / "sources" / arguments[arguments.index("-o") + 1]
    other = tmp_path / "other.fmu"
    with zipfile.ZipFile(fmu) as files, zipfile.ZipFile(other, "w") as recompiled:
        for name in files.namelist():
            content = library.read_bytes() if name.startswith("binaries/") else files.read(name)
            recompiled.writestr(name, content)
    flown = fly_one(other)
    for name in NAMES:
        assert np.array_equal(flown[name][: len(native.time)], native[name]), name


def test_two_in_one_program(fmu, tmp_path):
    """Their functions have prefixes, as static libraries need them, and nothing else is global."""
    folder = Path(fmpy.extract(str(fmu), str(tmp_path)))
    source = f"{fmpy.read_model_description(str(fmu)).coSimulation.modelIdentifier}.c"
    flags = ["-std=c99", "-O1", "-ffp-contract=off", "-fno-tree-vectorize", "-c", f"-I{STANDARD}"]
    command = ["gcc", *flags, "-DFMI2_FUNCTION_PREFIX=one_", source, "-o", "one.o"]
    subprocess.run(command, cwd=folder / "sources", check=True)
    symbols = subprocess.run(
        ["nm", "-g", "--defined-only", "one.o"], cwd=folder / "sources", capture_output=True, text=True, check=True
    )
    names = [line.split()[-1] for line in symbols.stdout.splitlines()]
    assert len(names) > 30
    assert all(name.startswith(("one_fmi2", "one_perilune_place")) for name in names)


def test_two_landers_in_one_system(fmu, native, tmp_path):
    """Two instances in one system: each is the lander alone, and stays as it is after its end.

    Nested as systems they would go on after their ends, which end the root system alone.
    """
    step = float(native.time[1] - native.time[0])
    ssd = document(system(component("a", "one"), component("b", "one")), stop=float(native.time[-1]), step=step)
    path = pack(tmp_path / "two.ssp", fmu.parent, ssd)
    parameter = "plant.initial_mass"
    mass = {f"b.{parameter}": 1.01 * _start(fmu, parameter)}
    flown = perilune.simulate(path, set=mass, record=[f"{each}.{name}" for each in "ab" for name in NAMES])
    other = perilune.simulate(SYSTEM, flavour="native", set={parameter: mass[f"b.{parameter}"]})
    for name in NAMES:
        assert np.array_equal(flown[f"a.{name}"], native[name]), name
        end = min(len(other.time), len(flown.time))
        assert np.array_equal(flown[f"b.{name}"][:end], other[name][:end]), name


def _start(fmu, name):
    variables = {each.name: each for each in fmpy.read_model_description(str(fmu)).modelVariables}
    return float(variables[name].start)
