"""Exit statuses, for the commands that are not verbs yet."""

from ...common.exit_status import ExitStatus, exit_status

__all__ = ["ExitStatus", "exit_status"]
