"""Errors of the operating system: each is named, with a suitable remedy."""

import errno
import os

import pytest

from perilune.analysis.verbs.common.campaign_options import resume_hint
from perilune.common.errors import EndedError
from perilune.common.machine.os_errors import REMEDIES, line_of

FULL = (errno.ENOSPC, errno.EDQUOT)


def test_space_is_the_remedy_of_full_disks_alone():
    assert {number for number, remedy in REMEDIES.items() if "free some space" in remedy} == set(FULL)


@pytest.mark.parametrize(
    ("number", "remedy"),
    [
        (errno.ENOSPC, "free some space"),
        (errno.EDQUOT, "quota"),
        (errno.EFBIG, "ulimit -f"),
        (errno.ENOENT, "restore the folder, which was removed"),
        (errno.EXDEV, "single file system"),
        (errno.ESTALE, "remount its file system"),
    ],
)
def test_what_ends_a_campaign_has_its_remedy(tmp_path, number, remedy):
    with pytest.raises(EndedError, match=remedy) as ended, resume_hint(tmp_path):
        raise OSError(number, os.strerror(number), "trials/0.parquet")
    assert str(ended.value).startswith(f"trials/0.parquet: {os.strerror(number)}; ")
    assert ("free some space" in str(ended.value)) == (number in FULL)


def test_an_error_without_number_or_file():
    assert line_of(OSError("odd"), "here") == "here: odd; give another path or fix this one"
