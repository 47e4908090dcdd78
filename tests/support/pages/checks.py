"""Properties of every page."""

import base64
import hashlib
import json
import re
from decimal import Decimal

from lxml import html

PATH_SIZES = {"M": 2, "L": 2, "Q": 4, "C": 6}
FETCHING = ("src", "srcset", "href", "{http://www.w3.org/1999/xlink}href", "xlink:href", "poster", "action")


def parse(text):
    """Parse the page as a tree; no id is used twice."""
    assert text.startswith("<!DOCTYPE html>")
    root = html.document_fromstring(text)
    ids = root.xpath("//@id")
    assert len(ids) == len(set(ids))
    return root


def assert_self_contained(text):
    """Assert that a page fetches nothing: references stay in the page, links are to neighbouring files."""
    root = parse(text)
    for element in root.iter():
        if not isinstance(element.tag, str):
            continue
        assert element.tag not in ("iframe", "object", "embed")
        if element.tag == "script":
            assert_permitted(element, root)
        for key in FETCHING:
            value = element.get(key)
            if value is not None:
                local_link = element.tag == "a" and re.fullmatch(r"[\w.]+", value)
                assert value.startswith(("#", "data:")) or local_link, f"{element.tag} {key}={value}"
    assert "@import" not in text
    ids = set(root.xpath("//@id"))
    for reference in re.findall(r"url\(([^)]*)\)", text):
        assert reference.startswith("#"), reference
        assert reference[1:] in ids, reference
    for reference in root.xpath("//*[local-name()='use']/@*[contains(name(), 'href')]"):
        assert reference[1:] in ids, reference


def assert_permitted(script, root):
    """Assert that a script is JSON, or in the page and permitted by its hash."""
    if script.get("type") == "application/json":
        assert json.loads(script.text)
        return
    (policy,) = root.xpath("//meta[@http-equiv='Content-Security-Policy']/@content")
    digest = base64.b64encode(hashlib.sha256(script.text.encode()).digest()).decode()
    assert f"'sha256-{digest}'" in policy


def without_policy(text):
    """Return a page in which a test's script may run, too."""
    return re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", text)


def section_of(text, heading):
    """Return the section of a page below a heading of the second level, which may be folded, as a tree."""
    (section,) = parse(text).xpath("//section[.//h2[. = $heading]]", heading=heading)
    return section


def data_values(text):
    """Return the exact numbers of a page: value attributes of its data elements."""
    return parse(text).xpath("//data/@value")


def text_of(text):
    """Return the words of a page, runs of spaces as one."""
    root = parse(text)
    for script in root.xpath("//script"):
        script.drop_tree()
    return " ".join(root.text_content().split())


def read_path(path):
    """Read a relative path's commands with their points (hundredths), as the grammar of SVG does."""
    commands, letter, numbers, at, start = [], "", [], [0, 0], [0, 0]
    for token in re.findall(r"[a-z]|-?(?:\d+(?:\.\d+)?|\.\d+)", path):
        if token.isalpha():
            letter = token
            if letter == "z":
                commands.append(("Z", ()))
                at = list(start)
            continue
        numbers.append(int(Decimal(token) * 100))
        if len(numbers) == PATH_SIZES[letter.upper()]:
            points = [number + at[axis % 2] for axis, number in enumerate(numbers)]
            commands.append((letter.upper(), tuple(points)))
            at = points[-2:]
            if letter == "m":
                start, letter = list(at), "l"
            numbers = []
    return commands
