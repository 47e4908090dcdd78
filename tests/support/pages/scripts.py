"""Bundles of page scripts, which are missing if npm was not available."""

from __future__ import annotations

import os

import pytest

from perilune.analysis.documents.interactive.script_bundles import read_bundle

NO_SCRIPTS = "no bundles of scripts"  # tests/conftest.py tells at the end what was left out for it


def require_scripts() -> None:
    """Leave a test of scripts out without their bundles, which CI does not allow."""
    if read_bundle("curves") is not None:
        return
    if os.environ.get("PERILUNE_REQUIRE_BROWSER") == "1":
        pytest.fail("the scripts of pages are not bundled, and PERILUNE_REQUIRE_BROWSER=1 asks for them: make web")
    pytest.skip(NO_SCRIPTS)
