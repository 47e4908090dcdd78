"""Derived pages of the site: verbs, slots, the Python interface, the front pages; and files as text.

Truth: argparse's help, the public names, the sources of the pages; a site with known errors.
"""

from __future__ import annotations

import inspect
import re
import subprocess

import pytest

import perilune
from docs.reference.build import pages_of, site_settings
from docs.reference.links import broken_links
from docs.reference.markdown import escaped, prose
from docs.reference.markup.block_links import link_blocks
from docs.reference.markup.docstrings import ASSUMPTIONS, FRAMES, SOURCES, describe_class
from docs.reference.markup.equations import to_latex
from docs.reference.markup.formulas import typeset
from docs.reference.pages import derived_pages, reference_navigation
from docs.reference.verbs import verb_parser
from perilune.analysis.authoring.fits import slots
from perilune.analysis.verbs.options.verbs import VERBS
from perilune.common.paths import ROOT
from perilune.fmus_src.export.judge.subset_table import (
    ELEMENTARY_FUNCTIONS,
    LANGUAGE_PAGE,
    MATH_FUNCTIONS,
    OTHER_FUNCTION,
    REFUSED_FUNCTIONS,
)


@pytest.fixture(scope="module")
def pages():
    return derived_pages()


def sections(page):
    """Return text by heading of the second level."""
    return dict(part.split("\n", 1) for part in re.split(r"^## ", page, flags=re.MULTILINE)[1:])


def test_every_option_of_every_verb_is_there(pages):
    """Options that `perilune VERB --help` prints, and no others."""
    actual = sections(pages["reference/verbs.md"])
    assert list(actual) == list(VERBS)
    for verb, text in actual.items():
        printed = set(re.findall(r"^  (--[a-z][\w-]*)", verb_parser(verb).format_help(), re.MULTILINE))
        assert set(re.findall(r"^\| `(--[a-z][\w-]*)", text, re.MULTILINE)) == printed - {"--help", "--help-all"}


def test_what_a_kernel_may_use(pages):
    """Every function that the judge takes, every rule's words, and the helpers that the templates take."""
    page = pages["reference/kernel.md"]
    assert page.startswith(f"# {LANGUAGE_PAGE}\n")
    assert set(re.findall(r"^\| `math\.(\w+)` \|", page, re.MULTILINE)) == set(MATH_FUNCTIONS)
    assert set(re.findall(r"^\| `(\w+)` \| \d \|", page, re.MULTILINE)) == set(ELEMENTARY_FUNCTIONS)
    for name in ("quadratic_time", "impulse_and_miss", "clip", "norm"):
        (row,) = re.findall(rf"^\| `{name}\(.*$", page, re.MULTILINE)
        cells = re.split(r"(?<!\\)\|", row)
        assert len(cells) == 4
        assert len(cells[2]) > 10
    for name in REFUSED_FUNCTIONS:
        assert f"| `{name}` |" in page
    assert LANGUAGE_PAGE in OTHER_FUNCTION
    assert {LANGUAGE_PAGE: "reference/kernel.md"} in reference_navigation()


def test_every_public_name_is_there(pages):
    text = "".join(page for path, page in pages.items() if path.startswith("reference/python/"))
    named = set(re.findall(r"^::: (\S+)$", text, re.MULTILINE))
    public = {f"perilune.{name}" for name in perilune.__all__ if name != "modal"}
    assert named == public | {f"perilune.modal.{name}" for name in perilune.modal.__all__}


def test_every_slot_is_there(pages):
    assert list(sections(pages["reference/slots.md"])) == list(slots())


def test_every_page_is_in_the_navigation(pages):
    written = {path.relative_to(ROOT / "docs").as_posix() for path in (ROOT / "docs").rglob("*.md")}
    listed = pages_of(site_settings()["nav"])
    assert sorted(listed) == sorted(written | set(pages))


def test_the_site_has_four_doors():
    """Doors that README names; the derived reference is in one of them, and README fits two screens."""
    doors = [name for door in site_settings()["nav"] for name in door]
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert doors == re.findall(r"^- \*\*(.+?)\*\*: ", readme, re.MULTILINE) == ["Learn", "Do", "Look up", "Understand"]
    (behind,) = [door["Look up"] for door in site_settings()["nav"] if "Look up" in door]
    assert {"Reference": reference_navigation()} in behind
    assert readme.count("\n") < 120


def test_links_of_the_front_pages_lead_to_the_same_places(pages):
    """A link of README to docs/x.md is one to x.md from the site's top."""
    linked = set(re.findall(r"\]\(docs/([\w./-]+)", (ROOT / "README.md").read_text(encoding="utf-8")))
    assert len(linked) > 10
    assert linked <= set(re.findall(r"\]\(([\w./-]+)", pages["index.md"]))
    assert "](docs/" not in pages["index.md"]


def test_words_stay_as_they_are():
    assert escaped("a*b*c |x| y[1](z) <d> `k*k` e_f_g") == r"a\*b\*c \|x\| y\[1\](z) &lt;d> `k*k` e\_f\_g"
    text = prose("Purpose.\n\nBody:\n\n    a * b\n\nMore, see docs/systems/lunar_landing.md.\nSource: A 2001.", "../")
    assert "\n\n    a * b\n\n" in text
    assert "[lunar\\_landing](../systems/lunar_landing.md)" in text
    assert "\n\nSource: A 2001." in text


