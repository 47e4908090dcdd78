"""XML that is to use up memory, reach for other files or hide what it says: as description, parameter set, FMU's."""

from __future__ import annotations

from tests.support.builders import document, parameter_set, system
from tests.support.refused import RAMP

from .case import Case, Content, Write, put

SSD = document(system(RAMP))
SSV = parameter_set("ramp.start=Real:2")
ENTITIES = "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 30))
TREE = "<a>" * 100_000
HEADER = '<?xml version="1.0" encoding="{}"?>'


def with_doctype(text: str, content: str) -> str:
    return f"<!DOCTYPE x [{content}]>\n{text}"


def into(text: str, more: str) -> str:
    """Insert more text before the end of a document."""
    start, end = text.rstrip().rsplit("</", 1)
    return f"{start}{more}</{end}"


def numbered(name: str) -> str:
    """Return 10^5 attributes."""
    return " ".join(f'{name.format(n=number)}="a{number}"' for number in range(100_000))


INVALID = ("line", "not valid SSP")


def texts(text: str, reference: str, invalid: tuple[str, ...] = INVALID) -> dict[str, tuple[Content, tuple[str, ...]]]:
    """Return hostile forms of a good document; ``reference`` is an attribute's text in it that they replace.

    ``invalid`` is said of elements that it should not have.
    """
    doctype, malformed = ("DOCTYPE", "remove"), ("line", "not well-formed XML")
    return {
        "a billion laughs": (with_doctype(text, f'<!ENTITY a0 "ha">{ENTITIES}'), doctype),
        "quadratic entities": (lambda: with_doctype(text, f'<!ENTITY a "{"a" * 100_000}">'), doctype),
        "an entity of a file": (with_doctype(text, '<!ENTITY a SYSTEM "file:///etc/passwd">'), doctype),
        "an entity of the network": (with_doctype(text, '<!ENTITY % a SYSTEM "http://127.0.0.1:9/x"> %a;'), doctype),
        "a DTD elsewhere": (f'<!DOCTYPE x SYSTEM "http://127.0.0.1:9/x.dtd">\n{text}', doctype),
        "a DTD in UTF-16": (
            HEADER.format("utf-16").encode("utf-16") + with_doctype(text, "").encode("utf-16-le"),
            doctype,
        ),
        "an undeclared entity": (text.replace(reference, "&a;", 1), malformed),
        "depth 10^5": (lambda: into(text, TREE), malformed),
        "depth 10^5, closed": (lambda: into(text, TREE + "</a>" * 100_000), malformed),
        "invalid UTF-8": (text.replace(reference, "\x00x", 1).encode().replace(b"\x00", b"\xff\xfe"), malformed),
        "overlong UTF-8": (text.replace(reference, "\x00x", 1).encode().replace(b"\x00", b"\xc0\xaf"), malformed),
        "a NUL": (text.replace(reference, "\x00", 1), malformed),
        "an unknown encoding": (HEADER.format("ebcdic-666") + text, malformed),
        "another encoding than it says": (HEADER.format("utf-16") + text, ("line",)),
        "an escape": (text.replace(reference, "\x1b[2J", 1), malformed),
        "an escape as a reference": (text.replace(reference, "&#27;[2J", 1), malformed),
        "an attribute of 20 MB": (lambda: text.replace(reference, "a" * 20_000_000, 1), malformed),
        "2 x 10^6 elements": (lambda: into(text, "<a/>" * 2_000_000), ("at most 1.5e+06",)),
        "10^5 attributes": (lambda: into(text, f"<a {numbered('a{n}')}/>"), invalid),
        "10^5 namespaces": (lambda: into(text, f"<a {numbered('xmlns:a{n}')}/>"), ("line",)),
        "XInclude": (
            into(text, '<x:include xmlns:x="http://www.w3.org/2001/XInclude" href="/etc/passwd" parse="text"/>'),
            invalid,
        ),
        "a style sheet": (f'<?xml-stylesheet href="file:///etc/passwd"?>\n{text}x', malformed),
        "only spaces": (lambda: " " * 1_000_000, malformed),
        "nothing": ("", malformed),
        "an element of a name of 10^6": (f"<{'a' * 1_000_000}/>", ("line",)),
        "a comment of 20 MB": (lambda: f"<!--{'a' * 20_000_000}-->{text}x", malformed),
    }


def of_description(content: Content) -> Write:
    return put("hostile/SystemStructure.ssd", content)


CASES = {
    f"description: {name}": Case(of_description(content), ("describe hostile",), ("SystemStructure.ssd", *words))
    for name, (content, words) in texts(SSD, "resources/ramp.fmu").items()
}
CASES |= {
    f"parameter set: {name}": Case(put("hostile.ssv", content), ("validate hostile.ssv",), ("hostile.ssv", *words))
    for name, (content, words) in texts(SSV, "ramp.start").items()
}
