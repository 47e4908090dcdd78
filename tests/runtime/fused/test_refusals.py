"""Refusals of systems that cannot be fused, in one line.

Truth: the expected lines, and the exit status 2.
"""

import subprocess
import sys

import pytest

from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.fused import fuse
from perilune.analysis.runtime.fused.component_code import component_code
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.builders import component, document, pack, system

RAMP = document(system(component("ramp", "ramp", "output y Real m")))


def test_without_a_compiler(fmus, tmp_path):
    """Everything else flies: the same command without the option."""
    nothing = "import shutil, importlib.util as u, sys; shutil.which = u.find_spec = lambda *_: None;"
    call = "from perilune.analysis.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", f"{nothing} {call}", "run", "robot_rendezvous", "--stop-time", "1"]
    ended = subprocess.run([*command, "--flavour", "fused"], capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stderr.count("\n")) == (2, 1)
    assert (
        "--flavour: fused: needs a C compiler, and none is installed; install cc, or pip install ziglang"
        in ended.stderr
    )
    assert subprocess.run(command, capture_output=True, check=False).returncode == 0


def test_a_system_of_python_fmus(tiny_folder, tmp_path, refusal):
    path = pack(tmp_path / "s.ssp", tiny_folder / "python", RAMP)
    expected = "the system has no native FMU of Perilune that could be fused; leave --flavour out"
    assert expected in refusal(["run", str(path), "--flavour", "fused"])


def test_c_of_another_build():
    with pytest.raises(
        InputError, match=r"^x\.fmu: sources: its C code does not have the interface .*; export the FMU again"
    ):
        component_code({"ramp.c": "int main(void) { return 0; }"}, "ramp", "k0_", "x.fmu")
    with pytest.raises(InputError, match=r"^x\.fmu: sources/fmi2_types\.h: is missing"):
        component_code({"ramp.c": '#include "fmi2_wrapper.h"\n'}, "ramp", "k0_", "x.fmu")


def test_c_that_has_an_instance_otherwise_than_the_binary(tiny_folder, tmp_path, monkeypatch):
    """As of an FMU whose sources are of one build, and its binary of another."""
    prepared = prepare_system(pack(tmp_path / "s.ssp", tiny_folder / "native", RAMP), SystemOptions(flavour="fused"))
    fmu = prepared.network.fmus["ramp"]
    sources = fmu.read_sources()
    wider = {name: text.replace("Logger logger;", "double more; Logger logger;") for name, text in sources.items()}
    wider = {
        name: text.replace("    Block block;\n", "    double more;\n    Block block;\n") for name, text in wider.items()
    }
    monkeypatch.setattr(type(fmu), "read_sources", lambda _: wider)
    monkeypatch.setattr("perilune.analysis.runtime.fused.fuse._CODES._known", {})
    with pytest.raises(
        InputError, match=r"ramp\.fmu: sources: the address of \w+ in its C code differs from its binary"
    ):
        Simulation(prepared)


@pytest.mark.parametrize(
    ("change", "refusal"),
    [
        (
            {"MOST_INSTRUCTIONS": 1},
            "the sequence of steps repeats only after 1 communication steps, too many for one function",
        ),
        (
            {"FLAGS": ("--no-such-flag",)},
            r"the compiler rejects the C code of the steps: .*error.*no-such-flag.*; give flavour native$",
        ),
    ],
)
def test_what_would_not_be_compiled(tiny_folder, tmp_path, monkeypatch, change, refusal):
    """One line of what the compiler says."""
    for name, bound in change.items():
        monkeypatch.setattr(fuse, name, bound)
    prepared = prepare_system(pack(tmp_path / "s.ssp", tiny_folder / "native", RAMP), SystemOptions(flavour="fused"))
    with pytest.raises(InputError, match=refusal) as refused:
        Simulation(prepared)
    assert "\n" not in str(refused.value)
