"""Enumerations of Perilune's FMUs in systems: set by item or number, connected with Integers and Reals.

Truth: the numbers of items in the block's declaration, and simulations with these numbers.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import perilune
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.own_blocks import build_own_blocks
from tests.support.builders import component, connection, document, fly, pack, system

SYSTEM = "lunar_terminal_guidance"
BLOCKS = '''
from perilune import Block, Enumeration, Input, Output, Parameter, member


class Level(Enumeration, first=4):
    """Levels."""

    LOW = member("low")
    HIGH = member("high")


class Chooser(Block):
    """Gives the level that it is set to."""

    wanted = Parameter(Level, description="level")
    level = Output(Level, description="level")

    def initialize(self) -> None:
        self.level = self.wanted

    def step(self, t: float, h: float) -> None:
        self.level = self.wanted


class Adder(Block):
    """The sum of a whole number, a real one and a level."""

    whole = Input(0, description="whole")
    real = Input(0.0, description="real")
    level = Input(Level, description="level")
    total = Output(0.0, direct=True, description="sum")

    def step(self, t: float, h: float) -> None:
        self.total = float(self.whole) + self.real + float(self.level)
'''


@pytest.mark.usefixtures("fmus")
def test_an_item_is_set_by_its_name_as_by_its_number() -> None:
    enumeration = catalogue()["analytic_guidance"].variables["terminal_step"].enumeration
    assert enumeration is not None
    sizes = set()
    for number, name in enumeration.names.items():
        flights = [perilune.simulate(SYSTEM, set={"guidance.terminal_step": each}) for each in (number, name)]
        for signal, values in flights[0].signals.items():
            assert np.array_equal(values, flights[1].signals[signal], equal_nan=True), signal
        sizes.add(tuple(flights[0].signals["plant.mass"]))
    assert len(sizes) == len(enumeration.names)


@pytest.mark.usefixtures("fmus")
def test_a_status_is_a_number_in_its_signal() -> None:
    flight = perilune.simulate(SYSTEM, stop_time=1.0)
    assert flight.types["guidance.status"] == "Enumeration"
    assert type(flight.final()["guidance.status"]) is int


@pytest.mark.parametrize("declared", ["Integer", "-"])
def test_an_enumeration_is_connected_with_every_kind_of_number(declared: str, tmp_path: Path) -> None:
    """Its connector declared as Integer, as where FMUs had Integers there, or without a type."""
    (tmp_path / "blocks.py").write_text(BLOCKS)
    platform = local_platform()
    assert platform is not None
    build_own_blocks(tmp_path / "blocks.py", tmp_path, ["native"], [platform])
    inputs = f"input whole Integer; input real Real; input level {declared}"
    text = document(
        system(
            component("chooser", "chooser", f"output level {declared}"),
            component("adder", "adder", inputs),
            connections="".join(connection("chooser.level", f"adder.{name}") for name in ("whole", "real", "level")),
        )
    )
    path = pack(tmp_path / "levels.ssp", tmp_path / "native", text)
    for given, total in (("HIGH", 15.0), (5, 15.0), ("LOW", 12.0)):
        flight = perilune.simulate(path, set={"chooser.wanted": given})
        assert flight.signals["adder.total"][-1] == total
    with pytest.raises(ValueError, match="the enumeration has no item 3; use one of HIGH, LOW"):
        fly(path, set={"chooser.wanted": 3})
