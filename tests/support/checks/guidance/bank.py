"""Truth of the bank programme: closed forms."""

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from tests.support.checks.check import STEP, Check


def bank_programme():
    """Compute a reversal of bank with a coast: the rate is a trapezoid, the bank its integral."""
    target, reversal, largest, acceleration = 0.9, 1.3, 0.21, 0.07
    time = STEP * np.arange(129)
    gather = largest / acceleration
    end = 2.0 * target / largest
    corners = reversal + np.array([0.0, gather, end, end + gather])
    rates = np.array([0.0, -largest, -largest, 0.0])
    # pieces of second order: a cubic through both ends with both rates is exact
    banks = target - np.array([0.0, 0.5 * gather * largest, 2.0 * target - 0.5 * gather * largest, 2.0 * target])
    turning = (time >= reversal) & (time < corners[-1])
    bank = np.where(time < reversal, target, -target)
    bank[turning] = CubicHermiteSpline(corners, banks, rates)(time[turning])
    phase = np.searchsorted(corners, time, side="right")
    return Check(
        truth="trapezoid of the rate, integrated",
        step=STEP,
        inputs={},
        outputs={
            "target_bank": np.where(time < reversal, target, -target),
            "reference_bank": bank,
            "reference_bank_rate": np.interp(time, corners, rates),
            "reference_bank_acceleration": np.array([0.0, -acceleration, 0.0, acceleration, 0.0])[phase],
            "time_since_reversal": np.where(time < reversal, 1e9, time - reversal),
        },
        tolerances={
            "target_bank": (0.0, 0.0),
            "reference_bank": (1e-13, 0.0),
            "reference_bank_rate": (1e-13, 0.0),
            "reference_bank_acceleration": (0.0, 0.0),
            "time_since_reversal": (1e-13, 0.0),
        },
        parameters={
            "first_target": target,
            "reversal_times": [reversal, 1e9],
            "method": 2,
            "bank_rate": largest,
            "bank_acceleration": acceleration,
            "sample_period": STEP,
        },
    )


TRUTHS = {"bank_programme": bank_programme}
