"""Entry into the atmosphere: bank, its reference, and what disturbs."""

import math

from ...bundles import Bundle
from ...ports import Port
from ...units import deg

BANK = Port(0.0, unit="rad", description="bank")
DENSITY_FACTOR = Port(1.0, unit="1", description="on the density of the standard atmosphere")
DYNAMIC_PRESSURE = Port(0.0, unit="Pa", description="of the standard atmosphere at rest")
ERROR_LIMIT = Port(math.pi, unit="rad", description="largest error of bank that the regulator acts on")
JET_FACTOR = Port([1.0] * 6, unit="1", description="on the torque of each jet")
TARGET_BANK = Port(deg(60.0), unit="rad", description="target")
WIND = Port([0.0, 0.0, 0.0], unit="m/s", frame="velocity", description="of the air over the turning Earth")


class BankReference(Bundle):
    """Bank angle to follow."""

    bank = Port(deg(60.0), unit="rad", description="bank to be at now")
    bank_rate = Port(0.0, unit="rad/s", description="its rate")
    bank_acceleration = Port(0.0, unit="rad/s2", description="its second derivative")
