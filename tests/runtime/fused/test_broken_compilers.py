"""Broken compilers, and libraries that changed after compilation.

Truth: the refusal in one line, and the same system simulated by its FMUs.
"""

import errno
import sys
import threading
import time
import zipfile

import pytest

import perilune
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.fused import fuse
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from perilune.common.machine import cached
from perilune.common.paths import shipped_fmu
from perilune.fmus_src.export import libraries
from tests.support.builders import component, document, pack, system

RAMP = document(system(component("ramp", "ramp", "output y Real m")))
SLEEP = "import time; time.sleep(60)"
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="compilers here are scripts")


@pytest.fixture
def ramp(tiny_folder, tmp_path, monkeypatch):
    """Write a system, whose fused steps are in a separate cache."""
    monkeypatch.setattr(fuse, "CACHE", tmp_path)
    fuse._load.cache_clear()
    return pack(tmp_path / "s.ssp", tiny_folder / "native", RAMP)


@pytest.fixture
def compiler(tmp_path, monkeypatch):
    """Put a script of Python in place of the compiler, or another program."""

    def replace(text):
        script = tmp_path / "cc"
        script.write_bytes(text if isinstance(text, bytes) else f"#!{sys.executable}\n{text}\n".encode())
        script.chmod(0o755)
        monkeypatch.setattr(libraries, "compilers_for", lambda *_: [[str(script)]])
        for remembered in (libraries._identity, libraries._processor):
            remembered.cache_clear()

    return replace


def of(path, **options):
    return prepare_system(path, SystemOptions(**options))


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "the compiler wrote no library"),
        ("raise SystemExit(3)", "it ended with status 3 without a message"),
        ("import os; os.kill(os.getpid(), 9)", "it ended by SIGKILL without a message"),
        (
            r"import os, sys; os.write(2, b'error: \xff\xfe'); sys.exit(1)",
            "the compiler rejects the C code of the steps: error: ",
        ),
        ("open('fused.so', 'w').write('x')", "the compiler's output is not a library"),
        (b"#!/no/such/interpreter\n", "cannot be run: No such file or directory"),
    ],
)
def test_refused_in_one_line(ramp, compiler, text, problem):
    compiler(text)
    with pytest.raises(InputError, match=problem) as refused:
        Simulation(of(ramp, flavour="fused"))
    assert "\n" not in str(refused.value)
    with Simulation(of(ramp)) as simulation:
        with pytest.raises(InputError, match=problem):
            simulation.fuse()
        assert simulation.prepared.options.chosen["flavour"] is None
        assert simulation.fly().complete


def test_a_cache_that_cannot_be_written(ramp, tmp_path):
    (tmp_path / "fused").write_text("a file in place of the folder")
    with (
        pytest.warns(UserWarning, match=r"fused: Not a directory: the cache is not used"),
        Simulation(of(ramp, flavour="fused")) as simulation,
    ):
        assert simulation.fly().complete


def test_without_room_for_a_library_anywhere(ramp, monkeypatch):
    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(libraries, "_compile", full)
    with pytest.raises(
        InputError, match=r"the library cannot be written: .*: No space left on device; free some space"
    ):
        Simulation(of(ramp, flavour="fused"))


def test_a_damaged_library_is_compiled_anew(ramp, tmp_path):
    """A cut one would end the process with SIGBUS, one of other bytes with anything."""
    with Simulation(of(ramp, flavour="fused")) as simulation:
        expected = simulation.fly()
    extension = libraries.PLATFORMS[fuse.local_platform()].extension
    (library,) = (tmp_path / "fused").glob(f"*{extension}")
    whole = library.read_bytes()
    for damaged in (b"", whole[:4000], whole[:-1] + b"\0\1"):
        library.unlink()  # the process has the old one open
        library.write_bytes(damaged)
        fuse._load.cache_clear()
        cached._warned.clear()
        with (
            pytest.warns(UserWarning, match="damaged files"),
            Simulation(of(ramp, flavour="fused")) as simulation,
        ):
            assert simulation.fly().signals["ramp.y"].tobytes() == expected.signals["ramp.y"].tobytes()
        assert library.read_bytes() == whole


def test_an_interruption_ends_the_compiler(ramp, compiler):
    """Closing the simulation meanwhile leaves the instances alone, which the compilation looks at."""
    compiler(f"import sys\nif '-o' in sys.argv:\n    open({str(ramp.with_name('begun'))!r}, 'w').close(); {SLEEP}")
    problems = []

    def work(simulation):
        try:
            simulation.fuse()
        except InputError as error:
            problems.append(error.problem)

    with Simulation(of(ramp)) as simulation:
        thread = threading.Thread(target=work, args=(simulation,))
        thread.start()
        while not ramp.with_name("begun").exists():
            time.sleep(0.01)
        simulation.close()
        assert simulation.instances
        simulation.interrupt()
        thread.join(30)
        assert not thread.is_alive()
    assert problems == ["the compiler rejects the C code of the steps: ended, since its result is no longer needed"]
    assert not simulation.instances


@pytest.mark.usefixtures("fmus")
def test_what_is_simulated_elsewhere(tmp_path):
    """Before anything is written."""
    campaign = ("lunar_terminal_guidance", "paper")
    options = {"trials": 2, "flavour": "fused", "output": tmp_path / "out"}
    with pytest.raises(InputError, match="flavour: fused: the system is simulated in child processes"):
        perilune.batch(*campaign, engine="processes", workers=1, **options)
    with pytest.raises(InputError, match="flavour: fused: shards choose for themselves whether to compile steps"):
        perilune.prepare(*campaign, **options)
    with pytest.raises(InputError, match="flavour: fused: the system is simulated in child processes"):
        perilune.simulate("lunar_terminal_guidance", flavour="fused", use={"guidance": foreign(tmp_path)})
    assert not (tmp_path / "out").exists()


def foreign(folder):
    """Pack a guidance of Perilune's again, so that its bytes are not known any more."""
    path = folder / "guidance.fmu"
    with zipfile.ZipFile(shipped_fmu("analytic_guidance", "native")) as shipped, zipfile.ZipFile(path, "w") as packed:
        for name in shipped.namelist():
            packed.writestr(name, shipped.read(name))
    return path
