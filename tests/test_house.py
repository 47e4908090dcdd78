"""tests/house: words to give up become fewer, and are counted correctly.

Truth: the numbers of `tests/house/limits.toml`, and texts with obvious counts.
"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import PurePosixPath

import pytest

from tests.house import likeness, names, prose, repeated, structure
from tests.house.sources import Checkout, Source

LIMITS = {"words": {"told": 2}, "names": {"place": 3}, "plain": {"data": 10}}


@dataclass(frozen=True)
class Files(Checkout):
    """A checkout of texts by path."""

    texts: Mapping[str, str] = field(default_factory=dict)

    def read(self) -> list[Source]:
        return [Source(PurePosixPath(path), text) for path, text in self.texts.items()]


@dataclass(frozen=True)
class Counted:
    """Words of a checkout, whose files keep their imports alone."""

    checkout: Checkout
    in_names: Counter[str]
    in_prose: Counter[tuple[str, str]]


@pytest.fixture(scope="module")
def counted() -> Counted:
    """Parse each file once, with one syntax tree in memory at a time."""
    counted = Counted(Checkout(), Counter(), Counter())
    limits, limits_of_prose = names.read_limits(), prose.read_limits()
    for source in counted.checkout.sources:
        counted.in_names.update(names.count_words([source], limits))
        counted.in_prose.update(prose.count([source], limits_of_prose))
        assert isinstance(source.imports, list)
        source.drop_nodes()
    return counted


def test_words_to_be_given_up_become_fewer(counted):
    problems = names.check_limits(counted.in_names, names.read_limits())
    problems += prose.check_limits(counted.in_prose, prose.read_limits())
    assert not problems, "\n".join(problems)


def test_names_are_counted_where_they_are_given():
    text = (
        "def told(place, x):\n    x.place = place.data\n    told_rows = f(place=1)\n    return toldest, 'place', placed"
    )
    counts = names.count_words(Files(texts={"analysis/place.py": text}).sources, LIMITS)
    assert (counts["told"], counts["place"], counts["data"]) == (2, 4, 0)


@pytest.mark.parametrize(
    ("words", "data", "message"),
    [
        (2, 11, ""),
        (3, 10, "told: 3 names, 2 allowed"),
        (1, 10, "told: 1 names, 2 stored: lower it"),
        (2, 12, "data: 12"),
    ],
)
def test_numbers_may_only_fall_and_plain_names_grow_by_a_tenth(words, data, message):
    problems = names.check_limits(Counter(told=words, place=3, data=data), LIMITS)
    assert len(problems) == bool(message)
    assert all(message in problem for problem in problems)


def test_the_ratchet_lowers_and_never_raises():
    text = "# x = 1\n[words]\ntold = 2\n[names]\nplace = 3\n[plain]\ndata = 10\n"
    assert names.lower_limits(text, Counter(told=1, place=5, data=7)) == text.replace("told = 2", "told = 1")


def test_docstrings_and_comments_are_counted_and_strings_are_not():
    text = (
        '"""What is made."""\nclass A:\n    """Result."""\n\n    def f(self):  # so many\n'
        '        """what a part comes\n        to: parts."""\n        return "part  made"\n'
    )
    source = Source(PurePosixPath("analysis/a.py"), text)
    limits = {
        "openings": {"what": 1},
        "phrases": {"made": 1, "part": 1, "so many": 1, "comes to": 1},
        "names": {"f": 1},
    }
    counts = prose.count([source], limits)
    assert {k: n for k, n in counts.items() if k[1] in limits[k[0]]} == {
        ("names", "f"): 1,
        ("openings", "what"): 2,
        ("phrases", "made"): 1,
        ("phrases", "so many"): 1,
        ("phrases", "part"): 1,
        ("phrases", "comes to"): 1,
    }
    assert prose.lower_limits(counts, '[openings]\n"what" = 3\n') == '[openings]\n"what" = 2\n'
    assert [problem.split(":")[0] for problem in prose.check_limits(counts, limits)] == ["what"]


def test_circles_hide_neither_below_type_checking_nor_in_functions():
    files = Files(
        texts={
            "analysis/a.py": "from .b import x",
            "analysis/b.py": "if TYPE_CHECKING:\n    from . import c",
            "analysis/c.py": "def f():\n    from .a import y",
            "analysis/d.py": "from . import a",
        }
    )
    assert structure.circles(files) == ("1", ["analysis/a.py <-> analysis/b.py <-> analysis/c.py"])


def test_no_files_import_each_other_in_a_circle(counted):
    assert len(counted.checkout.sources) > 1000
    assert structure.circles(counted.checkout) == ("0", [])


def test_names_that_occur_again_and_long_functions():
    long = 'def f():\n    """A docstring does not count."""\n' + "    x = 1\n" * 51
    files = Files(
        texts={
            "analysis/one/page.py": "class A: pass\nclass B: pass",
            "analysis/two/page.py": "class A: pass",
            "common/page.py": long,
            "common/short.py": long.replace("    x = 1\n", "", 1),
        }
    )
    assert repeated.classes(files) == ("1 of 2", ["A: analysis/one/page.py:1, analysis/two/page.py:1"])
    assert repeated.files(files) == ("1", ["page.py: analysis/one, analysis/two, common"])
    assert repeated.long_functions(files) == ("1", ["common/page.py:1 f"])


def test_a_run_of_like_lines_is_one_pair():
    lines = "\n\n".join(f"v{k} = w{k} + {{}}  # {{}}" for k in range(8))
    like = Files(
        texts={"analysis/a.py": lines.format(*range(16)), "fmus_src/b.py": "import os\n" + lines.format(*range(1, 17))}
    )
    assert likeness.like_lines(like)[1] == ["8 lines: analysis/a.py:1 = fmus_src/b.py:2"]
    assert (
        likeness.like_lines(Files(texts={"analysis/a.py": lines, "analysis/b.py": lines.replace("v4", "x4")}))[1] == []
    )
