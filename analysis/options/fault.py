"""A fault on a connector, and its textual form."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass

from ...common.errors import InputError

KINDS = ("override", "bias", "freeze")
FORM = "COMPONENT.CONNECTOR=override|bias|freeze[:VALUE]@T[..T]"
WRITTEN = re.compile(  # 1...2 is rejected: the third dot could belong to either end of the window
    r"(?P<name>.+)=(?P<kind>[^=:@]+)(?::(?P<value>[^=:@]+))?@(?P<start>[^=:@]*?[^=:@.])(?:\.\.(?P<stop>(?!\.)[^=:@]*))?"
)


@dataclass(frozen=True)
class Fault:
    """Fault that replaces (override), offsets (bias) or holds (freeze) a connector's value in [start, stop) s.

    ``name`` is ``component.connector``: a fault on an output reaches all readers, and a fault on an input reaches only
    its component. ``value`` is in the connector's unit and unused for a freeze. `parse_fault` reads the text of a
    fault. Raises InputError for an unknown kind, a non-finite value or an empty window.
    """

    name: str
    kind: str
    value: float | bool = 0.0
    start: float = 0.0
    stop: float = math.inf

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise InputError("fault", self.name, f"unknown kind {self.kind}", f"use one of {', '.join(KINDS)}")
        if not math.isfinite(self.value):
            raise InputError("fault", self.name, f"the value {self.value} is not finite", "give a finite number")
        if self.kind == "freeze" and self.value != 0.0:
            raise InputError(
                "fault", self.name, "a freeze has no value", "omit the value: a freeze holds the current value"
            )
        if not self.start < self.stop:
            start, stop = number_text(self.start), number_text(self.stop)
            problem = f"empty window: the end, {stop} s, is not after the start, {start} s"
            raise InputError("fault", self.name, problem, "give a start before the end")

    def __str__(self) -> str:
        value = "" if self.kind == "freeze" else f":{number_text(self.value)}"
        stop = "" if self.stop == math.inf else f"..{number_text(self.stop)}"
        return f"{self.name}={self.kind}{value}@{number_text(self.start)}{stop}"


def number_text(value: float | bool) -> str:
    """Return a number with enough digits to be read back exactly."""
    return str(value).lower() if isinstance(value, bool) else repr(float(value)).removesuffix(".0")


def parse_fault(text: str, option: str = "`faults`") -> Fault:
    """Return the fault that a text of the form `FORM` describes; without the second T the fault does not end.

    ``option`` is the name of the option in errors. Raises InputError.
    """
    match = WRITTEN.fullmatch(text.strip())
    if match is None:
        raise InputError(option, text, f"not of the form {FORM}", "use this form")
    name, kind = match["name"].strip(), match["kind"].strip()
    if kind == "freeze" and match["value"] is not None:
        raise InputError(option, text, "a freeze has no value", "omit the value: a freeze holds the current value")
    if kind in ("override", "bias") and match["value"] is None:
        raise InputError(option, text, f"{kind} lacks its value", f"write {kind}:VALUE")
    try:
        stop = float(match["stop"]) if match["stop"] else math.inf
        return Fault(name, kind, _value(match["value"] or "0"), float(match["start"]), stop)
    except InputError as error:
        raise InputError(option, text, error.problem, error.remedy) from error
    except ValueError as error:
        problem = str(error).replace("could not convert string to float", "not a number")
        raise InputError(option, text, problem, f"write {FORM}, times in s") from error


def faults_of(faults: Iterable[Fault | str]) -> list[Fault]:
    """Return the faults, with texts converted by `parse_fault`. Raises InputError."""
    return [parse_fault(item) if isinstance(item, str) else item for item in faults]


def _value(text: str) -> float | bool:
    """Return the value of a fault from its text. Raises ValueError."""
    text = text.strip()
    return text == "true" if text in ("true", "false") else float(text)
