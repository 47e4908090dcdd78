"""Check of systems whose folder stores computed results."""

from __future__ import annotations

from ....common.errors import InputError
from ....common.paths import IS_CHECKOUT, PACKAGE
from ...runtime.ssp.archive import SystemArchive


def check_stored_system(archive: SystemArchive) -> None:
    """Reject `store` for a system that is not a folder or belongs to the installed package. Raises InputError."""
    if not archive.path.is_dir():
        raise InputError("`store`", str(archive.path), "not a folder", "unpack the .ssp and name its folder")
    if not IS_CHECKOUT and archive.path.is_relative_to(PACKAGE):
        problem = "a system of the installed package, which is read-only"
        raise InputError("`store`", str(archive.path), problem, "copy this folder and name the copy")
