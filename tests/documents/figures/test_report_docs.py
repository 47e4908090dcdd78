"""The reference of figures documents every key of declarations. Truth: the keys accepted by the parser."""

import re
from pathlib import Path

from docs.reference.formats.pages import format_pages
from perilune.analysis.documents.common.colours import HUES
from perilune.analysis.documents.figures.figure_reader import BUDGET, FOLDED, GROUP, READERS
from perilune.analysis.documents.figures.history_readers import BAND, CURVE
from perilune.analysis.documents.figures.scene.arrow_reader import ARROW_OPTIONAL, ARROW_REQUIRED
from perilune.analysis.documents.figures.scene.body_reader import BODY, JETS, NOZZLE, PANEL
from perilune.analysis.documents.figures.scene.reader import KINDS, SCENE, SPHERE
from perilune.analysis.documents.figures.scene.scene_elements import ARROW, GROUND, SHAPES
from perilune.analysis.documents.figures.signal_reader import ROWS
from perilune.common.paths import ROOT, SYSTEMS

PAGE = format_pages()["report.md"]
WORDS = set(re.findall(r"[A-Za-z_]+", " ".join(re.findall(r"`([^`\n]+)`", PAGE))))


def test_every_element_and_attribute_is_documented():
    assert {*READERS, BUDGET, GROUP, FOLDED, *BAND, *CURVE, *ROWS} <= WORDS
    assert {*SCENE, *KINDS, *BODY, *JETS, *NOZZLE, *SHAPES, GROUND} <= WORDS
    assert {*SPHERE, *PANEL, *ARROW_REQUIRED, *ARROW_OPTIONAL, *HUES} <= WORDS
    assert f"{ARROW:g} of the view's height" in PAGE


def test_every_shape_has_a_script():
    """Scripts draw nothing of a shape that they do not know."""
    script = Path(ROOT, "web", "scene", "objects", "shapes.ts").read_text(encoding="utf-8")
    builders = re.search(r"const BUILDERS: [^{]*\{(.*?)\}", script, re.DOTALL)[1]
    assert sorted(re.findall(r"\w+", builders)) == sorted(SHAPES)


def test_what_our_systems_ask_for_is_documented():
    requested = "".join(path.read_text(encoding="utf-8") for path in SYSTEMS.glob("*/annotations.xml"))
    reports = " ".join(re.findall(r"<Report .*?</Report>", requested, re.DOTALL))
    names = {*re.findall(r"<([A-Z]\w+)", reports), *re.findall(r"\s(\w+)=\"", reports)} - {"Report", "xmlns"}
    assert len(names) > 20
    assert names <= WORDS
