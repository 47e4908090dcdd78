"""Built documentation site: without warnings, and complete without network or server.

Truth: the built files, read by lxml; a browser that opens them as files.
"""

from __future__ import annotations

import re
from functools import cache
from itertools import pairwise

import pytest
from lxml import html

from docs.reference.build import SETTINGS, build_site
from docs.reference.links import broken_links
from docs.reference.pages import derived_pages
from perilune.analysis.documents.diagram.elk import MISSING
from perilune.analysis.runtime.ssp.archive import system_names
from perilune.common.paths import ROOT
from perilune.fmus_src.catalogue import catalogue
from tests.support.documented import PAGES
from tests.support.pages.browser import find_browser, start

DERIVED = re.compile(r"docs/(reference/.*\.md)$")
LINK = re.compile(r"\]\((?!https?:)([^)#\s]*)(?:#([\w-]+))?\)")
SEARCH = """<script>
setTimeout(() => document.querySelector(".md-search button").click(), 1500);
setTimeout(() => {
  const box = document.activeElement;
  const input = box.shadowRoot ? box.shadowRoot.activeElement : box;
  input.value = "singularity-robust";
  input.dispatchEvent(new Event("input", { bubbles: true }));
}, 3000);
setTimeout(() => {
  const all = [...document.querySelectorAll("*")].filter((element) => element.shadowRoot);
  document.title = "FOUND " + all.map((element) => element.shadowRoot.textContent).join(" ");
}, 6000);
</script></body>"""


@cache
def site_pages() -> dict[str, str]:
    """Return the derived pages, once."""
    return derived_pages()


def anchors(text: str) -> set[str]:
    """Return the anchors of the headings of a page, as GitHub and the site create them."""
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", heading.lower().strip())) for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_links_between_pages(page):
    """As they stand, for readers of the files themselves; to derived pages, as in the site."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    for target, anchor in LINK.findall(text):
        path = page if not target else (page.parent / target).resolve()
        assert path.is_relative_to(ROOT), target
        derived = DERIVED.match(path.relative_to(ROOT).as_posix())
        if derived:
            assert derived[1] in site_pages(), target
        else:
            assert path.is_file(), target
        if anchor:
            content = site_pages()[derived[1]] if derived else path.read_text(encoding="utf-8")
            assert anchor in anchors(content), f"{target}#{anchor}"


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_links_do_not_leave_the_site(page):
    """It has the folder docs and the pages of the root, and no other file of the repository."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    for target in re.findall(r"\]\((?!\w+:|#)([^)#\s]+)", text):
        path = (page.parent / target).resolve()
        assert path.is_relative_to(ROOT / "docs") or path in PAGES, target


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_lists_are_nested_alike_everywhere(page):
    """The site nests items that are indented by four spaces, GitHub by two or more."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    assert not re.findall(r"^ {1,3}- .*", text, re.MULTILINE)


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_tables_are_read_alike_everywhere(page):
    """The site ends a table at a blank line only, and shows the backslash before a bar in code that GitHub needs."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    lines = text.splitlines()
    for line, following in pairwise(lines):
        if line.lstrip().startswith("| "):
            assert not following.strip() or following.lstrip().startswith("|"), following
            assert not any("|" in code for code in line.split("`")[1::2]), line


def test_pages_that_messages_and_templates_name_are_there():
    titles = set(re.findall(r'"([^"]+)" = "[\w/]+\.md"', SETTINGS.read_text(encoding="utf-8")))
    named: list[str] = []
    files = [
        path
        for room in ("analysis", "common", "fmus_src", "ssp_systems", "laws", "examples")
        for path in rglob_text(room)
    ]
    for path in files:
        text = path.read_text(encoding="utf-8")
        for words in re.findall(r"`perilune docs` (?:describes under|opens the documentation:) ([^\n\"]+)", text):
            named += re.findall(r"\*([^*]+)\*", words) or [words]
        for page in re.findall(r"docs/[\w/]+\.md", text):
            assert (ROOT / page).is_file(), f"{path}: {page}"
    assert len(named) > 3
    assert set(named) <= titles


def rglob_text(room):
    return [
        path for path in (ROOT / room).rglob("*") if path.suffix in (".py", ".jinja", ".md", ".toml", ".ssd", ".json")
    ]


@pytest.fixture(scope="module")
def site(fmus, tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    build_site(folder / "site", folder / "sources")
    return folder / "site"


@pytest.mark.slow
def test_it_is_complete(site):
    assert list(broken_links(site)) == []
    for name in catalogue():
        assert (site / "reference" / "blocks" / f"{name}.html").is_file()
    signature = (site / "reference" / "python" / "flying.html").read_text(encoding="utf-8")
    assert "stop_time" in signature
    assert 'id="perilune.simulate"' in signature
    for name in system_names():
        page = (site / "systems" / f"{name}.html").read_text(encoding="utf-8")
        image = site / "images" / "diagrams" / f"{name}.svg"
        if image.is_file():
            assert f'src="../images/diagrams/{name}.svg"' in page
            assert image.read_text(encoding="utf-8").startswith("<svg ")
        else:
            assert MISSING.replace("`", "") in html.fromstring(page).text_content()


@pytest.mark.slow
def test_search_without_a_server(site, tmp_path):
    browser = find_browser()
    text = (site / "index.html").read_text(encoding="utf-8")
    page = site / "search_probe.html"
    page.write_text(text.replace("</body>", SEARCH), encoding="utf-8")
    dom = start(browser, page, tmp_path, "--virtual-time-budget=15000", "--dump-dom")
    page.unlink()
    actual = re.search(r"<title>FOUND (.*?)</title>", dom, re.DOTALL)
    assert actual, dom[:500]
    assert "gyro_steering_robust" in actual[1]
