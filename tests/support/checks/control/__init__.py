"""Truths of regulators: their equations as matrices. Direct outputs follow one row later."""

from tests.support.checks.control import entry, orbital, relays, robot, thrust_axis

TRUTHS = {**entry.TRUTHS, **orbital.TRUTHS, **relays.TRUTHS, **robot.TRUTHS, **thrust_axis.TRUTHS}
