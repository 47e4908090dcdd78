"""No torque."""

from ..interfaces.entry_control import EntryControl


class NoControl(EntryControl):
    """Asks for nothing: what the capsule's own stability holds."""
