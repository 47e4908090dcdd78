"""Convex problem of a powered descent, and the layout of its data in flat lists. Kernel functions.

The time of flight T is divided into INTERVALS intervals of h = T/INTERVALS, with constant thrust acceleration u of
magnitude |u| <= s. The state of a node is position and velocity relative to the target's position and z, the logarithm
of mass over present mass:

    r+ = r + h v + h^2/2 u + h^2 (g/3 + g+/6),  v+ = v + h u + h/2 (g + g+),  z+ = z - h s/v_e.

The objective is the sum of h s plus WEIGHT times the bounds on the misses of position and velocity, which make the
problem feasible for every time and are 0 if the target can be reached (exact penalty). The slacks of the cones are

    thrust (4 rows)   s, u
    upper, lower      upper limit (1 - y) - s,  s - lower limit (1 - y),  with y = (z + z+)/2 - middle
    tilt              u_z - s cos(largest tilt)
    glide (3 rows)    r_z + depth, tan(glide slope) (r_x, r_y)
    ends (4 rows)     bound, r_N;  bound, v_N - v_T

The limits are the least and largest thrust, divided by the mass that the expansion has in the middle of an interval.
Lengths are scaled by the distance from the target, accelerations by the largest thrust over mass, times by the square
root of their quotient.

Source: Acikmese and Ploen 2007, "Convex programming approach to powered descent guidance for Mars landing"; Blackmore,
Acikmese and Scharf 2010, for the least miss.
"""

from ....kernel.records import Field, Record
from ...vectors import Vector3, vector

INTERVALS = 24
NODES = 25

# A point, and a direction: controls (s, u) of the intervals, states (r, v, z) of the nodes, bounds on both misses.
CONTROL = 4
STATE = 7
STATES = 96
MISSES = 271
POINT = 273
COSTATES = 175

# Rows of the slacks of an interval and of the two ends.
STAGE = 10
UPPER = 4
LOWER = 5
TILT = 6
GLIDE = 7
END_POSITION = 240
END_VELOCITY = 244
ROWS = 248
KINDS = 5  # kinds of cones in an interval
LARGER = 5  # a number larger than the rows of any cone
CONES = 122

# Expansion of a problem: gravity at the nodes, log mass and thrust limits of the intervals.
MIDDLE = 75
LOWER_LIMIT = 99
UPPER_LIMIT = 123
EXPANSION = 147

WEIGHT = 30.0  # weight of the misses


class DescentProblem(Record):
    """Data of a convex problem, scaled, and the units of the scaling."""

    step = Field(unit="1", description="duration h of an interval")
    exhaust = Field(unit="1", description="exhaust speed v_e")
    position = Field(Vector3, unit="1", description="current position relative to the target")
    velocity = Field(Vector3, unit="1", description="current velocity")
    arrival = Field(Vector3, unit="1", description="target velocity")
    tilted = Field(bool, description="true: tilt of the thrust limited")
    upright = Field(unit="1", description="cosine of the largest tilt")
    sloped = Field(bool, description="true: glide slope constrained")
    slope = Field(unit="1", description="tangent of the glide slope")
    depth = Field(unit="1", description="depth of the glide-slope cone's apex below the target")
    length = Field(unit="m", description="unit of length")
    acceleration = Field(unit="m/s2", description="unit of acceleration")
    time = Field(unit="s", description="unit of time")


