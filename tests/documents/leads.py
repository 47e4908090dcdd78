"""The answer of a document in every medium."""

from pathlib import Path

from markupsafe import Markup

from perilune.analysis.documents.cell import Rich
from perilune.analysis.documents.model import Verdict
from perilune.analysis.documents.render.words import rich_text
from perilune.analysis.verbs.common.documented import Documented
from tests.support.pages.checks import text_of


def assert_lead_everywhere(result: Documented, folder: Path) -> Rich:
    """Return the lead of a result's verdict; fail where terminal, notebook, page or repr lack it."""
    (lead,) = (node.lead for node in result.document().summary if isinstance(node, Verdict))
    words = rich_text(lead)
    assert result.lines()[0] == words
    result.report(folder / "lead.html")
    page = (folder / "lead.html").read_text(encoding="utf-8")
    for text in (text_of(page), Markup(result._repr_html_()).striptags(), repr(result)):
        assert words[1:] in " ".join(text.split())
    return lead
