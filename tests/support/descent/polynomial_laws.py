"""Descent by a thrust acceleration that is a sum of powers of the time to go, independent of the blocks.

The profile a_f + d1 s^gamma + d2 s^gamma_2, s the fraction of the time to go, is the solution of the two boundary
conditions by `numpy.linalg.solve`; positions are double integrals of its powers; times to go are searched as described
for the blocks, by a grid and golden section over numpy arrays.
"""

from dataclasses import dataclass

import numpy as np

MU, RADIUS = 4.9028e12, 1.7374e6
EXHAUST = 319.0 * 9.80665
UP = np.array([0.0, 0.0, 1.0])
NODES = np.linspace(1.0, 0.0, 33)
GOLDEN = (np.sqrt(5.0) - 1.0) / 2.0


def central(position):
    """Return gravity (m/s2) of the Moon, whose centre is straight below the origin."""
    from_centre = np.asarray(position) + RADIUS * UP
    return -MU * from_centre / np.linalg.norm(from_centre) ** 3


@dataclass(frozen=True)
class Leg:
    """From a position and velocity to rest at a target; ``round_moon``: central gravity, linear in time on the way."""

    position: np.ndarray
    velocity: np.ndarray
    target: np.ndarray
    gravity: float = 1.624219
    round_moon: bool = True

    def errors(self, time):
        """Return position and velocity to gain in constant gravity."""
        way, gain = self.target - self.position, -np.asarray(self.velocity)
        if self.round_moon:
            here, there = central(self.position), central(self.target)
            way = way - time**2 * (here / 3.0 + there / 6.0 + 0.5 * self.gravity * UP)
            gain = gain - time * ((here + there) / 2.0 + self.gravity * UP)
        return way, gain

    def profile(self, time, gamma, kr, final):
        """Return coefficients (2, 3) of both powers, and the exponents."""
        way, gain = self.errors(time)
        powers = np.array([gamma, kr / (gamma + 2.0) - 2.0])
        constant = np.asarray(final) - self.gravity * UP
        # integrals over the time to go: of s^n, and of (1 - 1 + s) s^n, which is how far a push is from the end
        matrix = np.array([1.0 / (powers + 1.0), 1.0 / (powers + 2.0)])
        sides = np.array([gain / time - constant, (way - time * self.velocity) / time**2 - constant / 2.0])
        return np.linalg.solve(matrix, sides), powers

    def thrust(self, time, shape, s):
        """Return thrust acceleration at fractions s (n,) of the time to go, (n, 3)."""
        coefficients, powers = self.profile(time, *shape)
        s = np.atleast_1d(s)[:, None]
        return np.asarray(shape[2]) + s ** powers[0] * coefficients[0] + s ** powers[1] * coefficients[1]

    def offsets(self, time, shape, s):
        """Return positions from the target at fractions s (n,), in constant gravity, of an arrival at rest there."""
        coefficients, powers = self.profile(time, *shape)
        arrival = self.velocity + self.errors(time)[1]
        s = s[:, None]
        total = (np.asarray(shape[2]) - self.gravity * UP) * s**2 / 2.0
        for power, coefficient in zip(powers, coefficients, strict=True):
            total = total + coefficient * s ** (power + 2.0) / ((power + 1.0) * (power + 2.0))
        return time**2 * total - s * time * arrival


@dataclass(frozen=True)
class Limits:
    """Limits of engine and approach; angles in rad."""

    mass: float
    maximum: float = 5099.0
    minimum: float = 510.0
    glide_slope: float = 0.0
    largest_tilt: float = np.pi

    def measure(self, leg, time, shape):
        """Return impulse (m/s), largest thrust over the maximum, depth below the glide slope (m), excess of cosines."""
        thrust = leg.thrust(time, shape, NODES)
        size = np.linalg.norm(thrust, axis=1)
        spent = np.concatenate([[0.0], np.cumsum((size[1:] + size[:-1]) / 2.0) * time / 32.0])
        load = np.max(size * self.mass * np.exp(-spent / EXHAUST)) / self.maximum
        depth = 0.0
        if self.glide_slope > 0.0:
            away = leg.offsets(time, shape, NODES)
            cone = np.tan(self.glide_slope) * np.hypot(away[:, 0], away[:, 1]) - 5.0
            depth = max(0.0, np.max(cone - away[:, 2]))
        tilt = max(0.0, np.max(np.cos(self.largest_tilt) - thrust[:, 2] / size)) if self.largest_tilt < np.pi else 0.0
        return spent[-1], load, depth, tilt

    def price(self, leg, time, shape, constrained):
        impulse, load, depth, tilt = self.measure(leg, time, shape)
        price = impulse + 2000.0 * max(0.0, load / 0.92 - 1.0)
        return price + 2.0 * depth + 500.0 * tilt if constrained else price

    def best_time(self, leg, first, shape, constrained=False, shortest=0.6, spacing=0.05):
        """Return time of the smallest price: 25 multiples of the first one, then golden section between its
        neighbours."""
        trials = first * (shortest + spacing * np.arange(25))
        middle = trials[np.argmin([self.price(leg, time, shape, constrained) for time in trials])]
        low, high = middle - spacing * first, middle + spacing * first
        for _ in range(12):
            left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
            if self.price(leg, left, shape, constrained) < self.price(leg, right, shape, constrained):
                high = right
            else:
                low = left
        return (low + high) / 2.0

    def broken(self, leg, time, shape):
        """Sum of 1 (thrust), 2 (glide slope), 4 (tilt) of what a profile leaves."""
        impulse, load, depth, tilt = self.measure(leg, time, shape)
        return (load > 1.0 or impulse * self.mass < self.minimum * time) + 2 * (depth > 1.0) + 4 * (tilt > 0.0)