# Callers reduce the row modulo ROWS and the size modulo LARGER, which proves every index valid.
def cone_row(j: int) -> int:
    """Return the first row of cone ``j``."""
    first = STAGE * (j // KINDS)
    kind = j % KINDS
    if j // KINDS == INTERVALS:
        return first + CONTROL * kind
    if kind == 0:
        return first
    return first + CONTROL - 1 + kind


def cone_size(p: DescentProblem, j: int) -> int:
    """Return the number of rows of cone ``j``; 0 if the problem does not have it."""
    kind = j % KINDS
    if kind == 0 or j // KINDS == INTERVALS:
        return CONTROL
    if kind == 3 and not p.tilted:
        return 0
    if kind < 4:
        return 1
    if p.sloped and j >= KINDS:
        return 3
    return 0


def count_cones(p: DescentProblem) -> float:
    """Return the number of cones, the degree of complementarity."""
    count = 0
    for j in range(CONES):
        if cone_size(p, j) > 0:
            count = count + 1
    return float(count)


def gravity_at(expansion: list, k: int) -> Vector3:
    """Return the scaled gravity at node ``k``."""
    return vector(expansion[3 * k], expansion[3 * k + 1], expansion[3 * k + 2])


def roll_out(p: DescentProblem, expansion: list, k: int, point: list) -> None:
    """Set the state of node ``k`` + 1 from the state of node ``k`` and the control of the interval between them."""
    h = p.step
    now = gravity_at(expansion, k)
    then = gravity_at(expansion, k + 1)
    at = STATES + STATE * k
    for i in range(3):
        u = point[CONTROL * k + 1 + i]
        v = point[at + 3 + i]
        position = point[at + i] + h * v + 0.5 * h * h * u + h * h * (now[i] / 3.0 + then[i] / 6.0)
        point[at + STATE + i] = position
        point[at + STATE + 3 + i] = v + h * u + 0.5 * h * (now[i] + then[i])
    point[at + STATE + 6] = point[at + 6] - h / p.exhaust * point[CONTROL * k]


def set_rows(p: DescentProblem, expansion: list, x: list, affine: float, c: list, field: int) -> None:
    """Set the rows of ``c`` from ``field`` on: slacks of the point x for ``affine`` = 1, their linear terms for 0."""
    half = 0.5 * p.step / p.exhaust
    for k in range(INTERVALS):
        at = field + STAGE * k
        size = x[CONTROL * k]
        for i in range(CONTROL):
            c[at + i] = x[CONTROL * k + i]
        ratio = affine * (1.0 + expansion[MIDDLE + k]) - x[STATES + STATE * k + 6] + half * size
        c[at + UPPER] = expansion[UPPER_LIMIT + k] * ratio - size
        c[at + LOWER] = size - expansion[LOWER_LIMIT + k] * ratio
        c[at + TILT] = x[CONTROL * k + 3] - p.upright * size
        c[at + GLIDE] = x[STATES + STATE * k + 2] + affine * p.depth
        c[at + GLIDE + 1] = p.slope * x[STATES + STATE * k]
        c[at + GLIDE + 2] = p.slope * x[STATES + STATE * k + 1]
    last = STATES + STATE * INTERVALS
    c[field + END_POSITION] = x[MISSES]
    c[field + END_VELOCITY] = x[MISSES + 1]
    for i in range(3):
        c[field + END_POSITION + 1 + i] = x[last + i]
        c[field + END_VELOCITY + 1 + i] = x[last + 3 + i] - affine * p.arrival[i]


def set_gradient(p: DescentProblem, expansion: list, c: list, field: int, weight: float, gradient: list) -> None:
    """Set ``gradient`` (as a point) for the objective times ``weight`` minus the slacks times the rows of ``field``."""
    half = 0.5 * p.step / p.exhaust
    for k in range(INTERVALS):
        at = field + STAGE * k
        state = STATES + STATE * k
        upper = c[at + UPPER]
        lower = c[at + LOWER]
        upper_limit = expansion[UPPER_LIMIT + k]
        lower_limit = expansion[LOWER_LIMIT + k]
        total = c[at] + (upper_limit * half - 1.0) * upper + (1.0 - lower_limit * half) * lower
        for i in range(1, CONTROL):
            gradient[CONTROL * k + i] = -c[at + i]
        for i in range(6):
            gradient[state + i] = 0.0
        gradient[state + 6] = upper_limit * upper - lower_limit * lower
        if p.tilted:
            total = total - p.upright * c[at + TILT]
            gradient[CONTROL * k + 3] = gradient[CONTROL * k + 3] - c[at + TILT]
        if p.sloped and k > 0:
            gradient[state] = -p.slope * c[at + GLIDE + 1]
            gradient[state + 1] = -p.slope * c[at + GLIDE + 2]
            gradient[state + 2] = -c[at + GLIDE]
        gradient[CONTROL * k] = weight * p.step - total
    last = STATES + STATE * INTERVALS
    for i in range(3):
        gradient[last + i] = -c[field + END_POSITION + 1 + i]
        gradient[last + 3 + i] = -c[field + END_VELOCITY + 1 + i]
    gradient[last + 6] = 0.0
    gradient[MISSES] = weight * WEIGHT - c[field + END_POSITION]
    gradient[MISSES + 1] = weight * WEIGHT - c[field + END_VELOCITY]
