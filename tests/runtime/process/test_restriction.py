"""Restrictions on foreign FMUs in their process: no writing elsewhere, no network access, no access to other processes.

Truth: the errors that the operating system returns to an FMU that tries; the files in the folders afterwards.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from perilune.analysis.runtime.process.restriction import find_missing
from tests.support.foreign.odd_fmu import Call, Deed, odd_fmu

pytestmark = [pytest.mark.flies, pytest.mark.skipif(bool(find_missing()), reason="the system restricts no processes")]
REFUSED = ("home", "temporary folder", "results", "TCP", "UDP", "AF_UNIX", "io_uring", "ptrace", "signal")
# Of the process that started it: limits end it, the others slow it down.
SETTINGS = (
    "prlimit64",
    "setpriority",
    "setpriority of a user",
    "setpriority of a group",
    "ioprio_set",
    "ioprio_set of a user",
    "sched_setaffinity",
    "sched_setparam",
    "sched_setscheduler",
    "sched_setattr",
    "migrate_pages",
    "move_pages",
    "kcmp",
    "process_mrelease",
)
OF_ITSELF = (
    "own prlimit64",
    "own prlimit64 by number",
    "own setpriority",
    "own ioprio_set",
    "own sched_setaffinity",
    "own sched_setparam",
    "own sched_setscheduler",
    "own sched_setattr",
)
NO = ("Permission denied", "Operation not permitted")


def tries(folder, *options):
    """Return the report of an FMU that tries everything: the result of each attempt."""
    fmu = odd_fmu(folder, DEED=Deed.TRY, IN=Call.INITIALISATION)
    (folder / "home").mkdir()
    (folder / "results").mkdir()
    environment = {**os.environ, "HOME": str(folder / "home"), "TRY_RESULTS": str(folder / "results")}
    command = [sys.executable, "-m", "perilune", "run", str(fmu), "--stop-time", "1", *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment, timeout=100)
    assert done.returncode == 0, done.stderr
    lines = [line.removeprefix("odd: ").split(": ") for line in done.stderr.splitlines()]
    return {line[0]: line[1] for line in lines if len(line) == 2}


def test_what_is_refused(tmp_path):
    """The simulation continues."""
    said = tries(tmp_path)
    assert {name: said[name] for name in ("own folder", "socketpair")} == {"own folder": "done", "socketpair": "done"}
    assert {name: said[name] in NO for name in REFUSED} == dict.fromkeys(REFUSED, True)
    refused = {name for name, answer in said.items() if answer == "Operation not permitted"}
    assert set(SETTINGS) - refused == set()
    assert {name: said[name] for name in OF_ITSELF} == dict.fromkeys(OF_ITSELF, "done")
    assert not (tmp_path / "home" / "perilune_tried").exists()
    assert not list((tmp_path / "results").iterdir())


def test_what_is_allowed(tmp_path):
    said = tries(tmp_path, "--allow", "network", "--allow", f"write={tmp_path / 'results'}")
    done = ("own folder", "results", "TCP", "UDP", "AF_UNIX", "socketpair", *OF_ITSELF)
    assert {name for name, answer in said.items() if answer == "done"} - {"signal to all"} == set(done)
    assert [path.name for path in (tmp_path / "results").iterdir()] == ["tried"]


# Answers ENOSYS to Landlock's calls and to new filters, as an older system does, and becomes the command.
WITHOUT = """
import ctypes, errno, os, sys
from perilune.analysis.runtime.process import seccomp as r
from perilune.analysis.runtime.process.restriction import PR_SET_NO_NEW_PRIVS
ENOSYS = 0x00050000 | errno.ENOSYS
code = [r.instruction(r.LOAD, r.NUMBER)]
for number in (444, 445, 446, 317):
    code += [r.instruction(r.IS_EQUAL, number, 0, 1), r.instruction(r.RETURN, ENOSYS)]
code += [r.instruction(r.IS_EQUAL, 157, 0, 3), r.instruction(r.LOAD, r.FIRST_ARGUMENT)]
code += [r.instruction(r.IS_EQUAL, r.PR_SET_SECCOMP, 0, 1), r.instruction(r.RETURN, ENOSYS)]
code += [r.instruction(r.RETURN, r.ALLOW)]
libc = ctypes.CDLL(None, use_errno=True)
assert libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0
whole = r.Filter(len(code), b"".join(code))
assert libc.prctl(r.PR_SET_SECCOMP, r.SECCOMP_MODE_FILTER, ctypes.byref(whole), 0, 0) == 0
os.execv(sys.executable, [sys.executable, "-m", "perilune", *sys.argv[1:]])
"""


@pytest.mark.parametrize(("options", "status"), [([], 0), (["--isolate", "strict"], 2)])
def test_a_system_without_restrictions(tmp_path, options, status):
    """It says so and flies, unless it is to be strict."""
    fmu = odd_fmu(tmp_path)
    command = [sys.executable, "-c", WITHOUT, "run", str(fmu), "--stop-time", "1", *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=100)
    assert done.returncode == status, done.stderr
    (line,) = done.stderr.splitlines()
    assert "no Landlock, so they can write wherever you can write; no seccomp filters" in line
    assert line.startswith(
        "perilune: foreign FMUs are not restricted" if not options else "perilune: --isolate: strict"
    )


# Becomes the user nobody, restricts itself and tries.
AS_NOBODY = """
import ctypes, os, socket, sys
from perilune.analysis.runtime.process.restriction import Restriction, restrict
mine, others = sys.argv[1:]
ctypes.CDLL(None), os.setgid(65534), os.setuid(65534)
restrict(Restriction((mine,), network=False))
open(os.path.join(mine, "file"), "w").close()
socket.socketpair()
for attempt in (
    lambda: open(os.path.join(others, "file"), "w"),
    socket.socket,
    lambda: socket.socket(socket.AF_UNIX),
    lambda: os.kill(os.getppid(), 0),
):
    try:
        attempt()
    except PermissionError:
        continue
    sys.exit(1)
"""


@pytest.mark.skipif(os.geteuid() != 0, reason="who is not root cannot become another user")
def test_it_takes_no_rights_of_an_administrator():
    with tempfile.TemporaryDirectory() as mine, tempfile.TemporaryDirectory() as others:
        for folder in (mine, others):
            Path(folder).chmod(0o777)
        subprocess.run([sys.executable, "-c", AS_NOBODY, mine, others], check=True)
        assert not list(Path(others).iterdir())
