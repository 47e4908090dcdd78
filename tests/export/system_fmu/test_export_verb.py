"""`perilune export --as-fmu` as called by users: output, and refusals.

Truth: the expected lines and exit status 2 for errors; FMI 2.0's schema; a second build, byte by byte.
"""

import subprocess
import sys
import zipfile

import fmpy
import pytest
from lxml import etree

import perilune
from perilune.analysis.cli import main
from perilune.fmus_src.export.compilers import local_platform
from tests.support.builders import component, connection, document, inline, pack, system

SLOTS = "guidance=analytic_guidance,astar_guidance"
NAME = "lunar_terminal_guidance"


@pytest.fixture(scope="module")
def folder(fmus, tmp_path_factory):
    return tmp_path_factory.mktemp("exported")


@pytest.fixture(scope="module")
def exported(folder):
    output = folder / "lander.fmu"
    done = perilune.export(
        NAME,
        as_fmu=True,
        slots={"guidance": "analytic_guidance,astar_guidance"},
        expose=["plant.position"],
        faults=["navigation.estimated_position[1]"],
        set={"plant.initial_mass": 900.0},
        stop_time=300.0,
        platforms=[local_platform()],
        output=output,
    )
    assert done.lines() == [str(output)]
    return output


def test_variables(exported):
    description = fmpy.read_model_description(str(exported), validate=True)
    variables = {each.name: each for each in description.modelVariables}
    assert [name for name, each in variables.items() if each.causality == "output"] == ["finished"]
    exposed = [name for name, each in variables.items() if each.causality == "local"]
    assert exposed == ["plant.position[1]", "plant.position[2]", "plant.position[3]"]
    assert variables["plant.initial_mass"].start == "900.0"
    assert variables["plant.initial_mass"].unit == "kg"
    candidates = {name for name in variables if name.startswith("guidance.")}
    assert {"guidance.use", "guidance.analytic_guidance.gravity", "guidance.astar_guidance.gravity"} <= candidates
    assert [item.name for item in variables["guidance.use"].declaredType.items] == [
        "analytic_guidance",
        "astar_guidance",
    ]
    fault = variables["fault.navigation.estimated_position[1].value"]
    assert (fault.causality, fault.unit) == ("input", "m")
    assert (description.defaultExperiment.stopTime, description.defaultExperiment.stepSize) == ("300.0", "0.1")


def test_files(exported):
    with zipfile.ZipFile(exported) as files:
        names = set(files.namelist())
        noisy = etree.fromstring(files.read("resources/noisy.ssv"))
    declared = {each.name for each in fmpy.read_model_description(str(exported)).modelVariables}
    parameters = {each.get("name") for each in noisy.iter("{*}Parameter")}
    assert {"navigation.position_sigma", "allocation.thrust_lag"} <= parameters <= declared
    assert {"documentation/index.html", "sources/README.md", f"sources/{NAME}.c"} <= names
    assert "sources/single_block.h" not in names
    assert main(["verify", str(exported)]) == 0


def test_a_second_build_is_the_same(exported, folder):
    arguments = ["--slot", SLOTS, "--expose", "plant.position", "--faults", "navigation.estimated_position[1]"]
    arguments += ["--set", "plant.initial_mass=900", "--stop-time", "300", "--platform", local_platform()]
    assert main(["export", NAME, "--as-fmu", *arguments, "--output", str(folder / "again.fmu")]) == 0
    assert (folder / "again.fmu").read_bytes() == exported.read_bytes()


