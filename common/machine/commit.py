"""Git commit of this Perilune, if known: of a checkout, or of a repository from which pip installed it."""

from __future__ import annotations

import json
import subprocess
from importlib.metadata import distribution
from pathlib import Path

from ..paths import IS_CHECKOUT, ROOT

DIGITS = 12
ORIGIN = "direct_url.json"  # file with the origin of a package that pip installed (PEP 610)


def known_commit() -> str:
    """Return the commit of this Perilune, with ``, modified`` if the checkout differs from it; "" if it is unknown."""
    return commit_of_checkout(ROOT) if IS_CHECKOUT else commit_of_origin(distribution("perilune").read_text(ORIGIN))


def commit_of_checkout(root: Path) -> str:
    """Return the commit of a folder that is the top of a repository; "" for another folder, or without git."""
    if not (root / ".git").exists():
        return ""
    command = ["git", "--no-optional-locks", "-C", str(root), "describe", "--always", "--exclude=*"]
    try:
        done = subprocess.run(
            [*command, f"--abbrev={DIGITS}", "--dirty=, modified"], capture_output=True, text=True, check=True
        )
    except (OSError, subprocess.CalledProcessError):
        return ""
    return done.stdout.strip()


def commit_of_origin(origin: str | None) -> str:
    """Return the commit in the content of an `ORIGIN` file; "" if the content names no commit."""
    commit = json.loads(origin or "{}").get("vcs_info", {}).get("commit_id", "")
    return str(commit)[:DIGITS]
