"""Truths of sensors: their errors as declared, from MRG32k3a in exact integers."""

from tests.support.checks.sensors import lunar, relative, satellite

TRUTHS = {**lunar.TRUTHS, **relative.TRUTHS, **satellite.TRUTHS}
