"""Eight jets at the corners of a box: forces and torques, and allocation of a wrench. Kernel functions.

Jet p is at rho_p = S_p (bx, by, bz) and its nozzle points along e_p = S_p (ca cb, ca sb, sa), where S_p are the signs
of its corner and c and s the cosine and sine of tilt a and azimuth b; a thrust p_p >= 0 gives the force -p_p e_p and
the torque -p_p rho_p x e_p. So [P; M] = B p, where each row of B is a strength times one of the rows of signs X, Y, Z,
YZ, ZX and XY. The rows are orthogonal, so the columns of the pseudo-inverse are signs'/(8 strength), and the row of
ones and XYZ span the null space. Derivations: docs/systems/robot_rendezvous.md.

Source: Somov, Butyrin, Somov and Somova (docs/systems/robot_rendezvous.md), whose D p = t has the opposite sign.
"""

import math

from ...kernel.functions import cos, sin
from ...kernel.records import Field, Record
from ..vectors import Vector3, cross, vector

JETS = 8
NEGLIGIBLE = 1e-12  # fraction of the largest strength; smaller ones count as 0

# Signs of corners 1 to 8: of forces, of torques, and of all three axes, which give no wrench.
X = (1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0)
Y = (1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0)
Z = (1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0)
YZ = (1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0, 1.0)
ZX = (1.0, -1.0, 1.0, -1.0, -1.0, 1.0, -1.0, 1.0)
XY = (1.0, 1.0, -1.0, -1.0, -1.0, -1.0, 1.0, 1.0)
XYZ = (1.0, -1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0)


class Wrench(Record):
    """Force and torque on the body."""

    force = Field(Vector3, unit="N", frame="body", description="force on the body")
    torque = Field(Vector3, unit="N.m", frame="body", description="torque on the body")


class JetStrength(Record):
    """Force along, and torque about, each axis per unit of thrust of a jet, with the sign of the first jet.

    A component of 0 means that the jets cannot give this force or torque.
    """

    force = Field(
        Vector3,
        unit="1",
        frame="body",
        description="force along each axis per newton of signed jet thrust (sum with the signs of that axis)",
    )
    torque = Field(
        Vector3,
        unit="m",
        frame="body",
        description="torque about each axis per newton of signed jet thrust (sum with the signs of that axis)",
    )


def jet_strength(tilt: float, azimuth: float, arm: Vector3) -> JetStrength:
    """Return the strength of jets with tilt and azimuth (rad) and the first jet at ``arm`` (m, body)."""
    axis = vector(cos(tilt) * cos(azimuth), cos(tilt) * sin(azimuth), sin(tilt))
    reach = abs(arm.x) + abs(arm.y) + abs(arm.z)
    return JetStrength(
        force=without_negligible(-axis, NEGLIGIBLE),
        torque=without_negligible(-cross(arm, axis), NEGLIGIBLE * reach),
    )


def without_negligible(v: Vector3, limit: float) -> Vector3:
    """Return the vector with components smaller than ``limit`` replaced by 0."""
    return vector(
        0.0 if abs(v.x) < limit else v.x,
        0.0 if abs(v.y) < limit else v.y,
        0.0 if abs(v.z) < limit else v.z,
    )


def signed_sum(signs: tuple, thrust: list) -> float:
    """Return the sum of the thrusts, each multiplied by its sign in a row of signs."""
    total = 0.0
    for p in range(JETS):
        total = total + signs[p] * thrust[p]
    return total


def jet_wrench(strength: JetStrength, thrust: list) -> Wrench:
    """Return the wrench B thrust (N, N m, body) of the jets."""
    return Wrench(
        force=strength.force * vector(signed_sum(X, thrust), signed_sum(Y, thrust), signed_sum(Z, thrust)),
        torque=strength.torque * vector(signed_sum(YZ, thrust), signed_sum(ZX, thrust), signed_sum(XY, thrust)),
    )


def add_component(signs: tuple, strength: float, demand: float, thrust: list) -> bool:
    """Add to ``thrust`` the share that gives a force or torque along one axis; return True if the jets can give it."""
    if strength == 0.0:
        return demand == 0.0
    fraction = demand / (8.0 * strength)
    for p in range(JETS):
        thrust[p] = thrust[p] + signs[p] * fraction
    return True


def pseudo_inverse(strength: JetStrength, demand: Wrench, thrust: list) -> bool:
    """Set thrust to the minimum-norm solution of B thrust = demand, which may be negative.

    Returns True if the jets can give the wrench; a component that they cannot give is omitted.
    """
    for p in range(JETS):
        thrust[p] = 0.0
    fx = add_component(X, strength.force.x, demand.force.x, thrust)
    fy = add_component(Y, strength.force.y, demand.force.y, thrust)
    fz = add_component(Z, strength.force.z, demand.force.z, thrust)
    mx = add_component(YZ, strength.torque.x, demand.torque.x, thrust)
    my = add_component(ZX, strength.torque.y, demand.torque.y, thrust)
    mz = add_component(XY, strength.torque.z, demand.torque.z, thrust)
    return fx and fy and fz and mx and my and mz


