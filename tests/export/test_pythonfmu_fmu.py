"""Python FMUs: equal bytes from equal sources, fixed code after the build, several FMUs in one process.

Truth: bytes; a constant changed in a copy of the sources; a process that cannot import the repository; the plain Python
object, stepped with the FMU.
"""

import hashlib
import json
import os
import shutil
import subprocess
import sys

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from perilune.analysis.runtime.instances.instance import instantiate
from perilune.analysis.runtime.system.fmu import load_fmu
from perilune.common.paths import ROOT, shipped_fmu
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.own_blocks import build_own_blocks
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from perilune.fmus_src.plants.flat_moon_lander import FlatMoonLander
from perilune.fmus_src.runtime import BlockInstance
from tests.support.builders import component, document, fly, pack, system
from tests.support.lengths import either


def run(code, *arguments, cwd=ROOT, isolated=False):
    command = [sys.executable, "-I" if isolated else "-B", "-c", code, *map(str, arguments)]
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False, timeout=300)


BUILD_ALL = """
import sys
from pathlib import Path
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
for name, block in list(catalogue().items())[:: int(sys.argv[2])]:
    build_python_fmu(block, Path(sys.argv[1]) / f"{name}.fmu")
"""


BUILD_PLANT = """
import sys
from pathlib import Path
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from perilune.fmus_src.plants.flat_moon_lander import FlatMoonLander
build_python_fmu(FlatMoonLander, Path(sys.argv[1]) / "flat_moon_lander.fmu")
"""


def test_builds_in_two_processes_are_the_same_bytes(fmus, tmp_path):
    every = either(1, 30)
    done = run(f"import os; os.environ['PYTHONHASHSEED']='7'\n{BUILD_ALL}", tmp_path / "again", every)
    assert done.returncode == 0, done.stderr
    for name in list(catalogue())[::every]:
        first, second = (folder / f"{name}.fmu" for folder in (fmus, tmp_path / "again"))
        digests = [hashlib.sha256(path.read_bytes()).hexdigest() for path in (first, second)]
        assert digests[0] == digests[1], name


def test_building_leaves_no_trace_in_the_process(tmp_path):
    before = (list(sys.path), set(sys.modules))
    build_python_fmu(FlatMoonLander, tmp_path / "plant.fmu")
    assert list(sys.path) == before[0]
    assert not {name for name in set(sys.modules) - before[1] if "perilune_" in name or "flat_moon" in name}
    assert [path.name for path in tmp_path.iterdir()] == ["plant.fmu"]


def changed_sources(folder):
    """Copy the sources with another start value of gravity, and thrust that pushes twice as hard."""
    package = folder / "perilune"
    shutil.copytree(ROOT / "fmus_src", package / "fmus_src", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "perilune" / "__init__.py", package)
    for room in ("analysis", "common"):
        (package / room).symlink_to(ROOT / room)
    plant = package / "fmus_src" / "plants" / "flat_moon_lander.py"
    text = plant.read_text()
    changed = text.replace("scale = self.thrust / self.mass / length", "scale = 2.0 * self.thrust / self.mass / length")
    assert changed != text
    plant.write_text(changed)
    return folder


SIDE_BY_SIDE = """
import json, os, sys
from pathlib import Path
import perilune.fmus_src.plants.flat_moon_lander as newer
assert "2.0 * self.thrust" in open(newer.__file__).read()
from perilune.analysis.runtime.instances.instance import instantiate
from perilune.analysis.runtime.system.fmu import load_fmu
fmus = [load_fmu(Path(path).read_bytes(), path) for path in sys.argv[1:]]
instances = [instantiate(fmu, name) for fmu, name in zip(fmus, ("old", "new"))]
reference = lambda name: [fmus[0].variables[name].reference]
speeds = {"old": [], "new": []}
for instance in instances:
    for name, value in {"thrust": 940.0, "burn_duration": 1e9, "thrust_direction[3]": 1.0}.items():
        instance.slave.setReal(reference(name), [value])
    instance.slave.setupExperiment(startTime=0.0)
    instance.slave.enterInitializationMode()
    instance.slave.exitInitializationMode()
for n in range(21):
    for instance, found in zip(instances, speeds.values()):
        found += instance.slave.getReal(reference("velocity[3]"))
        instance.slave.doStep(0.5 * n, 0.5)
print(json.dumps(speeds))
sys.stdout.flush(); os._exit(0)
"""


