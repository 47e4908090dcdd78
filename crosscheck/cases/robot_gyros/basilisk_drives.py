"""Drives in Basilisk for constant rates of gyros' wheels and gimbals, by torques that change with each step."""

import numpy as np
from Basilisk.architecture import messaging, sysModel

from crosscheck.cases.robot_gyros.case import (
    GIMBAL_ANGLES,
    GIMBAL_RATES,
    GYRO_INERTIA,
    INERTIA,
    ROTOR_MOMENTUM,
    WHEEL_INERTIA,
)

ANGLES, RATES = np.array(GIMBAL_ANGLES), np.array(GIMBAL_RATES)  # rad, rad/s
WHEEL_SPEED = ROTOR_MOMENTUM / WHEEL_INERTIA  # rad/s
SPIN, GIMBAL_AXES = (
    np.array([1.0, 0.0, 0.0]),
    np.array([(0.0, 0.0, 1.0)] * 2 + [(0.0, -1.0, 0.0)] * 2),
)  # body, at 0 rad
TO_SECONDS = 1e-9


class Drives(sysModel.SysModel):
    """Torques that cancel those of the rotation in the middle of the next step, and correct what gimbals lag.

    Gimbals lag by the angles and the mean rates of steps (rates at the ends are above those within); two steps
    after a deviation it is corrected.
    """

    def __init__(self, craft: object, step: float) -> None:
        super().__init__()
        self.ModelTag = "drives"
        self.craft, self.length = craft, step
        self.lag, self.correction = np.zeros(RATES.size), np.zeros(RATES.size)  # rad
        self.commands = messaging.VSCMGArrayTorqueMsg()

    def state(self, name: str) -> np.ndarray:
        return np.array(self.craft.dynManager.getStateObject(name).getState()).flatten()

    def UpdateState(self, now: int) -> None:  # noqa: N802
        """Write torques of the step that begins at this time (ns)."""
        length, angles = self.length, ANGLES + RATES * now * TO_SECONDS
        lag = angles - self.state("VSCMGGammas")
        self.correction = 2.5 * lag - 1.5 * self.lag - 0.75 * self.correction
        self.lag = lag
        middle = angles + 0.5 * length * RATES
        begin = np.array(self.craft.scStateOutMsg.read().omega_BN_B)
        rate = begin + 0.5 * length * acceleration(begin, angles)
        slope = acceleration(rate, middle)
        spin, across = axes(middle)
        slow = WHEEL_SPEED - self.state("VSCMGOmegas")
        gyroscopic = ROTOR_MOMENTUM * across @ rate
        command = messaging.VSCMGArrayTorqueMsgPayload()
        command.gimbalTorque = list(GYRO_INERTIA * (self.correction / length**2 + GIMBAL_AXES @ slope) - gyroscopic)
        command.wheelTorque = list(WHEEL_INERTIA * (slow / length + spin @ slope + RATES * (across @ rate)))
        self.commands.write(command, now, self.moduleID)


def axes(angles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return spin axes (body) at gimbal angles (rad), and their derivatives by these."""
    spin = np.cos(angles)[:, None] * SPIN + np.sin(angles)[:, None] * np.cross(GIMBAL_AXES, SPIN)
    return spin, np.cross(GIMBAL_AXES, spin)


def acceleration(rate: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Return angular acceleration (rad/s2, body) that the drives expect."""
    spin, across = axes(angles)
    momentum = INERTIA * rate + ROTOR_MOMENTUM * spin.sum(axis=0)
    return -(np.cross(rate, momentum) + ROTOR_MOMENTUM * RATES @ across) / INERTIA