def shift_and_scale(thrust: list, maximum: float) -> float:
    """Raise the thrusts of a pseudo-inverse until the least is 0, then scale all so that none exceeds ``maximum``.

    Returns the scale, 1 without scaling. Equal thrusts give no wrench, so the resulting wrench is the original wrench
    times the scale. This is the rule of the paper.
    """
    minimum = thrust[0]
    largest = thrust[0]
    for p in range(1, JETS):
        if thrust[p] < minimum:
            minimum = thrust[p]
        if thrust[p] > largest:
            largest = thrust[p]
    scale = 1.0
    if largest - minimum > maximum:
        scale = maximum / (largest - minimum)
    for p in range(JETS):
        thrust[p] = scale * (thrust[p] - minimum)
        if thrust[p] > maximum:
            thrust[p] = maximum  # exceeded by a rounding error
    return scale


def least_propellant(thrust: list, maximum: float) -> float:
    """Change the thrusts of a pseudo-inverse to the least sum for the same wrench, with 0 to ``maximum`` each.

    For opposite corners i and 9 - i let s = p_i + p_(9-i), d = p_i - p_(9-i) and u = n d, with the signs n of the
    second null vector. A shift S of all s and l of all u gives no wrench; thrusts are not negative if |u + l| <= s + S.
    The best S for an l is max(A + l, Q - l) with A = max(u - s) and Q = max(-u - s). The sum of thrusts is 4 S, and it
    is least at l = (Q - A)/2. The largest thrust is then max(A + D, Q + C)/2 with C = max(u + s) and D = max(s - u),
    and no other l and S make it smaller, so the optimum without a maximum respects the maximum whenever this is
    possible. Otherwise the wrench is scaled. Returns the scale, 1 without scaling.
    """
    a = -math.inf
    q = -math.inf
    c = -math.inf
    d = -math.inf
    for i in range(4):
        s = thrust[i] + thrust[7 - i]
        u = XYZ[i] * (thrust[i] - thrust[7 - i])
        if u - s > a:
            a = u - s
        if -u - s > q:
            q = -u - s
        if u + s > c:
            c = u + s
        if s - u > d:
            d = s - u
    largest = 0.5 * (a + d)
    if 0.5 * (q + c) > largest:
        largest = 0.5 * (q + c)
    scale = 1.0
    if largest > maximum:
        scale = maximum / largest
    lift = 0.5 * (a + q)
    shift = 0.5 * (q - a)
    for i in range(4):
        s = thrust[i] + thrust[7 - i] + lift
        difference = thrust[i] - thrust[7 - i] + XYZ[i] * shift
        thrust[i] = within(scale * 0.5 * (s + difference), maximum)
        thrust[7 - i] = within(scale * 0.5 * (s - difference), maximum)
    return scale


def within(thrust: float, maximum: float) -> float:
    """Return the thrust limited to the range from 0 to ``maximum``, which rounding errors may exceed."""
    if not thrust > 0.0:
        return 0.0
    if thrust > maximum:
        return maximum
    return thrust


def nearest_levels(strength: Vector3, force: Vector3, quantum: float, highest: float) -> tuple[Vector3, float]:
    """Return the attainable lattice point (integers n) nearest to a force (N) without torque, and a scale.

    A lattice point is the force 2 quantum strength[i] n[i] with integers n all even or all odd; it is attainable with
    thrusts of at most ``highest`` quanta if |n_i| + |n_j| <= 2 highest for every pair of axes. A force beyond this
    limit is first multiplied by the scale, which is otherwise 1.
    """
    exact = [0.0] * 3
    trial = [0.0] * 3
    levels = vector(0.0, 0.0, 0.0)
    sizes = 0.0
    smallest = math.inf
    for i in range(3):
        if strength[i] != 0.0:
            exact[i] = force[i] / (2.0 * quantum * strength[i])
        sizes = sizes + abs(exact[i])
        if abs(exact[i]) < smallest:
            smallest = abs(exact[i])
    scale = 1.0
    if sizes - smallest > 2.0 * highest:
        scale = 2.0 * highest / (sizes - smallest)
    best = math.inf
    for candidate in range(16):
        # on each axis the even or odd level below or above
        odd = float(candidate % 2)
        above = candidate // 2
        cost = 0.0
        minimum = math.inf
        total = 0.0
        for i in range(3):
            level = scale * exact[i]
            trial[i] = 2.0 * float(math.floor(0.5 * (level - odd))) + odd + 2.0 * float(above % 2)
            above = above // 2
            miss = strength[i] * (trial[i] - level)
            cost = cost + miss * miss
            total = total + abs(trial[i])
            if abs(trial[i]) < minimum:
                minimum = abs(trial[i])
        if total - minimum <= 2.0 * highest and cost < best:
            best = cost
            levels = vector(*trial)
    return levels, scale


def thrust_of_levels(levels: Vector3, quantum: float, thrust: list) -> None:
    """Set ``thrust`` (N) to the solution of least propellant for a lattice point, in whole quanta."""
    largest = -math.inf
    minimum = math.inf
    u = [0.0] * 4
    for i in range(4):
        u[i] = 0.5 * XYZ[i] * (X[i] * levels.x + Y[i] * levels.y + Z[i] * levels.z)
        if u[i] > largest:
            largest = u[i]
        if u[i] < minimum:
            minimum = u[i]
    lift = 0.5 * (largest - minimum)
    for i in range(4):
        d = XYZ[i] * (u[i] - 0.5 * (largest + minimum))
        thrust[i] = quantum * (0.5 * (lift + d))
        thrust[7 - i] = quantum * (0.5 * (lift - d))