WRONG = {
    ("--slot", SLOTS): "--slot: guidance: applies only to a system as one FMU; give --as-fmu, or leave out this option",
    (
        "--set",
        "plant.initial_mass=900",
    ): "--set: plant.initial_mass: applies only to a system as one FMU; give --as-fmu",
    (
        "--as-fmu",
        "--fmi",
        "3",
    ): "--fmi: 3: a system exported as one FMU is an FMI 2.0 FMU compiled from native FMUs; leave out --fmi",
    ("--as-fmu", "--flavour", "python"): "--flavour: python: a system exported as one FMU is an FMI 2.0 FMU",
    ("--as-fmu", "--ssp", "2"): "--ssp: 2: a system exported as one FMU",
    ("--as-fmu", "--study", "all"): "--study: all: a system exported as one FMU cannot contain reports",
    ("--as-fmu", "--output", "x.ssp"): "--output: x.ssp",
    ("--as-fmu", "--expose", "plant.altitud"): "--expose: plant.altitud: no such variable",
    (
        "--as-fmu",
        "--expose",
        "plant.gravity",
    ): "--expose: plant.gravity: a parameter, which is always a parameter of the FMU",
    ("--as-fmu", "--faults", "plant.gravit"): "--faults: plant.gravit: no component has such a connector",
    ("--as-fmu", "--faults", "plant.initial_mass"): (
        "--faults: plant.initial_mass: a parameter that is fixed after initialisation; set it before the start by --set"
    ),
    ("--as-fmu", "--slot", "pilot=analytic_guidance"): "--slot: pilot: no such component; use one of",
    (
        "--as-fmu",
        "--slot",
        "guidance=analytic_guidance,",
    ): "--slot: guidance=analytic_guidance,: a candidate has an empty name",
    (
        "--as-fmu",
        "--slot",
        "guidance=astar_guidance,astar_guidance",
    ): "two candidates have the same name; give each candidate once",
    ("--as-fmu", "--slot", "guidance=astar"): "--slot: guidance=astar: no such FMU is built",
    ("--as-fmu", "--slot", SLOTS, "--use", "guidance=astar_robust_guidance"): "which is not among the candidates",
}


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("arguments", WRONG, ids=" ".join)
def test_wrong_calls(arguments, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["export", NAME, *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert WRONG[arguments] in line
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("fmus")
def test_what_is_no_system(refusal):
    assert "--as-fmu: analytic_guidance: only a system can become one FMU" in refusal(
        ["export", "analytic_guidance", "--as-fmu"]
    )


def test_without_a_compiler(fmus, tmp_path):
    nothing = "import shutil, importlib.util as u, sys; shutil.which = u.find_spec = lambda *_: None;"
    call = f"{nothing} from perilune.analysis.cli import main; sys.exit(main(sys.argv[1:]))"
    arguments = ["export", NAME, "--as-fmu", "--output", str(tmp_path / "one.fmu")]
    ended = subprocess.run([sys.executable, "-c", call, *arguments], capture_output=True, text=True, check=False)
    assert ended.returncode == 2
    problem = "needs a C compiler, and none is installed; install cc, or pip install ziglang"
    assert ended.stderr == f"perilune: export: {NAME}: {problem}\n"
    assert not (tmp_path / "one.fmu").exists()


def test_foreign_and_python_fmus_are_refused(tiny_folder, tmp_path, capsys):
    ssd = document(
        system(
            component("ramp", "ramp", "output y Real m"),
            component("stranger", "stranger", "input u Real; output y Real"),
            connections=connection("ramp.y", "stranger.u", attributes='suppressUnitConversion="true"'),
        )
    )
    path = pack(tmp_path / "s.ssp", tiny_folder / "native", ssd)
    assert main(["export", str(path), "--as-fmu", "--output", str(tmp_path / "s.fmu")]) == 2
    error = capsys.readouterr().err
    assert "stranger: its FMU" in error
    assert "is not a native FMU of Perilune for FMI 2.0, whose C code is needed; export the system as .ssp" in error


def test_parameters_of_systems(tiny_folder, tmp_path):
    """Closed form: they pass through a nested system, a transformation on the way; y = start of the ramp."""
    inner = system(
        component("ramp", "ramp", "parameter start Real m; output y Real m"),
        connections=connection("start", "ramp.start", '<ssc:LinearTransformation factor="2" offset="1"/>')
        + connection("ramp.y", "y"),
        declared="parameter start Real m; output y Real m",
        name="inner",
    )
    ssd = document(
        system(
            inner,
            connections=connection("start", "inner.start") + connection("inner.y", "y"),
            declared="parameter start Real m; output y Real m",
            bindings=inline("start=Real:3 m"),
        )
    )
    path = pack(tmp_path / "s.ssp", tiny_folder / "native", ssd)
    fmu = tmp_path / "s.fmu"
    perilune.export(path, as_fmu=True, platforms=[local_platform()], output=fmu)
    variables = {each.name: each for each in fmpy.read_model_description(str(fmu)).modelVariables}
    assert variables["start"].start == "3.0"
    assert "inner.ramp.start" not in variables
    for start in (3.0, -8.5):
        assert fmpy.simulate_fmu(str(fmu), start_values={"start": start}, output=["y"])["y"][0] == 2.0 * start + 1.0
