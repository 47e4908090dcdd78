"""Foreign names inside a page are always pure data of its document.

Truth: the original name; HTML ends the text of a script only at "</script", and the embedded data contains no "<".
"""

import json
import re

from hypothesis import example, given
from hypothesis import strategies as st

from perilune.analysis.documents.interactive.embedded import Embedded
from perilune.analysis.documents.interactive.script_bundles import read_bundle
from tests.support.pages.scripts import require_scripts

NAMES = st.text(st.characters(exclude_categories=("Cs",)))


@given(name=NAMES, entry=NAMES)
@example(name="</script><script>alert(1)</script>", entry="<!--<script>")
@example(name="__proto__", entry="constructor")
@example(name="\u2028\u2029\u202e\x00", entry="]]>&lt;\\u003c")
def test_any_name_is_data(name, entry):
    require_scripts()
    embedded = Embedded()
    assert embedded.add_document("document", "curves", {name: [entry], "number": 1.0})
    text = str(embedded.elements())
    (content,) = re.findall(r'<script type="application/json" id="page-data">(.*?)</script>', text, re.DOTALL)
    assert content.isascii()
    assert "<" not in content
    assert json.loads(content)["document"] == {name: [entry], "number": 1.0}
    scripts = text.partition("</script>\n")[2]
    assert scripts == f"<script>{read_bundle('curves')}</script>\n"
