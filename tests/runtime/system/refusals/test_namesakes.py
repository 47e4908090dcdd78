"""Two FMUs whose different code has the same name in one process: the second FMU must not run the code of the first.

Truth: each FMU alone returns the number in its helper module.
"""

import math
import numbers
import subprocess
import sys
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZipFile

import fmpy
import pytest
from pythonfmu import FmuBuilder

import perilune
from perilune.analysis.cli import main
from perilune.common.errors import InputError
from tests.support.builders import component, document, pack, system, write_zip
from tests.support.foreign import lag
from tests.support.foreign.library import library

pytestmark = pytest.mark.flies
SCRIPT = """
from pythonfmu import Fmi2Causality, Fmi2Slave, Real
import {module}


class Namesake(Fmi2Slave):
    def __init__(self, **keywords):
        super().__init__(**keywords)
        self.y = 0.0
        self.register_variable(Real("y", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.y = {module}.NUMBER
        return True
"""
STEP = 0.25  # s


@cache
def template() -> dict[str, str | bytes]:
    """Return the files of an FMU by pythonfmu, whose builder imports its scripts into this process."""
    with TemporaryDirectory() as folder:
        script, helper = Path(folder, "script_of_template.py"), Path(folder, "helper_of_template.py")
        helper.write_text("NUMBER = 0.0\n")
        script.write_text(SCRIPT.format(module=helper.stem))
        with ZipFile(FmuBuilder.build_FMU(script, folder, project_files=[helper])) as archive:
            return {name: archive.read(name) for name in archive.namelist()}


def python_fmu(folder: Path, name: str, number: float, module: str = "helper", script: str = "") -> Path:
    """Write ``folder``/name.fmu, whose output is a number of a module that it brings."""
    script = script or f"script_{name}"
    content = {key: file for key, file in template().items() if not key.endswith("_of_template.py")} | {
        f"resources/{module}.py": f"NUMBER = {number}\n",
        f"resources/{script}.py": SCRIPT.format(module=module),
        "resources/slavemodule.txt": script,
    }
    return write_zip(folder / f"{name}.fmu", content)


def c_fmu(folder: Path, name: str, number: float, shared_name: str) -> Path:
    """Write ``folder``/name.fmu, a lag whose time constant is a number of a library that it brings."""
    sources = folder / f"of_{name}"
    sources.mkdir()
    (sources / "helper.c").write_text(f"double helper_number(void) {{ return {number}; }}\n")
    (sources / "helper.h").write_text("double helper_number(void);\n")
    helper = library("helper", (f"-Wl,-soname,{shared_name}",), sources)
    (sources / shared_name).write_bytes(helper)
    linked = ("-Wl,--no-as-needed,-rpath,$ORIGIN", str(sources / shared_name))
    macros = ("-include", str(sources / "helper.h"), "-DTAU=helper_number()", *linked)
    binaries = f"binaries/{fmpy.platform}"
    content = {
        "modelDescription.xml": lag.DESCRIPTION,
        f"{binaries}/lag{fmpy.sharedLibraryExtension}": library("lag", macros, Path(lag.__file__).parent),
        f"{binaries}/{shared_name}": helper,
    }
    return write_zip(folder / f"{name}.fmu", content)


def both(folder: Path, *names: str, kind: str = "output y Real") -> Path:
    """Write a system of these FMUs."""
    components = (component(f"c{n}", name, kind) for n, name in enumerate(names))
    return pack(folder / "both.ssp", folder, document(system(*components), step=STEP))


def refusal(capsys, path, *options):
    """Return the line of `run` and `validate`, the same with exit status 2."""
    lines = []
    for verb in (["run", str(path), *options], ["validate", str(path)]):
        assert main(verb) == 2
        lines.append(capsys.readouterr().err)
    assert lines[0] == lines[1]
    assert len(lines[0].splitlines()) == 1
    return lines[0]


def test_a_second_fmu_with_another_helper_ran_the_first_ones(tmp_path, capsys):
    python_fmu(tmp_path, "one", 1.0)
    python_fmu(tmp_path, "two", 2.0)
    line = refusal(capsys, both(tmp_path, "one", "two"))
    assert "resources/two.fmu: resources/helper.py: another module helper is resources/helper.py of" in line
    assert "resources/one.fmu, and a process can load only one; rename the module, or put it into a package" in line


def test_scripts_of_one_name_are_modules_too(tmp_path, capsys):
    python_fmu(tmp_path, "one", 1.0, "first", script="model")
    python_fmu(tmp_path, "two", 2.0, "second", script="model")
    assert "another module model is resources/model.py of" in refusal(capsys, both(tmp_path, "one", "two"))


def test_helpers_that_are_equal_or_have_other_names_fly(tmp_path):
    python_fmu(tmp_path, "one", 1.0)
    python_fmu(tmp_path, "same", 1.0)
    python_fmu(tmp_path, "two", 2.0, "other")
    flight = perilune.simulate(both(tmp_path, "one", "same", "two", "one"))
    assert [flight[f"c{n}.y"][-1] for n in range(4)] == [1.0, 1.0, 2.0, 1.0]


