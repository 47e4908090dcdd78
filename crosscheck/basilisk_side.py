"""Simulations in Basilisk for cross-checks. Runs in Basilisk's environment: nothing of Perilune is imported.

python -m crosscheck.basilisk_side FOLDER.CASE FILE HANDED [NUMBER]

NUMBER is a step or an amplitude. HANDED is a JSON file of numbers for the case, where our side hands some over.
"""

import json
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
from Basilisk.simulation import gravityEffector, spacecraft
from Basilisk.utilities import SimulationBaseClass, macros

from crosscheck.table import Table, write_table

TASK = "dynamics"


class Flight:
    """A spacecraft in a simulation with one task; its states are recorded at every step."""

    def __init__(self, step: float) -> None:
        self.step = macros.sec2nano(step)
        self.simulation = SimulationBaseClass.SimBaseClass()
        self.simulation.CreateNewProcess("process").addTask(self.simulation.CreateNewTask(TASK, self.step))
        self.craft = spacecraft.Spacecraft()
        self.craft.ModelTag = "craft"
        self.add(self.craft, priority=1)
        self.states = self.craft.scStateOutMsg.recorder()
        self.is_begun = False
        self.references: list[object] = []  # modules that Python would drop before the simulation ends

    def add(self, model: object, priority: int = -1) -> None:
        """Update a model at every step; those of higher priority first."""
        self.simulation.AddModelToTask(TASK, model, priority)

    def attract(self, mu: float) -> None:
        """Put a point mass with this gravitational parameter (m3/s2) at the origin."""
        body = gravityEffector.GravBodyData()
        body.planetName, body.mu, body.isCentralBody = "centre", mu, True
        self.craft.gravField.gravBodies = spacecraft.GravBodyVector([body])

    def set_inertia(self, rows: list[list[float]], mass: float = 1000.0) -> None:
        """Set inertia (kg m2) about the centre of mass, and mass (kg)."""
        self.craft.hub.mHub, self.craft.hub.IHubPntBc_B = mass, rows

    def start(
        self, position: object, velocity: object, mrp: object = (0.0, 0.0, 0.0), rate: object = (0.0, 0.0, 0.0)
    ) -> None:
        """Set position (m), velocity (m/s), inertial; attitude (MRP, inertial to body), rate (rad/s, body)."""
        hub = self.craft.hub
        hub.r_CN_NInit, hub.v_CN_NInit = column(position), column(velocity)
        hub.sigma_BNInit, hub.omega_BN_BInit = column(mrp), column(rate)

    def run(self, end: float) -> None:
        """Simulate to a time (s), from the start or from where it ended before."""
        if not self.is_begun:
            self.is_begun = True
            self.add(self.states)
            self.simulation.InitializeSimulation()
        self.simulation.ConfigureStopTime(macros.sec2nano(end))
        self.simulation.ExecuteSimulation()

    def table(self) -> Table:
        """Return time (s), position, velocity (inertial), quaternion from body to inertial, rate (body)."""
        states = self.states
        return {
            "time": np.array(states.times()) * 1e-9,
            **elements("position", states.r_CN_N),
            **elements("velocity", states.v_CN_N),
            **elements("quaternion", quaternions(np.array(states.sigma_BN))),
            **elements("rate", states.omega_BN_B),
        }


def column(numbers: object) -> list[list[float]]:
    """Return a vector as Basilisk takes it."""
    return [[float(number)] for number in numbers]


def elements(name: str, rows: object) -> Table:
    return {f"{name}[{index + 1}]": values for index, values in enumerate(np.array(rows).T)}


def quaternions(mrp: np.ndarray) -> np.ndarray:
    """Convert MRPs (inertial to body axes) to quaternions of the same turn, body to inertial, scalar first, [n, 4]."""
    square = np.sum(mrp**2, axis=1, keepdims=True)
    return np.hstack([1.0 - square, 2.0 * mrp]) / (1.0 + square)


def to_mrp(quaternion: object) -> np.ndarray:
    """Convert the other way."""
    q = np.array(quaternion) / np.linalg.norm(quaternion)
    return q[1:] / (1.0 + q[0])


if __name__ == "__main__":
    name, file, handed, *numbers = sys.argv[1:]
    arguments: list[object] = [float(number) for number in numbers]
    if Path(handed).is_file():
        arguments.append(json.loads(Path(handed).read_text(encoding="utf-8")))
    write_table(Path(file), import_module(f"crosscheck.{name}.basilisk").fly(*arguments))
