"""Numbers of parameter sets and of options that no system can have."""

from __future__ import annotations

from tests.support.builders import component, inline, system
from tests.support.refused import PLAIN

from .case import Case
from .systems import COMMANDS, RUN, SSD, packed

VALUES = {
    "nan": "Real:nan",
    "NaN": "Real:NaN",
    "INF": "Real:INF",
    "1e400": "Real:1e400",
    "-1.7e308 in km": "Real:-1.7e308 km",
    "a unit nobody has": "Real:1 furlong",
    "2^31": "Integer:2147483648",
    "10^6 digits": f"Integer:{'9' * 1_000_000}",
    "a Real of 10^6 digits": f"Real:{'9' * 1_000_000}",
    "an Integer with a point": "Integer:1.5",
    "a Boolean of 2": "Boolean:2",
    "a text": "String:x",
    "underscores": "Real:1_000",
    "digits of another script": "Real:\u0661\u0662",
}
READ_LATER = ("NaN", "INF", "1e400", "-1.7e308 in km", "a unit nobody has", "a Real of 10^6 digits", "a text")
CASES = {
    f"value: {name}": Case(
        packed(
            system(
                component("ramp", "ramp"),
                bindings=inline(f"ramp.{'flag_at' if 'Integer' in text else 'start'}={text}"),
            )
        ),
        COMMANDS,
        (SSD, "ramp." if name in READ_LATER else "line 10: not valid SSP"),
    )
    for name, text in VALUES.items()
}
OPTIONS = {
    "--step 1e300": "--step",
    "--step -1": "--step",
    "--step 0": "--step",
    "--step 1e-300": "--step",
    "--step nan": "--step",
    "--step inf": "--step",
    f"--step {'1' * 1000}": "--step",
    "--stop-time nan": "--stop-time",
    "--stop-time inf": "--stop-time",
    "--stop-time -1": "--stop-time",
    "--stop-time 1e400": "--stop-time",
    "--stop-time 1.7e308": "--stop-time",
    "--stop-time 1e15": "rows of 5 signals",
    "--set ramp.start=nan": "ramp.start",
    "--set ramp.start=1e400": "ramp.start",
    f"--set ramp.flag_at={'9' * 100_000}": "ramp.flag_at",
    "--set ramp.start=0:1e9:1e-9": "ramp.start",
    "--set 'ramp.\x1b[2J=1'": r"ramp.\x1b[2J",
    "--fault ramp.y=bias:1e400@0": "ramp.y",
    "--fault ramp.y=bias:1@nan": "ramp.y",
    "--require '((((((((((x' ": "x",
}
CASES |= {
    f"option: {option[:40]}": Case(packed(PLAIN), (f"{RUN} {option}",), (element,))
    for option, element in OPTIONS.items()
}
