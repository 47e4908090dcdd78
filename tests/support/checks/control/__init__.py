"""Truths of control blocks: their equations as matrices. Direct outputs follow one row later."""

from tests.support.checks.control import entry, magnetic, orbital, pointing, relays, robot, thrust_axis

MODULES = (entry, magnetic, orbital, pointing, relays, robot, thrust_axis)
TRUTHS = {name: truth for module in MODULES for name, truth in module.TRUTHS.items()}
