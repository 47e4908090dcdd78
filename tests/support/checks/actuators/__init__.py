"""Truths of actuators: optimisation and linear algebra. Direct outputs follow one row later."""

from tests.support.checks.actuators import engine, gyros, jets, pulses, quantised_jets

TRUTHS = {**engine.TRUTHS, **gyros.TRUTHS, **jets.TRUTHS, **pulses.TRUTHS, **quantised_jets.TRUTHS}
