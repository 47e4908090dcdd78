"""Truths of plants: closed forms, and scipy's DOP853 on independently written equations."""

from tests.support.checks.plants import attitude_lander, bodies, landers, spacecraft, wheels

TRUTHS = {**attitude_lander.TRUTHS, **bodies.TRUTHS, **landers.TRUTHS, **spacecraft.TRUTHS, **wheels.TRUTHS}