def test_an_fmu_keeps_the_code_it_was_built_with(fmus, tmp_path):
    """New sources are imported in a process, old and new FMUs step there in turn, each its own way."""
    sources = changed_sources(tmp_path / "newer")
    done = run(BUILD_PLANT, tmp_path / "fmus", cwd=sources)
    assert done.returncode == 0, done.stderr
    fmu = "flat_moon_lander.fmu"
    done = run(SIDE_BY_SIDE, fmus / fmu, tmp_path / "fmus" / fmu, cwd=sources)
    assert done.returncode == 0, done.stderr
    speeds = json.loads(done.stdout)
    time = 0.5 * np.arange(21)
    np.testing.assert_allclose(speeds["old"], (1.0 - 1.62) * time, rtol=1e-12)
    np.testing.assert_allclose(speeds["new"], (2.0 - 1.62) * time, rtol=1e-12)


AWAY = """
import sys, os
assert "" not in sys.path, sys.path
import fmpy
for name in ("fmus_src", "analysis", "common", "perilune"):
    try:
        __import__(name)
    except ImportError:
        continue
    raise SystemExit(f"{name} can be imported")
result = fmpy.simulate_fmu(sys.argv[1], stop_time=1.0, output=["velocity[3]"])
assert abs(result["velocity[3]"][-1] - float(sys.argv[2])) < 1e-12, result
sys.stdout.write("flown"); sys.stdout.flush(); os._exit(0)
"""


@pytest.mark.parametrize("flavour", ["python", "native"])
def test_runs_where_the_repository_cannot_be_imported(fmus, tmp_path, flavour):
    """With -I, from elsewhere; the finder of the editable installation is taken out too."""
    unhook = "import sys\nsys.meta_path[:] = [f for f in sys.meta_path if 'editable' not in repr(f).lower()]\n"
    unhook += f"sys.path[:] = [p for p in sys.path if p != {str(ROOT)!r} and 'editable' not in p]\n"
    block = BlockInstance(FlatMoonLander)
    block.start()
    step = 0.1
    for n in range(10):
        block.do_step(n * step, step)
    done = run(
        unhook + AWAY,
        fmus.parent / flavour / "flat_moon_lander.fmu",
        block.block.velocity[2],
        cwd=tmp_path,
        isolated=True,
    )
    assert (done.returncode, done.stdout) == (0, "flown"), done.stderr


BUILD_AND_FLY = """
import os, sys
from pathlib import Path
import perilune
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from perilune.fmus_src.plants.flat_moon_lander import FlatMoonLander
for k in range(8):
    for _ in range(3):
        perilune.simulate("lunar_terminal_guidance", flavour="python", stop_time=0.2)
    build_python_fmu(FlatMoonLander, Path(sys.argv[1]) / "plant.fmu")
sys.stdout.write("flown"); sys.stdout.flush(); os._exit(0)
"""


@pytest.mark.slow
@pytest.mark.usefixtures("fmus")
def test_building_between_flights_harms_no_fmu_that_is_loaded(tmp_path):
    """The builder once took away the references that keep the scripts of loaded FMUs alive."""
    done = run(BUILD_AND_FLY, tmp_path)
    assert (done.returncode, done.stdout) == (0, "flown"), done.stderr


@pytest.mark.parametrize("flavour", ["python", "native"])
def test_instances_come_and_go(fmus, flavour):
    path = fmus.parent / flavour / "noisy_navigation.fmu"
    fmu = load_fmu(path.read_bytes(), str(path))
    other = load_fmu(path.read_bytes(), str(path))
    for _ in range(20):
        pair = [instantiate(fmu, "a"), instantiate(other, "a")]
        for instance in pair:
            instance.slave.setupExperiment(startTime=0.0)
            instance.slave.enterInitializationMode()
            instance.slave.exitInitializationMode()
            instance.slave.doStep(0.0, 0.1)
        for instance in pair:
            instance.slave.terminate()
            instance.free()


def test_an_exception_in_a_step_comes_with_its_traceback(tiny_folder, tmp_path):
    body = system(component("trouble", "trouble", "output y Real m"))
    path = pack(tmp_path / "s.ssp", tiny_folder / "python", document(body))
    result = fly(path, set={"trouble.kind": 1})
    assert result.status == "failed"
    assert "fmi2DoStep returned discard" in result.message
    for words in ("Traceback", "ZeroDivisionError", "self.y = self.y / 0.0", "tiny_blocks.py"):
        assert words in result.message, result.message
    result = fly(path, set={"trouble.kind": 4})  # the module was imported from a folder that is gone by now
    for words in ("Traceback", "ZeroDivisionError", "in initialize", "self.y = 1.0 / 0.0"):
        assert words in result.message, result.message


