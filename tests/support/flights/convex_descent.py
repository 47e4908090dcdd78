"""Powered descent of least propellant as a cone problem with equalities, solved by Clarabel.

Formulation and solver differ from the blocks: all states are unknowns, the end is met exactly, and equations that are
eliminated on board are equalities here. Adopted from the block: the intervals, and the expansion point of the first
problem.
"""

from dataclasses import dataclass, replace

import clarabel
import numpy as np
from scipy import sparse

INTERVALS = 24
EXHAUST_SPEED = 319.0 * 9.80665
MAXIMUM, MINIMUM = 5099.0, 510.0
MU, RADIUS = 4.9028e12, 1737400.0


def central(positions):
    """Return gravity (m/s2) of the Moon at rows of positions (m), landing-site frame."""
    from_centre = positions + np.array([0.0, 0.0, RADIUS])
    return -MU * from_centre / np.linalg.norm(from_centre, axis=1, keepdims=True) ** 3


@dataclass(frozen=True)
class Descent:
    """Start, target and limits, SI units; ``gravity`` of rows of positions."""

    position: np.ndarray
    velocity: np.ndarray
    mass: float
    target: np.ndarray
    maximum: float = MAXIMUM
    slope: float = 0.0
    depth: float = 5.0
    tilt: float = np.pi
    minimum: float = MINIMUM
    exhaust: float = EXHAUST_SPEED
    gravity: object = central


@dataclass(frozen=True)
class Path:
    """A solution: rows of nodes, and of intervals ``thrust`` acceleration (m/s2); the sum of its sizes (m/s)."""

    time: float
    position: np.ndarray
    velocity: np.ndarray
    log_mass: np.ndarray
    thrust: np.ndarray
    gravity: np.ndarray
    impulse: float


def seeds(descent, time):
    """Return positions on the straight line, and the logarithm of a mass that falls evenly."""
    fraction = np.linspace(0.0, 1.0, INTERVALS + 1)
    position = descent.position + fraction[:, None] * (descent.target - descent.position)
    burnt = min(0.75, 0.75 * descent.maximum / descent.mass * time / descent.exhaust)
    return position, np.log1p(-fraction * burnt)


def settle(descent, time, count):
    """Solve ``count`` problems, each expanded about the one before; None where the target is out of reach."""
    expansion = seeds(descent, time)
    path = None
    for _ in range(count):
        path = solve(descent, time, *expansion)
        if path is None:
            return None
        expansion = path.position, path.log_mass
    return path


