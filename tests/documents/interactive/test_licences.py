"""Pages contain the full licences of embedded software.

Truth: the licence files of the packages, and names that remain in their minified code.
"""

import pytest

from perilune.analysis.documents.interactive.script_bundles import BUNDLES, read_bundle
from tests.support.pages.scripts import require_scripts

PACKAGES = BUNDLES.parent / "node_modules"
TRACES = {"three": "WebGLRenderer"}


@pytest.mark.parametrize("script", ["curves", "scene", "show"])
def test_licences_of_the_packages_in_a_script(script):
    require_scripts()
    text = read_bundle(script)
    inside = [name for name, trace in TRACES.items() if trace in text]
    assert inside == (["three"] if script == "scene" else [])
    for name in inside:
        assert (PACKAGES / name / "LICENSE").read_text(encoding="utf-8").strip() in text
