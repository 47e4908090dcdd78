"""Documents of SSP 2.0 whose arrays are to use up memory, or say something else than their values do."""

from __future__ import annotations

from tests.support.arrays.documents import in_version_2
from tests.support.builders import connection, document, parameter_set, system
from tests.support.refused import RAMP

from .case import Case, Content, put
from .documents import of_description, texts


def declared(text: str, connections: str = "") -> str:
    return in_version_2(document(system(RAMP, declared=text, connections=connections)))


def many() -> str:
    return declared("; ".join(f"input in{number}(1000,1000) Float64 m" for number in range(1000)))


def values(size: str, given: str) -> str:
    return in_version_2(parameter_set(f"ramp.start({size})=Float64:{given} m"))


FILE, SET = ("SystemStructure.ssd",), ("hostile.ssv",)
BOUND = "at most 1e+06 are accepted"
INDEX = connection("in", "out", attributes='startIndices="{}" endIndices="1"')
PAIR = "input in(3) Float64 m; output out(3) Float64 m"
TWO = in_version_2(document(system(RAMP)))
DESCRIPTIONS: dict[str, tuple[Content, tuple[str, ...]]] = {
    "of 10^12 elements": (declared("input in(1000000,1000000) Float64 m"), ("in", BOUND)),
    "of 10^300 elements": (declared(f"input in({','.join(['1000000000'] * 34)}) Float64 m"), ("in", BOUND)),
    "a thousand of 10^6 elements": (many, (BOUND,)),
    "of a size beyond 64 bits": (declared(f"input in({10**30}) Float64 m"), ("line", "not valid SSP 2.0")),
    "of a size that gives itself": (declared("structuralParameter n(n) Int32; input in(n) Float64 m"), ("line",)),
    "of a size that nothing has": (declared("input in(n) Float64 m"), ("in, Dimension (line", "sizeConnector n")),
    "an index beyond 64 bits": (declared(PAIR, INDEX.format(10**30)), ("line", "not valid SSP 2.0")),
    "an index of 10^18": (declared(PAIR, INDEX.format(10**18)), ("connection in -> out (line", "no element")),
    "10^5 indices": (lambda: declared(PAIR, INDEX.format("1 " * 100_000)), ("connection in -> out (line",)),
    "an index that is no number": (declared(PAIR, INDEX.format("0x1")), ("line", "not valid SSP 2.0")),
}
SETS: dict[str, tuple[Content, tuple[str, ...]]] = {
    "of 10^18 values, of which there is one": (values("1000000000,1000000000", "1"), ("ramp.start", BOUND)),
    "10^6 values of a scalar": (
        lambda: in_version_2(parameter_set("ramp.start=Float64:7 m")).replace('"7"', f'"{"7 " * 1_000_000}"'),
        ("ramp.start (line", "1000000 values for a scalar"),
    ),
    "of no value": (values("3", ""), ("ramp.start (line", "0 values for the 3 elements")),
    "a value that is no number": (values("2", "1,two"), ("line", "not valid SSP 2.0")),
    "of a value that SSP 1.0 has not": (parameter_set("ramp.start=Float64:1 m"), ("line", "not valid SSP 1.0")),
    "of SSP 3": (in_version_2(parameter_set("")).replace('"2.0"', '"3.0"'), ("version (line", "SSP version 3.0")),
}
CASES = {
    f"arrays: description {name}": Case(of_description(text), ("describe hostile",), (*FILE, *words))
    for name, (text, words) in DESCRIPTIONS.items()
}
CASES |= {
    f"arrays: parameter set {name}": Case(put("hostile.ssv", text), ("validate hostile.ssv",), (*SET, *words))
    for name, (text, words) in SETS.items()
}
CASES |= {
    f"description of SSP 2.0: {name}": Case(of_description(text), ("describe hostile",), (*FILE, *words))
    for name, (text, words) in texts(TWO, "resources/ramp.fmu").items()
}
