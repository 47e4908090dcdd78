"""Vectors of inertial axes."""

from ...ports import Port

ACCELERATION = Port([0.0, 0.0, 0.0], unit="m/s2", frame="inertial", description="acceleration")
FORCE = Port([0.0, 0.0, 0.0], unit="N", frame="inertial", description="commanded force")
POSITION = Port([0.0, 0.0, 0.0], unit="m", frame="inertial", description="position")
VELOCITY = Port([0.0, 0.0, 0.0], unit="m/s", frame="inertial", description="velocity")
