"""Control without torque."""

from ..mathlib.vectors import Vector3, vector
from .entry_control import EntryControl


class NoControl(EntryControl):
    """Zero torque, which leaves the capsule to its aerodynamic stability."""

    def regulate(self) -> Vector3:
        return vector(0.0, 0.0, 0.0)