def test_two_libraries_of_one_soname_were_one(tmp_path, capsys):
    c_fmu(tmp_path, "one", 1.0, "libhelper.so.1")
    c_fmu(tmp_path, "two", 2.0, "libhelper.so.1")
    path = both(tmp_path, "one", "two", kind="input u Real; output y Real")
    line = refusal(capsys, path, "--open-inputs", "start")
    binaries = f"binaries/{fmpy.platform}"
    assert f"another library libhelper.so.1 is {binaries}/libhelper.so.1 of" in line
    assert "give the library another file name and SONAME, in one of the two FMUs" in line


@pytest.mark.parametrize("other", ["libhelper.so.1", "libother.so.1"])
def test_libraries_that_are_equal_or_have_other_names_fly(tmp_path, other):
    """Each lag with its own time constant, as the closed form has it."""
    numbers = 1.0, 1.0 if other == "libhelper.so.1" else 2.0
    c_fmu(tmp_path, "one", numbers[0], "libhelper.so.1")
    c_fmu(tmp_path, "two", numbers[1], other)
    path = both(tmp_path, "one", "two", kind="input u Real; output y Real")
    flight = perilune.simulate(path, open_inputs="start", set={"c0.u": 1.0, "c1.u": 1.0})
    for n, constant in enumerate(numbers):
        assert flight[f"c{n}.y"][-1] == pytest.approx(1.0 - math.exp(-1.0 / constant), rel=1e-14)


def test_an_fmu_that_brings_a_module_of_perilune_got_ours(tmp_path, capsys):
    python_fmu(tmp_path, "one", 1.0, "psutil")
    line = refusal(capsys, both(tmp_path, "one"))
    assert (
        "resources/psutil.py: Perilune has loaded another module psutil, and a process can load only one; rename"
        in line
    )


def test_a_module_that_perilune_does_not_load_is_that_of_the_fmu(tmp_path):
    """`this` of the standard library, which has no number."""
    python_fmu(tmp_path, "one", 3.0, "this")
    assert perilune.simulate(both(tmp_path, "one"))["c0.y"][-1] == 3.0


@pytest.mark.parametrize("more", ["", "# changed"])
def test_a_module_of_perilune_that_is_equal_flies(tmp_path, more):
    """A copy of a module of the standard library that every process has loaded; a changed one does not."""
    with ZipFile(python_fmu(tmp_path, "one", 3.0), "a") as archive:
        archive.writestr("resources/numbers.py", Path(numbers.__file__).read_text() + more)
    path = both(tmp_path, "one")
    if more:
        with pytest.raises(InputError, match="Perilune has loaded another module numbers"):
            perilune.simulate(path)
    else:
        assert perilune.simulate(path)["c0.y"][-1] == 3.0


def test_variants_in_children_have_each_their_code(tmp_path):
    """A child's process ends with its system."""
    python_fmu(tmp_path, "one", 1.0)
    two = python_fmu(tmp_path, "two", 2.0)
    path = both(tmp_path, "one")
    assert perilune.simulate(path)["c0.y"][-1] == 1.0
    assert perilune.simulate(path, use={"c0": two})["c0.y"][-1] == 2.0


IN_PROCESS = """
import sys
import perilune
one, two = sys.argv[1:]
print(perilune.simulate(one, in_process=True, stop_time=1.0, step=0.25)["Namesake.y"][-1])
print(perilune.simulate(two, stop_time=1.0, step=0.25)["Namesake.y"][-1])
perilune.simulate(two, in_process=True, stop_time=1.0, step=0.25)
"""


def test_in_this_process_fmus_are_compared_with_all_that_it_has_loaded(tmp_path):
    """Modules outlive their FMU; another process, since loaded modules stay."""
    files = [python_fmu(tmp_path, "one", 1.0), python_fmu(tmp_path, "two", 2.0)]
    ended = subprocess.run(
        [sys.executable, "-c", IN_PROCESS, *map(str, files)], capture_output=True, text=True, check=False
    )
    assert ended.stdout.split() == ["1.0", "2.0"]
    assert (
        f"{files[1]}: resources/helper.py: another module helper is resources/helper.py of {files[0]}" in ended.stderr
    )


def test_a_variant_in_this_process_is_refused_when_it_would_be_loaded(tmp_path):
    files = [python_fmu(tmp_path, "three", 1.0, "third"), python_fmu(tmp_path, "four", 2.0, "third")]
    path = both(tmp_path, "three")
    campaign = tmp_path / "c.toml"
    campaign.write_text(
        f'system = "both"\ntrials = 2\nseed = 1\n[compare]\n"c0" = ["{files[0]}", "{files[1]}"]\n'
        '[metric.last]\nexpression = "c0.y"\nreduction = "final"\n[success]\nexpression = "last > 0"\n'
    )
    with pytest.raises(InputError, match="another module third is"):
        perilune.batch(path, campaign, in_process=True, workers=1)
    apart = perilune.batch(path, campaign, workers=1).to_pandas()
    assert sorted(apart["metric.last"]) == [1.0, 1.0, 2.0, 2.0]
