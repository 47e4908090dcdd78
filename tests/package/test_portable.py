"""Absence in the product of calls that exist only on Linux or Unix.

Truth: functions marked "Availability: Unix" in Python's library reference.
"""

from __future__ import annotations

import ast
import re

import pytest

from perilune.common.paths import ROOT

MODULES = {"fcntl", "grp", "posix", "pty", "pwd", "resource", "syslog", "termios", "tty"}
NAMES = {
    "os": {"fork", "forkpty", "getpgid", "getuid", "geteuid", "getgid", "killpg", "nice", "sched_getaffinity"}
    | {"sched_setaffinity", "setsid", "sysconf", "uname", "wait", "chown", "mkfifo"},
    "signal": {"SIGALRM", "SIGCHLD", "SIGHUP", "SIGKILL", "SIGQUIT", "SIGSTOP", "SIGUSR1", "SIGUSR2", "alarm"}
    | {"pause", "pthread_kill", "pthread_sigmask", "setitimer", "sigwait"},
    "time": {"clock_gettime", "tzset"},
}
SOURCES = [path for room in ("analysis", "common", "fmus_src") for path in sorted((ROOT / room).rglob("*.py"))]


WORDS = re.compile(rf"\b({'|'.join(sorted(MODULES.union(*NAMES.values())))})\b")


def actual(text):
    """Yield names that exist on Unix only, with their lines; a text without any of the words is not parsed."""
    if not WORDS.search(text):
        return
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from ((alias.name, node.lineno) for alias in node.names if alias.name in MODULES)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            named = {alias.name for alias in node.names} & NAMES.get(str(node.module), set())
            yield from ((name, node.lineno) for name in named | ({node.module} & MODULES))
        elif isinstance(node, ast.Attribute) and node.attr in NAMES.get(getattr(node.value, "id", ""), ()):
            yield ast.unparse(node), node.lineno


FORKS = (  # where only Unix gets to; some ask for the platform, or for a status that a signal alone gives
    "analysis/runtime/process/server.py",
    "analysis/runtime/process/shared_recorder.py",
    "common/family/ending.py",
    "common/family/keeper.py",
)


def test_no_call_that_only_unix_has():
    assert len(SOURCES) > 300
    portable = [path for path in SOURCES if not path.relative_to(ROOT).as_posix().startswith(FORKS)]
    actual_calls = {path: list(actual(path.read_text(encoding="utf-8"))) for path in portable}
    assert actual_calls == {path: [] for path in portable}


@pytest.mark.parametrize(
    "text", ["import os\nos.fork()", "import fcntl", "from resource import *", "from os import getuid"]
)
def test_what_would_be_found(text):
    assert list(actual(text))
