"""Ports of an atmospheric entry: bank angle, its reference, and disturbances."""

import math

from ...bundles import Bundle
from ...ports import Port
from ...units import deg

BANK = Port(0.0, unit="rad", description="bank angle of the capsule")
DENSITY_FACTOR = Port(1.0, unit="1", description="ratio of actual to standard atmospheric density")
DYNAMIC_PRESSURE = Port(0.0, unit="Pa", description="dynamic pressure in the standard atmosphere without wind")
ERROR_LIMIT = Port(math.pi, unit="rad", description="magnitude to which the control limits the bank error")
JET_FACTOR = Port(
    [1.0] * 6,
    unit="1",
    description="ratio of actual to nominal torque of the jets about the body axes +x, -x, +y, -y, +z, -z",
)
TARGET_BANK = Port(deg(60.0), unit="rad", description="target bank angle of the programme")
WIND = Port(
    [0.0, 0.0, 0.0], unit="m/s", frame="velocity", description="velocity of the air relative to the rotating Earth"
)


class BankReference(Bundle):
    """Reference bank angle with its derivatives."""

    bank = Port(deg(60.0), unit="rad", description="reference bank angle")
    bank_rate = Port(0.0, unit="rad/s", description="time derivative of the reference bank angle")
    bank_acceleration = Port(0.0, unit="rad/s2", description="second time derivative of the reference bank angle")
