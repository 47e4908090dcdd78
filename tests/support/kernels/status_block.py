"""A block with enumerations that name their members alike."""

from __future__ import annotations

from perilune import Block, Input, Output, Status, outcome


class Engine(Status):
    """Of the engine."""

    READY = outcome("cold")


class Tank(Status):
    """Of the tank."""

    FULL = outcome("full")
    READY = outcome("pressurised")


class Valve(Status):
    """Of the valve."""

    SHUT = outcome("shut")
    OPEN = outcome("open")
    READY = outcome("checked")


class Readiness(Block):
    """Outcomes of one name and different values."""

    count = Input(0, description="number that is added")
    engine = Output(0, description="of the engine")
    tank = Output(0, description="of the tank")
    valve = Output(0, description="of the valve")

    def step(self, t: float, h: float) -> None:
        self.engine = Engine.READY + self.count
        self.tank = Tank.READY + self.count
        self.valve = Valve.READY + self.count
