"""Systems that refer to themselves or to files elsewhere, and numbers and names that are too much for them."""

from __future__ import annotations

from tests.support.builders import (
    component,
    connection,
    document,
    external,
    inline,
    inline_mapping,
    pack,
    system,
)
from tests.support.refused import GAIN, PLAIN, RAMP

from .case import Case, Write

SSD = "SystemStructure.ssd"
RUN = "run hostile.ssp --output out/x.csv"
COMMANDS = (RUN,)


def packed(root: str, files: dict[str, str | bytes] | None = None, **options: object) -> Write:
    """Return a writer of a system in an archive with its FMUs."""

    def write(folder: object, fmus: object) -> None:
        pack(folder / "hostile.ssp", fmus, document(root, **options), **(files or {}))

    return write


def nested(depth: int) -> str:
    inside = RAMP
    for _ in range(depth):
        inside = system(inside, name="s")
    return inside


def experiment(start: str, stop: str, step: str = "0.25") -> Write:
    text = document(PLAIN).replace('startTime="0" stopTime="1.0"', f'startTime="{start}" stopTime="{stop}"')
    text = text.replace('size="0.25"', f'size="{step}"')
    return lambda folder, fmus: pack(folder / "hostile.ssp", fmus, text)


def sourced(source: str) -> str:
    return system(component("ramp", "ramp").replace("resources/ramp.fmu", source))


SOURCES = {
    "a parent's FMU": "../../outside.fmu",
    "an encoded parent's FMU": "..%2f..%2foutside.fmu",
    "an absolute FMU": "/etc/outside.fmu",
    "a file's URL": "file:///etc/outside.fmu",
    "a URL": "http://127.0.0.1:9/outside.fmu",
    "an encoded NUL": "resources/ramp%00.fmu",
    "a name of 10^5": "a" * 100_000 + ".fmu",
    "an escape that is encoded": "resources/%1b%5b2J%0aperilune.fmu",
    "a direction of writing": "resources/\u202eumf.fmu",
    "another machine": "proxyfmu://10.0.0.1?file=resources/ramp.fmu",
    "the archive itself": "../hostile.ssp.fmu",
}
CASES = {
    f"system: {name}": Case(packed(sourced(source)), COMMANDS, ("hostile.ssp", "ramp"))
    for name, source in SOURCES.items()
}
LOOP = system(
    GAIN,
    component("other", "gain", "input u Real m; output y Real m"),
    connections=connection("gain.y", "other.u") + connection("other.y", "gain.u"),
)
OTHERS: dict[str, tuple[Write, tuple[str, ...]]] = {
    "a cycle": (packed(LOOP), (SSD, "gain")),
    "10^4 systems in one another": (packed(nested(10_000)), (SSD, "line", "depth")),
    "a system of its own file": (
        packed(system(component("ramp", "SystemStructure.ssd"))),
        (SSD, "ramp", "not an .fmu"),
    ),
    "a connector of itself": (
        packed(system(declared="input a Real m; output b Real m", connections=connection("b", "b"))),
        (SSD, "b -> b"),
    ),
    "names with escapes": (
        packed(system(component("r\u202eamp", "ramp", "output z Real m"))),
        (SSD, r"r\u202eamp.z", "no variable"),
    ),
    "a line feed in a name": (
        packed(system(component("ramp&#10;perilune: OK", "ramp", "output z Real m"))),
        (SSD, "no variable"),
    ),
    "a name of 10^6": (packed(system(component("a" * 1_000_000, "ramp", "output z Real m"))), (SSD, "no variable")),
    "10^5 invalid connectors": (
        packed(
            system(
                component("ramp", "ramp").replace(
                    "</ssd:Component>",
                    (
                        "<ssd:Connectors>"
                        + '<ssd:Connector name="y" q="1" kind="output"/>' * 100_000
                        + "</ssd:Connectors></ssd:Component>"
                    ),
                )
            )
        ),
        (SSD, "violations"),
    ),
    "10^5 connectors of one name": (
        packed(system(component("ramp", "ramp", "output y Real m;" * 100_000))),
        (SSD, "y", "declared twice"),
    ),
    "50 000 open inputs": (
        packed(system(declared="".join(f"input a{n} Real m;" for n in range(50_000)))),
        (SSD, "50000 inputs"),
    ),
    "a stop of nan": (experiment("0", "NaN"), (SSD, "stopTime")),
    "a stop of inf": (experiment("0", "INF"), (SSD, "stopTime")),
    "a start of -inf": (experiment("-INF", "1"), (SSD, "startTime")),
    "a start of nan": (experiment("NaN", "1"), (SSD, "startTime")),
    "a stop of 1e400": (experiment("0", "1e400"), (SSD, "stopTime")),
    "a stop of 1.7e308": (experiment("0", "1.7e308"), (SSD, "stopTime")),
    "times of +-1.7e308": (experiment("-1.7e308", "1.7e308"), (SSD, "stopTime")),
    "a stop before the start": (experiment("5", "1"), (SSD, "stopTime")),
    "a stop of 10^5 digits": (experiment("0", "1" * 100_000), (SSD, "stopTime")),
    "a step of 0": (experiment("0", "1", "0"), (SSD, "size")),
    "a negative step": (experiment("0", "1", "-0.1"), (SSD, "size")),
    "a step of nan": (experiment("0", "1", "nan"), (SSD, "size")),
    "a step of 1e-300": (experiment("0", "1", "1e-300"), (SSD, "step")),
    "a step of 1e300": (experiment("0", "1", "1e300"), (SSD, "step")),
    "10^15 steps": (experiment("0", "1e9", "1e-6"), ("rows of 5 signals",)),
    "10^9 steps": (experiment("0", "1e9", "1"), ("rows of 5 signals",)),
}
CASES |= {f"system: {name}": Case(write, COMMANDS, words) for name, (write, words) in OTHERS.items()}

REFERENCES = {
    "a parent's parameter set": system(RAMP, bindings=external("../../etc/passwd")),
    "an absolute parameter set": system(RAMP, bindings=external("/etc/passwd")),
    "a URL's parameter set": system(RAMP, bindings=external("http://127.0.0.1:9/a.ssv")),
    "a parameter set that is not there": system(RAMP, bindings=external("a\u202e.ssv")),
    "a parameter set that is the description": system(RAMP, bindings=external("SystemStructure.ssd")),
    "a mapping that is not there": system(
        RAMP, bindings=inline("a=Real:1", mapping='<ssd:ParameterMapping source="/dev/zero"/>')
    ),
    "a mapping of infinite factor": system(
        RAMP,
        bindings=inline(
            "a=Real:1",
            mapping=inline_mapping(
                '<ssm:MappingEntry source="a" target="ramp.start">'
                '<ssc:LinearTransformation factor="INF"/></ssm:MappingEntry>'
            ),
        ),
    ),
}
CASES |= {f"system: {name}": Case(packed(root), COMMANDS, ("hostile.ssp",)) for name, root in REFERENCES.items()}
