"""The documents that a description refers to, and those of the Open Simulation Platform."""

from __future__ import annotations

from pathlib import Path

from tests.support.builders import NAMESPACES, document, external, mapping, parameter_set, system
from tests.support.foreign.osp import groups, joined, simulator, structure
from tests.support.refused import RAMP

from .case import Case, Content, Write
from .documents import texts

SSM = mapping('<ssm:MappingEntry source="a" target="ramp.start"/>')
SSB = (
    f'<ssb:SignalDictionary version="1.0" {NAMESPACES}><ssb:DictionaryEntry name="height"><ssc:Real/>'
    "</ssb:DictionaryEntry></ssb:SignalDictionary>"
)
WITH_MAPPING = system(RAMP, bindings=external("a.ssv", mapping='<ssd:ParameterMapping source="a.ssm"/>'))
BUS = '<ssd:SignalDictionaries><ssd:SignalDictionary name="bus" source="a.ssb"/></ssd:SignalDictionaries>'
WITH_DICTIONARY = system(RAMP, extra=BUS)
OSP = structure(simulator("ramp", "ramp", start=2.0) + simulator("gain", "gain"), joined("ramp.y", "gain.u"))
GROUPED = structure(simulator("ramp", "ramp") + simulator("gain", "gain"), joined("ramp.y", "gain.u", "VariableGroup"))
GROUPS = groups(y="y", u="u")


def folder_with(name: str, content: Content, **others: str) -> Write:
    """Return a writer of a folder with FMUs and some files, one of them hostile."""

    def write(folder: Path, fmus: Path) -> None:
        system_folder = folder / "hostile"
        system_folder.mkdir()
        for fmu in ("ramp", "gain"):
            (system_folder / f"{fmu}.fmu").write_bytes((fmus / f"{fmu}.fmu").read_bytes())
        text = content() if callable(content) else content
        (system_folder / name).write_bytes(text.encode() if isinstance(text, str) else text)
        for other, other_text in others.items():
            (system_folder / other.replace("__", ".")).write_text(other_text)

    return write


def described(root: str) -> str:
    return document(root).replace("resources/", "")


MAPPED = {"SystemStructure__ssd": described(WITH_MAPPING), "a__ssv": parameter_set("a=Real:2")}
CASES = {
    f"mapping: {name}": Case(folder_with("a.ssm", content, **MAPPED), ("describe hostile",), ("a.ssm", *words))
    for name, (content, words) in texts(SSM, "ramp.start").items()
}
CASES |= {
    f"dictionary: {name}": Case(
        folder_with("a.ssb", content, SystemStructure__ssd=described(WITH_DICTIONARY)),
        ("describe hostile",),
        ("a.ssb", *words),
    )
    for name, (content, words) in texts(SSB, "height").items()
}
CASES |= {
    f"OSP: {name}": Case(
        folder_with("OspSystemStructure.xml", content), ("describe hostile",), ("OspSystemStructure.xml", *words)
    )
    for name, (content, words) in texts(OSP, "ramp.fmu", ("line", "is not part of an OspSystemStructure")).items()
}
UNREAD: tuple[str, ...] = ("other elements than groups are not read",)
CASES |= {
    f"OSP groups: {name}": Case(
        folder_with(
            "ramp_OspModelDescription.xml",
            content,
            OspSystemStructure__xml=GROUPED,
            gain_OspModelDescription__xml=GROUPS,
        ),
        ("describe hostile",),
        ("OspModelDescription.xml", *words),
    )
    for name, (content, words) in texts(GROUPS, "ref", UNREAD).items()
    if words != UNREAD and name != "10^5 namespaces"
}

SUM = '<Functions><VectorSum name="s" inputCount="{}" dimension="{}"/></Functions>'
OTHERS = {
    "10^9 inputs": (OSP.replace("<Connections>", SUM.format(10**9, 1) + "<Connections>"), ("VectorSum", "inputCount")),
    "10^5 dimensions": (OSP.replace("<Connections>", SUM.format(1, 10**5) + "<Connections>"), ("dimension",)),
    "a count of 10^5 digits": (
        OSP.replace("<Connections>", SUM.format("9" * 10**5, 1) + "<Connections>"),
        ("inputCount",),
    ),
    "10^5 connections to one input": (
        OSP.replace("<Connections>", "<Connections>" + joined("ramp.y", "gain.u") * 10**5),
        ("gain.u", "driven twice"),
    ),
    "a file far above": (OSP.replace('"ramp.fmu"', f'"{"../" * 99}gone/x.fmu"'), ("ramp (line", "no file ../")),
    "an absolute file": (OSP.replace('"ramp.fmu"', '"/etc/ramp.fmu"'), ("ramp (line", "lies outside")),
    "a step of inf": (OSP.replace(">0.125<", ">inf<"), ("BaseStepSize",)),
    "a start of nan": (OSP.replace("<BaseStepSize>", "<StartTime>nan</StartTime><BaseStepSize>"), ("Time",)),
    "a value of INF": (OSP.replace('value="2.0"', 'value="INF"'), ("start (line", "not finite")),
    "another namespace": (OSP.replace("MSMI/OSPSystemStructure", "MSMI/Other"), ("is not an OspSystemStructure",)),
}
CASES |= {
    f"OSP: {name}": Case(
        folder_with("OspSystemStructure.xml", content),
        ("run hostile --stop-time 1 --output out/x.csv",),
        words,
    )
    for name, (content, words) in OTHERS.items()
}
