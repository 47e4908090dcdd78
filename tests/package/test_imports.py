"""Each verb imports only the libraries that it needs, since importing one can take as long as the rest of the command.

Truth: the modules loaded in a new interpreter after the command.
"""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.support.lengths import either

HEAVY = {
    "IPython", "asyncio", "casadi", "control", "elftools", "fmpy", "jinja2", "loky", "matplotlib", "mpmath",
    "numpy", "pandas", "py_mini_racer", "pyarrow", "scipy.linalg", "scipy.optimize", "scipy.stats", "starlette", "tqdm",
}  # fmt: skip
READING = {"numpy", "fmpy"}
FLYING = READING
CAMPAIGN = FLYING | {"asyncio", "loky", "pyarrow", "tqdm"}  # asyncio by tqdm
SYSTEM = "lunar_terminal_guidance"
CODE = "import sys; from perilune.analysis.cli import main; main(sys.argv[1:]); print(*sys.modules, file=sys.stderr)"
ALLOWED = {
    "list": READING,
    f"describe {SYSTEM}": READING,
    f"validate {SYSTEM}": READING,
    f"run {SYSTEM} --stop-time 2": FLYING,
    f"run {SYSTEM} --stop-time 2 --output F.csv": FLYING | {"pyarrow"},
    f"batch {SYSTEM} --campaign paper --trials 2 --workers 1 --output results": CAMPAIGN,
}


def heavy_modules(command: str, folder) -> set[str]:
    """Return those of `HEAVY` that a command imports."""
    done = subprocess.run(
        [sys.executable, "-c", CODE, *command.split()], cwd=folder, capture_output=True, text=True, check=True
    )
    return HEAVY & set(done.stderr.splitlines()[-1].split())


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("command", either([*ALLOWED], [f"describe {SYSTEM}", *list(ALLOWED)[-2:]]))
def test_a_verb_imports_what_it_needs(command, tmp_path):
    assert heavy_modules(command, tmp_path) == ALLOWED[command]


@pytest.mark.usefixtures("fmus")
def test_a_page_brings_templates_and_no_matplotlib(tmp_path):
    imported = heavy_modules(f"run {SYSTEM} --stop-time 2 --report flight.html", tmp_path)
    assert imported >= FLYING | {"jinja2"}
    assert "matplotlib" not in imported
