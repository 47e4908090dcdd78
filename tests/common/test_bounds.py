"""Bounds of files: messages name the variable that changes the bound, and files are refused before memory is allocated.

Truth: archives that declare more than they contain; the table in the docs.
"""

from __future__ import annotations

import re
import subprocess
import sys
import zipfile

import pytest

from docs.reference.formats.pages import bounds_page
from perilune.analysis.runtime.ssp.archive import open_system
from perilune.common.bounds import ARCHIVE_ENTRIES, BOUNDS
from perilune.common.errors import InputError


def test_the_table_of_the_docs():
    rows = [f"| `{each.variable}` | {each.default:g} {each.unit} | {each.subject} |" for each in BOUNDS]
    assert "\n".join(rows) in bounds_page()


# In another process: other threads' memory is counted, too.
OPENED = """
import sys, tracemalloc
from perilune.common.errors import InputError
from perilune.analysis.runtime.ssp.archive import open_system
tracemalloc.start()
try:
    open_system(sys.argv[1])
except InputError as error:
    print(error, file=sys.stderr)
print(tracemalloc.get_traced_memory()[1])
"""


def test_an_archive_that_unpacks_to_gigabytes(tmp_path):
    """By its directory: nothing is unpacked."""
    path = tmp_path / "bomb.ssp"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("zeros", bytes(1_000_000))
        archive.getinfo("zeros").file_size = 3_000_000_000
    done = subprocess.run([sys.executable, "-c", OPENED, path], capture_output=True, text=True, check=True)
    assert re.search(r"3e\+09 bytes, at most 2e\+09 are accepted; .* set PERILUNE_ARCHIVE_BYTES", done.stderr)
    assert int(done.stdout) < 50_000_000


def test_an_archive_of_too_many_files(tmp_path, monkeypatch):
    path = tmp_path / "many.ssp"
    with zipfile.ZipFile(path, "w") as archive:
        for number in range(11):
            archive.writestr(f"{number}", "")
    monkeypatch.setenv(ARCHIVE_ENTRIES.variable, "10")
    with pytest.raises(InputError, match="11 files, at most 10 are accepted"):
        open_system(path)
    monkeypatch.setenv(ARCHIVE_ENTRIES.variable, "none")
    with pytest.raises(InputError, match="PERILUNE_ARCHIVE_ENTRIES: none: not a positive number"):
        open_system(path)
