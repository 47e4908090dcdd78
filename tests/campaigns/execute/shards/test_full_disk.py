"""Full disk during a campaign: an error of one line, no partial files, and continuation once there is space.

Truth: the files of the same campaign on a disk with space.
"""

import shlex
import subprocess
import sys
from math import ceil

import pytest

from perilune.analysis.cli import main
from tests.support.campaigns.folders import bytes_of

pytestmark = pytest.mark.usefixtures("fmus")
CAMPAIGN = ["batch", "lunar_terminal_guidance", "--campaign", "paper", "--trials", "200", "--stop-time", "20"]


def can_mount():
    return subprocess.run(["unshare", "-rm", "true"], capture_output=True, check=False).returncode == 0


def size_of(folder):
    """Return the size of a folder's files in a file system with blocks of 4 kB, in kB."""
    return sum(4 * ceil(path.stat().st_size / 4096) for path in folder.rglob("*") if path.is_file())


@pytest.mark.skipif(sys.platform != "linux" or not can_mount(), reason="this machine lets nobody mount a tmpfs")
def test_a_full_disk_ends_it_and_room_goes_on_with_it(tmp_path):
    disk, retained, whole = tmp_path / "disk", tmp_path / "kept", tmp_path / "whole"
    disk.mkdir()
    assert main([*CAMPAIGN, "--output", str(whole)]) == 0
    free = size_of(whole) - size_of(whole / "trials") // 2  # room for the campaign's files and some shards
    command = shlex.join([sys.executable, "-m", "perilune", *CAMPAIGN, "--output", str(disk / "out")])
    script = f"""
        mount -t tmpfs -o size=20m tmpfs {disk}
        head -c {20 * 1024 - free}k /dev/zero > {disk}/filler
        {command}; echo "status $?"
        find {disk}/out -name '.*.partial' -type f
        rm {disk}/filler
        {command} --resume || exit 1
        cp -r {disk}/out {retained}
    """
    done = subprocess.run(["unshare", "-rm", "sh", "-c", script], capture_output=True, text=True, check=True)
    assert "status 2" in done.stdout.splitlines()
    said = [line for line in done.stderr.splitlines() if line.startswith("perilune: ")]
    assert len(said) == 1
    assert "No space left on device; free some space; completed trials are stored in" in said[0]
    assert "resume with the same command and --resume, or with shard" in said[0]
    assert not [line for line in done.stdout.splitlines() if line.startswith(f"{disk}/out/")]
    assert bytes_of(retained) == bytes_of(whole)
