"""Ports in inertial axes."""

from ...ports import Port

ACCELERATION = Port(
    [0.0, 0.0, 0.0], unit="m/s2", frame="inertial", description="acceleration relative to the inertial frame"
)
FORCE = Port([0.0, 0.0, 0.0], unit="N", frame="inertial", description="commanded force of the jets")
POSITION = Port([0.0, 0.0, 0.0], unit="m", frame="inertial", description="position")
VELOCITY = Port([0.0, 0.0, 0.0], unit="m/s", frame="inertial", description="velocity")
