"""Campaigns in folders: the bytes that they write, and their processes, which can be killed."""

import hashlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pyarrow.parquet

from perilune.analysis.campaigns.folder.lock import FILE

SERVER = "process.server import main"  # what the command line of a flight server, and of its children, has


def bytes_of(folder):
    """Return the SHA-256 of every file that a campaign wrote, by name, but for the lock."""
    files = sorted(path for path in Path(folder).rglob("*") if path.is_file() and path.name != FILE)
    return {path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


def started(*words):
    """Start a command of perilune in another process."""
    line = [sys.executable, "-m", "perilune", *map(str, words)]
    return subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def workers_of(process):
    """Return the process ids of a command's worker processes."""
    collected = []
    for child in psutil.Process(process.pid).children(recursive=True):
        try:
            line = " ".join(child.cmdline())
        except psutil.Error:  # it has just ended
            continue
        if SERVER in line and child.ppid() != process.pid:  # forked by the server, which is a child itself
            collected.append(child.pid)
    return collected


def shards_in(folder):
    """Count the shards in a folder."""
    return len(list((Path(folder) / "trials").glob("[0-9]*.parquet")))


def killed_when(process, condition, victim=None):
    """Kill the process, or one of its workers, as soon as the condition holds; return False where it ended before."""
    while process.poll() is None:
        if condition():
            try:
                os.kill(process.pid if victim is None else victim(), signal.SIGKILL)
            except (ProcessLookupError, IndexError):
                continue
            return True
        time.sleep(0.01)
    return False


def flip_bit(path):
    """Change one bit of the data of a Parquet file's last column."""
    data = bytearray(path.read_bytes())
    group = pyarrow.parquet.ParquetFile(path).metadata.row_group(0)
    chunk = group.column(group.num_columns - 1)
    start = chunk.data_page_offset if chunk.dictionary_page_offset is None else chunk.dictionary_page_offset
    data[start + chunk.total_compressed_size - 2] ^= 0x10
    path.write_bytes(data)
