"""Settings of the plant spacecraft that several cases have."""

from crosscheck.space.surroundings import EPOCH, TT_MINUS_UT1

GRAVITY_ALONE = {
    "epoch": EPOCH,
    "tt_minus_ut1": TT_MINUS_UT1,
    "atmosphere": 0,
    "residual_dipole": [0.0, 0.0, 0.0],
}