def test_a_step_past_the_stop_time_is_refused_in_the_words_of_the_native_fmu(fmus):
    """Rounded sums of steps, which end a little after it, are not; without a stop time there is no end."""
    said = {}
    for flavour in ("python", "native"):
        path = shipped_fmu("flat_moon_lander", flavour)
        fmu = load_fmu(path.read_bytes(), str(path))
        for stop in (0.3, None):
            instance = instantiate(fmu, "plant")
            instance.slave.setupExperiment(startTime=0.0, stopTime=stop)
            instance.slave.enterInitializationMode()
            instance.slave.exitInitializationMode()
            for t, h in ((0.0, 0.1), (0.1, 0.1), (0.2, 0.1)):
                instance.slave.doStep(t, h)
            if stop is None:
                instance.slave.doStep(0.2 + 0.1, 0.1)
            else:
                with pytest.raises(FMICallException):
                    instance.slave.doStep(0.2 + 0.1, 0.1)
                said[flavour] = instance.messages[-1].strip().splitlines()[-1]
            instance.free()
    assert said["native"] == "StepError: the step ends at 0.4 s, after the stop time of 0.3 s"
    assert said["python"].endswith(said["native"])


PERCENT = '''
from perilune.fmus_src.block import Block, Output


class Percent(Block):
    """Raises with a printf format in its message."""

    python_only = True
    y = Output(0.0, unit="1", description="nothing")

    def step(self, t: float, h: float) -> None:
        raise ValueError("100 %s %n of 50 % \\u00e9")
'''


def test_messages_are_not_read_as_formats(tmp_path):
    (tmp_path / "percent.py").write_text(PERCENT)
    build_own_blocks(tmp_path / "percent.py", tmp_path, ["python"], [])
    path = pack(tmp_path / "s.ssp", tmp_path / "python", document(system(component("p", "percent"))))
    result = fly(path)
    assert "100 %s %n of 50 %" in result.message


FLIGHT = """
import sys
from perilune.analysis.cli import run
sys.argv[1:] = sys.argv[1:] or ["run", "entry_attitude", "--flavour", "python", "--stop-time", "2"]
run()
"""


def statuses(count):
    actual = [run(FLIGHT) for _ in range(count)]
    return {(done.returncode, done.stderr) for done in actual}


@pytest.mark.slow
@pytest.mark.usefixtures("fmus")
def test_exit_status_is_right_100_times():
    assert statuses(100) == {(0, "")}


BATCH = "batch lunar_terminal_guidance --campaign paper --trials 4 --stop-time 1 --flavour python --workers"


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize(
    "words",
    ["", pytest.param(f"{BATCH} 1", marks=pytest.mark.slow), f"{BATCH} 2"],
    ids=["run", "batch", "batch in processes"],
)
def test_unpacked_files_are_gone_afterwards_and_the_exit_status_is_right(tmp_path, words):
    done = subprocess.run(
        [sys.executable, "-c", FLIGHT, *words.split()],
        cwd=ROOT,
        env={**os.environ, "TMPDIR": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr if words == "" else "") == (0, ""), done.stderr
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith("perilune")] == []


def test_the_fmu_steps_as_the_plain_object(fmus):
    path = fmus / "flat_moon_lander.fmu"
    fmu = load_fmu(path.read_bytes(), str(path))
    block = BlockInstance(FlatMoonLander)
    instance = instantiate(fmu, "plant")
    slave = instance.slave
    reals = [v.reference for v in fmu.variables.values() if v.type == "Real" and v.causality == "output"]
    inputs = [v.reference for v in fmu.variables.values() if v.causality == "input"]
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    block.start()
    source = np.random.default_rng(4)
    for n in range(50):
        values = source.uniform(0.1, 3.0, len(inputs)).tolist()
        slave.setReal(inputs, values)
        block.set(inputs, values)
        slave.doStep(n * 0.1, 0.1)
        block.do_step(n * 0.1, 0.1)
        assert slave.getReal(reals) == block.get(reals)
    instance.free()