def solve(descent, time, near, log_near):
    """Return the best path of a ``time`` (s), expanded about positions and log masses; None where there is no path."""
    n = INTERVALS
    acceleration = descent.maximum / descent.mass
    length = np.linalg.norm(descent.position - descent.target)
    second = np.sqrt(length / acceleration)
    speed = length / second
    h, exhaust = time / n / second, descent.exhaust / speed
    gravity = descent.gravity(near)
    field = gravity / acceleration
    total = 7 * (n + 1) + 4 * n
    eye = np.eye(total)
    state = [eye[7 * k : 7 * k + 7] for k in range(n + 1)]
    control = [eye[7 * (n + 1) + 4 * k : 7 * (n + 1) + 4 * k + 4] for k in range(n)]  # u, s
    rows, right, kinds = [], [], []

    def demand(matrix, bound, kind):
        """Bound - matrix x in a cone."""
        rows.append(matrix)
        right.append(np.atleast_1d(bound))
        kinds.append(kind)

    start = np.concatenate([(descent.position - descent.target) / length, descent.velocity / speed, [0.0]])
    demand(state[0], start, clarabel.ZeroConeT(7))
    demand(state[n][:6], np.zeros(6), clarabel.ZeroConeT(6))
    for k in range(n):
        here, there, u, s = state[k], state[k + 1], control[k][:3], control[k][3:]
        way = there[:3] - here[:3] - h * here[3:6] - 0.5 * h**2 * u
        demand(way, h**2 * (field[k] / 3.0 + field[k + 1] / 6.0), clarabel.ZeroConeT(3))
        demand(there[3:6] - here[3:6] - h * u, 0.5 * h * (field[k] + field[k + 1]), clarabel.ZeroConeT(3))
        demand(there[6:] - here[6:] + h / exhaust * s, 0.0, clarabel.ZeroConeT(1))
        demand(-np.vstack([s, u]), np.zeros(4), clarabel.SecondOrderConeT(4))
        middle = 0.5 * (log_near[k] + log_near[k + 1])
        mean = 0.5 * (here[6:] + there[6:])
        upper, lower = np.exp(-middle), descent.minimum / descent.maximum * np.exp(-middle)
        demand(s + upper * mean, upper * (1.0 + middle), clarabel.NonnegativeConeT(1))
        demand(-s - lower * mean, -lower * (1.0 + middle), clarabel.NonnegativeConeT(1))
        if descent.tilt < np.pi:
            demand(np.cos(descent.tilt) * s - u[2:], 0.0, clarabel.NonnegativeConeT(1))
        if descent.slope > 0.0 and k > 0:
            cone = np.vstack([here[2:3], np.tan(descent.slope) * here[:2]])
            demand(-cone, np.array([descent.depth / length, 0.0, 0.0]), clarabel.SecondOrderConeT(3))
    cost = np.zeros(total)
    cost[7 * (n + 1) + 3 :: 4] = h
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.tol_feas = settings.tol_gap_abs = settings.tol_gap_rel = 1e-10
    matrix = sparse.csc_matrix(np.vstack(rows))
    empty = sparse.csc_matrix((total, total))
    solution = clarabel.DefaultSolver(empty, cost, matrix, np.concatenate(right), kinds, settings).solve()
    if str(solution.status) not in ("Solved", "AlmostSolved"):
        return None
    x = np.array(solution.x)
    states, controls = x[: 7 * (n + 1)].reshape(-1, 7), x[7 * (n + 1) :].reshape(-1, 4)
    return Path(
        time=time,
        position=descent.target + length * states[:, :3],
        velocity=speed * states[:, 3:6],
        log_mass=states[:, 6],
        thrust=acceleration * controls[:, :3],
        gravity=gravity,
        impulse=speed * h * controls[:, 3].sum(),
    )


C1 = Descent(
    position=np.array([100548.8128555642, 0.0, 7605.543324529426]),
    velocity=np.array([-949.9869131254377, 0.0, 4.98647073610168]),
    mass=940.0,
    target=np.array([0.0, 0.0, 1500.0]),
)
C2 = replace(
    C1,
    position=np.array([266731.0182801091, 0.0, -2233.3382089037914]),
    velocity=np.array([-1676.17261973568, 0.0, 207.76512904822894]),
)
A1 = Descent(
    position=np.array([1200.0, -900.0, 1900.0]),
    velocity=np.array([-45.0, 30.0, -30.0]),
    mass=560.0,
    target=np.array([0.0, 0.0, 100.0]),
    slope=np.radians(15.0),
    tilt=np.radians(60.0),
)


def approach(random):
    """Draw a start near the ground: 0.5 to 2.5 km away, 1.4 to 2.4 km above, towards the target and sinking."""
    azimuth, ground = random.uniform(-np.pi, np.pi), random.uniform(500.0, 2500.0)
    heading = azimuth + np.pi + random.uniform(-0.35, 0.35)
    speed = random.uniform(20.0, 80.0)
    position = np.array([ground * np.cos(azimuth), ground * np.sin(azimuth), random.uniform(1500.0, 2500.0)])
    velocity = np.array([speed * np.cos(heading), speed * np.sin(heading), -random.uniform(10.0, 50.0)])
    return replace(A1, position=position, velocity=velocity)
