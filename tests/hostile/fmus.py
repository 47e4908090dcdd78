"""FMUs whose modelDescription.xml, names or files are hostile."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable
from pathlib import Path

from tests.support.builders import write_zip

from .case import Case, Write
from .documents import into, with_doctype

COMMANDS = ("run hostile.fmu --output out/x.csv",)
DESCRIPTION = "modelDescription.xml"


def changed(change: Callable[[str], str | bytes], name: str = "hostile.fmu") -> Write:
    """Return a writer of the good FMU with another model description."""

    def write(folder: Path, fmus: Path) -> None:
        with zipfile.ZipFile(fmus / "ramp.fmu") as archive:
            files: dict[str, bytes | str] = {name: archive.read(name) for name in archive.namelist()}
        text = files[DESCRIPTION]
        assert isinstance(text, bytes)
        files[DESCRIPTION] = change(text.decode())
        write_zip(folder / name, files)

    return write


def with_files(*more: tuple[str, bytes]) -> Write:
    """Return a writer of the good FMU with more files."""

    def write(folder: Path, fmus: Path) -> None:
        (folder / "hostile.fmu").write_bytes((fmus / "ramp.fmu").read_bytes())
        with zipfile.ZipFile(folder / "hostile.fmu", "a") as archive:
            for name, content in more:
                archive.writestr(name, content)

    return write


def swap(old: str, new: str) -> Callable[[str], str]:
    def change(text: str) -> str:
        assert old in text, old
        return text.replace(old, new)

    return change


VARIABLES = "<ModelVariables>"
IDENTIFIER = 'modelIdentifier="ramp"'
DESCRIPTIONS: dict[str, tuple[Callable[[str], str | bytes], tuple[str, ...]]] = {
    "a billion laughs": (lambda text: with_doctype(text, '<!ENTITY a "b">'), (DESCRIPTION, "DOCTYPE")),
    "an entity of a file": (
        lambda text: with_doctype(text, '<!ENTITY a SYSTEM "file:///etc/passwd">').replace('"ramp"', '"&a;"', 1),
        (DESCRIPTION, "DOCTYPE"),
    ),
    "depth 10^5": (lambda text: into(text, "<a>" * 100_000), (DESCRIPTION, "not well-formed")),
    "2 x 10^6 elements": (lambda text: into(text, "<a/>" * 2_000_000), (DESCRIPTION, "at most 1.5e+06")),
    "10^5 variables of one name": (
        swap(VARIABLES, VARIABLES + '<ScalarVariable name="x" valueReference="1"><Real/></ScalarVariable>' * 100_000),
        ("x", "two variables"),
    ),
    "10^5 variables without a type": (
        swap(
            VARIABLES,
            VARIABLES + "".join(f'<ScalarVariable name="x{n}" valueReference="1"/>' for n in range(100_000)),
        ),
        (DESCRIPTION, "violations"),
    ),
    "nothing": (lambda _: "", (DESCRIPTION, "not well-formed")),
    "another document": (lambda _: "<a/>", ("fmiVersion",)),
    "version 2.0 and no more": (
        lambda _: '<fmiModelDescription fmiVersion="2.0"/>',
        ("hostile.fmu", "no attribute modelName"),
    ),
    "version of 10^6 digits": (swap('fmiVersion="2.0"', f'fmiVersion="{"2" * 1_000_000}"'), ("fmiVersion",)),
    "an identifier that leaves": (swap(IDENTIFIER, 'modelIdentifier="../../../tmp/evil"'), ("../../../tmp/evil",)),
    "an absolute identifier": (swap(IDENTIFIER, 'modelIdentifier="/tmp/evil"'), ("/tmp/evil",)),
    "no identifier": (swap(IDENTIFIER, 'modelIdentifier=""'), ("hostile.fmu",)),
    **{
        f"an unknown of {number}": (
            lambda text, number=number: re.sub(r'<Unknown index="\d+"', f'<Unknown index="{number}"', text, count=1),
            ("Unknown (line", "index", "is not the index of one of its"),
        )
        for number in ("0", "99", "-1", "9" * 5000, "one")
    },
    "a dependency on nothing": (
        lambda text: re.sub(
            r"<Unknown ", '<Unknown dependencies="1 99" ', re.sub(r' dependencies="[^"]*"', "", text), count=1
        ),
        ("Unknown (line", "dependencies", "99 is not the number"),
    ),
    "a reference of 10^6 digits": (
        lambda text: text.replace('valueReference="0"', f'valueReference="{"9" * 1_000_000}"', 1),
        (DESCRIPTION,),
    ),
}
CASES = {
    f"FMU: {name}": Case(changed(change), COMMANDS, ("hostile.fmu", *words))
    for name, (change, words) in DESCRIPTIONS.items()
}

SPOOF = "perilune: all is well"
FAKE = f"&#x202e;&#x9b;31m&#13;&#10;{SPOOF}"
NAMES: dict[str, Callable[[str], str]] = {
    "a variable's name": swap('name="slope"', f'name="slope{FAKE}"'),
    "a variable's description": swap('description="rise of y"', f'description="rise{FAKE}"'),
    "a model's description": swap('description="Source:', f'description="{FAKE} Source:'),
    "a model's name": swap('modelName="ramp"', f'modelName="ramp{FAKE}"'),
    "a unit": lambda text: text.replace('"m/s"', f'"m/s{FAKE}"'),
}
CASES |= {
    f"FMU: escapes in {name}": Case(changed(change), ("describe hostile.fmu",), accepted=True)
    for name, change in NAMES.items()
}
