"""No torque."""

from ..mathlib.vectors import Vector3, vector
from .entry_control import EntryControl


class NoControl(EntryControl):
    """Asks for nothing: what the capsule's own stability holds."""

    def regulate(self) -> Vector3:
        return vector(0.0, 0.0, 0.0)
