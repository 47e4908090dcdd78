"""Ports: a variable declared from a port has the port's unit, frame and bounds, and its own start and description.

Truth: the declarations. Enumerations are plain ints in kernels, and their meanings describe the variable.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

from perilune.fmus_src.block import Block
from perilune.fmus_src.bundles import Bundle
from perilune.fmus_src.export.judge.subset import check
from perilune.fmus_src.export.native_fmu import native_sources
from perilune.fmus_src.interfaces import ports as package
from perilune.fmus_src.interfaces.ports import body, entry, inertial, landing, robot, sampling
from perilune.fmus_src.kernel.enumerations import Enumeration, member
from perilune.fmus_src.ports import Port
from perilune.fmus_src.units import deg
from perilune.fmus_src.variables import DeclarationError, Input, Output, Parameter, State

FORCE = Port([0.0, 0.0, 0.0], unit="N", frame="body", description="force")
LEVEL = Port(1.0, unit="1", minimum=0.0, description="level")


class Winch(Block):
    """Has a port of every kind."""

    demanded_force = FORCE.input("demanded force")
    force = FORCE.output(start=[1.0, 2.0, 3.0], direct=True)
    level = LEVEL.parameter(0.5)
    least_level = LEVEL.parameter(description="least", maximum=2.0)
    last_force = FORCE.state("of the last step", frozen=True)

    def step(self, t: float, h: float) -> None:
        self.force = self.demanded_force


def test_variables_have_what_the_port_declares_and_their_changes() -> None:
    of = Winch.variables
    kinds = {name: type(variable).__name__ for name, variable in of.items()}
    assert list(kinds.items()) == [
        ("demanded_force", Input.__name__), ("force", Output.__name__), ("level", Parameter.__name__),
        ("least_level", Parameter.__name__), ("last_force", State.__name__),
    ]  # fmt: skip
    assert {of[name].unit for name in ("demanded_force", "force", "last_force")} == {"N"}
    assert of["demanded_force"].descriptions() == ["demanded force (body frame)"] * 3
    assert of["force"].descriptions() == ["force (body frame)"] * 3
    assert of["force"].start == [1.0, 2.0, 3.0]
    assert of["demanded_force"].start == [0.0, 0.0, 0.0]
    assert of["force"].direct
    assert (of["level"].start, of["level"].minimum, of["level"].maximum) == (0.5, 0.0, None)
    assert (of["least_level"].start, of["least_level"].maximum, of["least_level"].description) == (1.0, 2.0, "least")
    assert of["last_force"].frozen


def test_variables_of_one_port_are_their_own() -> None:
    one, other = Winch(), Winch()
    one.demanded_force = [1.0, 2.0, 3.0]
    one.step(0.0, 0.1)
    assert list(one.force) == [1.0, 2.0, 3.0]
    assert list(other.demanded_force) == [0.0, 0.0, 0.0]
    assert FORCE.start == [0.0, 0.0, 0.0]


def test_bounds_of_the_port_hold_for_a_start_of_ones_own() -> None:
    with pytest.raises((DeclarationError, RuntimeError)):

        class Low(Block):
            """Starts below the port's minimum."""

            level = LEVEL.parameter(-1.0)


def test_every_port_is_declared_once_and_used() -> None:
    """No two ports of a domain say the same, and every port and bundle has at least two users."""
    assert package.__doc__
    source = "\n".join(
        path.read_text(encoding="utf-8") for path in (Path(__file__).parents[2] / "fmus_src").rglob("*.py")
    )
    for domain in (body, entry, inertial, landing, robot, sampling):
        ports = {name: port for name, port in vars(domain).items() if isinstance(port, Port)}
        said = [(str(port.start), str(port.declaration)) for port in ports.values()]
        assert len(said) == len(set(said)), domain.__name__
        bundles = [each for each in vars(domain).values() if isinstance(each, type) and issubclass(each, Bundle)]
        uses = {
            name: source.count(f"{domain.__name__.rpartition('.')[2]}.{name}.")
            + sum(port in bundle.ports.values() for bundle in bundles)
            for name, port in ports.items()
        }
        uses |= {
            each.__name__: len(re.findall(rf"puts\((\w+\.)?{each.__name__},", source))
            for each in bundles
            if each is not Bundle
        }
        for name, count in uses.items():
            assert count > 1, f"{domain.__name__}: {name} is used {count} times; declare it where it is used"


class WinchStatus(Enumeration):
    """Status of the last demand."""

    GOOD = member("good")
    LIMITED = member("force limited, torque held")


class WinchMethod(Enumeration, first=1):
    """Drive of the winch."""

    DIRECT = member("direct")
    GEARED = member("geared")


class LimitedWinch(Block):
    """Its status and its method are enumerations."""

    method = Parameter(WinchMethod, start=WinchMethod.GEARED, description="of the drive")
    demanded_force = Input(0.0, unit="N", description="demanded force")
    force = Output(0.0, unit="N", direct=True, description="force")
    status = Output(WinchStatus, direct=True)

    def step(self, t: float, h: float) -> None:
        self.status = WinchStatus.GOOD
        self.force = self.demanded_force
        if self.force > 1.0:
            self.force = 1.0
            self.status = WinchStatus.LIMITED


def test_members_are_plain_ints_and_describe_their_variable() -> None:
    assert (WinchStatus.GOOD, WinchStatus.LIMITED) == (0, 1)
    assert type(WinchStatus.LIMITED) is int
    status = LimitedWinch.variables["status"]
    assert (status.start, status.minimum, status.maximum) == (0, 0, 1)
    assert status.description == "status of the last demand: 0 good, 1 force limited, torque held"
    assert status.type_name == "Integer"
    method = LimitedWinch.variables["method"]
    assert (method.start, method.minimum, method.maximum) == (2, 1, 2)
    assert method.description == "of the drive: 1 direct, 2 geared"


def test_start_of_an_enumeration_is_one_of_its_numbers() -> None:
    with pytest.raises(DeclarationError, match="above its maximum 2"):
        Parameter(WinchMethod, start=3).__set_name__(Block, "method")


class MisspeltWinch(LimitedWinch):
    """Names a member that there is not."""

    def step(self, t: float, h: float) -> None:
        self.status = WinchStatus.UNLIMITED  # type: ignore[attr-defined]


def test_members_are_constants_of_the_kernel() -> None:
    assert check(LimitedWinch) == []
    code = native_sources(LimitedWinch, "{0}")["limited_winch.c"].decode()
    assert re.search(r"static const int64_t \w+_LIMITED = 1;", code)
    winch = LimitedWinch(demanded_force=2.0)
    winch.step(0.0, 0.1)
    assert (winch.force, winch.status) == (1.0, 1)
    (violation,) = check(MisspeltWinch)
    assert violation.what.startswith("WinchStatus.UNLIMITED is no")


def test_degrees_are_radians() -> None:
    assert deg(180.0) == math.pi
    assert deg(-20.0) == -20.0 * math.pi / 180.0
