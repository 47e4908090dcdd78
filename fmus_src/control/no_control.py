"""No torque."""

from ..interfaces.entry_control import EntryControl
from ..mathlib.vectors import Vector3, vector


class NoControl(EntryControl):
    """Asks for nothing: what the capsule's own stability holds."""

    def regulate(self) -> Vector3:
        return vector(0.0, 0.0, 0.0)
