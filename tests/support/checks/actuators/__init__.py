"""Truths of actuators: optimisation and linear algebra. Direct outputs follow one row later."""

from tests.support.checks.actuators import engine, gyros, jets, pulses, quantised_jets, wheels

MODULES = (engine, gyros, jets, pulses, quantised_jets, wheels)
TRUTHS = {name: truth for module in MODULES for name, truth in module.TRUTHS.items()}
