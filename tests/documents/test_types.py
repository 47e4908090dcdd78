"""TypeScript types of page documents equal the Python declarations, and every member is used.

Truth: the TypeScript checker, which rejects undeclared names and lists uses of each private member.
"""

import re
from dataclasses import dataclass
from typing import NotRequired, TypedDict

import numpy as np
import pytest

from perilune.analysis import page_types
from perilune.common.paths import ROOT
from tests.support.lengths import either
from tests.support.pages.node import check_types

WRITTEN_BY_SCRIPTS = {"Query", "Range"}  # which Python reads, and refuses unknown members of
USE = re.compile(r"Property '(\w+)' is private and only accessible within class '(\w+)")
INTERFACE = re.compile(r"^export interface (\w+).*?\{\n(.*?)^\}", re.MULTILINE | re.DOTALL)


def read_generated():
    return "".join(path.read_text(encoding="utf-8") for path in sorted(page_types.GENERATED.iterdir()))


def make_private(text):
    """Return the text with classes of private members instead of interfaces."""
    text = re.sub(r"^export interface (\w+(<.*?>)?) \{", r"export declare class \1 {", text, flags=re.MULTILINE)
    return re.sub(r"^  (?=\w+\??: )", "  private ", text, flags=re.MULTILINE)


def declared_members():
    for name, body in INTERFACE.findall(read_generated()):
        yield from ((member, name) for member in re.findall(r"^  (\w+)\??:", body, re.MULTILINE))


def unread_members(folder, change=str):
    members = {each for each in declared_members() if each[1] not in WRITTEN_BY_SCRIPTS}
    complaints = check_types(folder, lambda text: make_private(change(text)))
    return members - set(USE.findall(complaints))


def test_generated_files_are_those_of_the_declarations():
    there = {path.name: path.read_text(encoding="utf-8") for path in page_types.GENERATED.iterdir()}
    assert there == page_types.generate(), "run build_web.py"


def test_scripts_use_declared_members_alone(tmp_path):
    assert check_types(tmp_path) == ""


@pytest.mark.parametrize("member", either(["ticks", "knee", "criterion"], ["knee"]))
def test_a_member_that_python_does_not_write_is_refused(tmp_path, member):
    complaints = check_types(tmp_path, lambda text: re.sub(rf"^  {member}\??:.*\n", "", text, flags=re.MULTILINE))
    assert f"Property '{member}' does not exist" in complaints


def test_each_member_is_read_by_a_script(tmp_path):
    assert unread_members(tmp_path) == set()


def test_interfaces_have_names_of_their_own():
    names = [name for name, _ in INTERFACE.findall(read_generated())]
    assert len(names) == len(set(names)) > 20


def test_documents_of_templates_are_declared():
    sources = [path for kind in ("html", "py") for path in (ROOT / "analysis").rglob(f"*.{kind}")]
    adding = re.compile(r'(?:add_document|ForScript)\("(\w+)"')
    named = {name for path in sources for name in adding.findall(path.read_text("utf-8"))}
    assert named == set(page_types.PageDocument.__annotations__) - {"columns", "packed", "figures"}


@dataclass(frozen=True)
class Inner:
    """A dataclass, of which what is empty is left out.

    Two lines.
    """

    numbers: np.ndarray
    note: str = ""
    centre: tuple[float, float] | None = None


class Outer(TypedDict):
    inner: list[Inner | None]
    by_name: dict[str, int]
    flag: NotRequired[bool]


class Untranslatable(TypedDict):
    names: set[str]


def test_types_in_typescript():
    texts = page_types.translate([Outer])
    assert list(texts) == [f"{__name__.rpartition('.')[2]}.ts"]
    (text,) = texts.values()
    assert text.partition("\n\n")[2] == (
        "// A dataclass, of which what is empty is left out.\n//\n// Two lines.\n"
        "export interface Inner<Column = number> {\n"
        "  numbers: Column;\n  note?: string;\n  centre?: [number, number];\n}\n\n"
        "export interface Outer<Column = number> {\n"
        "  inner: (Inner<Column> | null)[];\n  by_name: Record<string, number>;\n  flag?: boolean;\n}\n"
    )


def test_a_type_without_counterpart_is_refused():
    with pytest.raises(page_types.UntranslatableError, match=r"Untranslatable\.names: set\[str\]"):
        page_types.translate([Untranslatable])
