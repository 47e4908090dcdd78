"""Spherical harmonics in Basilisk, of coefficients that our side hands over. Runs in Basilisk's environment."""

from Basilisk.simulation import sphericalHarmonicsGravityModel


def harmonics(normalised: list[float], mu: float, radius: float, degree: int) -> object:
    """Return the model of gravity: C, S of orders 0 to n for each degree n from 2 on; mu in m3/s2, radius in m."""
    c, s = [[1.0], [0.0, 0.0]], [[0.0], [0.0, 0.0]]
    pairs = iter(zip(normalised[0::2], normalised[1::2], strict=True))
    for n in range(2, degree + 1):
        row = [next(pairs) for _ in range(n + 1)]
        c.append([each for each, _ in row])
        s.append([each for _, each in row])
    model = sphericalHarmonicsGravityModel.SphericalHarmonicsGravityModel()
    model.cBar, model.sBar, model.maxDeg = c, s, degree
    model.muBody, model.radEquator = mu, radius
    return model