def test_a_line_that_begins_with_a_formula_stays_in_its_paragraph():
    """Markdown takes a line that begins with ``<math`` for the start of a block."""
    assert typeset("With\n$a$ and `$b$`.").startswith("With\n<span><math ")
    assert typeset("With\n$a$ and `$b$`.").endswith("</math></span> and `$b$`.")


def test_broken_links_are_found(tmp_path):
    (tmp_path / "good.html").write_text('<p id="here">x</p><a href="bad.html#there">y</a><a href="#here">z</a>')
    (tmp_path / "bad.html").write_text(
        '<a href="gone.html">1</a><a href="good.html#gone">2</a><img src="gone.svg">'
        '<script src="https://elsewhere.org/x.js"></script><a href="https://elsewhere.org">fine</a>'
    )
    assert list(broken_links(tmp_path)) == [
        ("bad.html", "gone.html"),
        ("bad.html", "good.html#gone"),
        ("bad.html", "gone.svg"),
        ("bad.html", "https://elsewhere.org/x.js"),
        ("good.html", "bad.html#there"),
    ]


def test_no_file_holds_marks_of_a_merge():
    """Nor does `git diff --check`'s own pattern match anywhere in what is committed."""
    names = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n")
    for name in filter(None, names):
        path = ROOT / name
        if path.is_file() and not path.is_symlink():
            text = path.read_bytes()
            assert not re.search(rb"^(<{7} |>{7} |\|{7} |={7}$)", text, re.MULTILINE), name


@pytest.mark.parametrize("name", ["simulate", "batch", "stability", "compare"])
def test_the_page_of_a_function_has_its_keywords(pages, name):
    """Truth: the signature."""
    page = pages["reference/python/flying.md"].split(f"::: perilune.{name}\n", 1)[1].split(":::")[0]
    parameters = inspect.signature(getattr(perilune, name)).parameters.values()
    keywords = {each.name: repr(each.default) for each in parameters if each.kind is each.KEYWORD_ONLY}
    rows = {row[0]: row[1] for row in re.findall(r"^\| `(\w+)` \| (.*?) (?<!\\)\| ", page, re.MULTILINE)}
    assert list(rows) == list(keywords)
    settings = {name: text for name, text in keywords.items() if text not in ("()", "{}", "mappingproxy({})")}
    assert all(rows[name].endswith(f"default {escaped(text)}") for name, text in settings.items())
    assert f"perilune.{name}(" in page


def test_the_first_mention_of_a_block_is_a_link():
    page = "# `spacecraft`\n`spacecraft`, `spacecraft`, [`wheel`](w.md), `orbit`\n\n```sh\n`wheel`\n```\n`wheel`"
    linked = link_blocks(page, "systems/earth_pointing.md", {"spacecraft", "wheel"})
    assert linked == (
        "# `spacecraft`\n[`spacecraft`](../reference/blocks/spacecraft.md), `spacecraft`, [`wheel`](w.md), `orbit`\n\n"
        "```sh\n`wheel`\n```\n[`wheel`](../reference/blocks/wheel.md)"
    )
    assert link_blocks("`wheel`", "choosing.md", {"wheel"}) == "[`wheel`](reference/blocks/wheel.md)"


@pytest.mark.parametrize(
    ("plain", "latex"),
    [
        ("I ω' = -ω \N{MULTIPLICATION SIGN} (I ω) + u", r"I \, \dot{ω} = - ω \times \left(I \, ω\right) + u"),
        ("θ_r'' = a/(2 b) c^T", r"\ddot{θ}_{r} = \frac{a}{2 \, b} \, {c}^{\top}"),
        (
            "V sin χ cos θ/(r cos φ)",
            r"\frac{V \, \operatorname{sin}\,χ \, \operatorname{cos}\,θ}{r \, \operatorname{cos}\,φ}",
        ),
        ("|q|^-1    sqrt(1 - f^2)", r"{\left|q\right|}^{-1}\qquad \sqrt{1 - {f}^{2}}"),
        ("R(q)^T G", r"{R\left(q\right)}^{\top} \, G"),
        ("x = max_rate y    if y >= 0", r"x = \mathrm{max\_rate} \, y\qquad \text{if }y \ge 0"),
    ],
)
def test_equations_of_docstrings(plain, latex):
    assert to_latex(plain) == latex


class Described:
    """A mass on a spring.

    With the mass m:

        m x'' = -k x

    Frame: inertial.

    Assumes no damping.

    Source: Hooke 1678. See docs/choosing.md.
    """


def test_parts_of_a_docstring():
    described = describe_class(Described, "../")
    assert described.summary == "A mass on a spring."
    assert described.model == ["With the mass $m$:", r"$$m \, \ddot{x} = - k \, x$$"]
    assert described.labelled == {
        ASSUMPTIONS: ["No damping."],
        FRAMES: ["Inertial."],
        SOURCES: ["Hooke 1678. See [choosing](../choosing.md)."],
    }
