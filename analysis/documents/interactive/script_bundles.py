"""Scripts of pages, bundled by `build_web.py`, and the policy under which a browser runs them."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Iterable

from ....common.paths import BUILD

BUNDLES = BUILD / "web" / "bundles"
MISSING = "The scripts of pages are not built (npm was not available): run `make web`, then the command again."


def read_bundle(name: str) -> str | None:
    """Return the text of the script ``name``, or None if it was not built."""
    path = BUNDLES / f"{name}.js"
    return path.read_text(encoding="utf-8").strip() if path.is_file() else None


def policy(scripts: Iterable[str], *, requests: bool = False) -> str:
    """Return a Content-Security-Policy: only these scripts, and no network but the page's server if ``requests``."""
    hashes = [base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() for script in scripts]
    sources = " ".join(["'wasm-unsafe-eval'", *(f"'sha256-{each}'" for each in hashes)]) if hashes else "'none'"
    connect = "; connect-src 'self'" if requests else ""
    return (
        f"default-src 'none'; script-src {sources}; worker-src blob:; style-src 'unsafe-inline'; img-src data:; "
        f"base-uri 'none'; form-action 'none'{connect}"
    )
