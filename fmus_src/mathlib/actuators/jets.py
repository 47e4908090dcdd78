"""Eight jets at the corners of a box: their forces and torques, and how to share a wrench among them. Kernel functions.

Jet p stands at rho_p = S_p (bx, by, bz), its nozzle points along e_p = S_p (ca cb, ca sb, sa), with the
signs S_p of its corner, a the tilt and b the azimuth; a thrust p_p >= 0 gives the force -p_p e_p and the
torque -p_p rho_p x e_p. So [P; M] = B p, and row k of B is strength[k] times row k of WALSH: the rows are
orthogonal, which makes the pseudo-inverse WALSH'/(8 strength) and the null space the two rows left over.
Wrenches are [force (N), torque (N.m)] in body axes. Derivations: docs/systems/robot_rendezvous.md.
Source: Somov, Butyrin, Somov and Somova (docs/systems/robot_rendezvous.md), whose D p = t has the opposite sign.
"""

import math

from ...kernel.functions import cos, sin
from ..vectors import Vector3, vector

JETS = 8
NEGLIGIBLE = 1e-12  # of the strongest: a strength below it counts as none

# Signs of corners 1 to 8: x, y, z; then yz, zx, xy of the torques; then 1 and xyz, which give no wrench.
WALSH = (
    *(1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0),
    *(1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0),
    *(1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0),
    *(1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0, 1.0),
    *(1.0, -1.0, 1.0, -1.0, -1.0, 1.0, -1.0, 1.0),
    *(1.0, 1.0, -1.0, -1.0, -1.0, -1.0, 1.0, 1.0),
    *(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0),
    *(1.0, -1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0),
)


def jet_strengths(tilt: float, azimuth: float, arm: Vector3, strength: list) -> None:
    """strength[6] = what 1 N with the signs of a row of WALSH gives: force (-) and torque (m), per jet.

    Angles in rad, arm = (bx, by, bz) in m. What a geometry cannot give is 0.
    """
    x = cos(tilt) * cos(azimuth)
    y = cos(tilt) * sin(azimuth)
    z = sin(tilt)
    strength[0] = -x
    strength[1] = -y
    strength[2] = -z
    strength[3] = -(arm.y * z - arm.z * y)
    strength[4] = -(arm.z * x - arm.x * z)
    strength[5] = -(arm.x * y - arm.y * x)
    reach = abs(arm.x) + abs(arm.y) + abs(arm.z)
    for k in range(3):
        if abs(strength[k]) < NEGLIGIBLE:
            strength[k] = 0.0
        if abs(strength[k + 3]) < NEGLIGIBLE * reach:
            strength[k + 3] = 0.0


def jet_wrench(strength: list, thrust: list, wrench: list) -> None:
    """wrench = B thrust."""
    for k in range(6):
        total = 0.0
        for p in range(JETS):
            total = total + WALSH[JETS * k + p] * thrust[p]
        wrench[k] = strength[k] * total


def pseudo_inverse(strength: list, wrench: list, thrust: list) -> bool:
    """thrust = the shortest solution of B thrust = wrench, negative thrusts included.

    Returns whether the geometry can give the wrench; a component that it cannot give is left out.
    """
    possible = True
    for p in range(JETS):
        thrust[p] = 0.0
    for k in range(6):
        if strength[k] != 0.0:
            fraction = wrench[k] / (8.0 * strength[k])
            for p in range(JETS):
                thrust[p] = thrust[p] + WALSH[JETS * k + p] * fraction
        elif wrench[k] != 0.0:
            possible = False
    return possible


def shift_and_scale(thrust: list, maximum: float) -> float:
    """The rule of the paper: lift a pseudo-inverse's thrusts until the least is 0, scale by maximum/largest where due.

    Returns the scale, 1 where nothing had to be scaled. Equal thrusts give no wrench, so what comes out
    is the scale times the wrench that went in.
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
            thrust[p] = maximum  # by a rounding error
    return scale


def least_propellant(thrust: list, maximum: float) -> float:
    """Change a pseudo-inverse's thrusts into those of the least sum within 0 to maximum, for the same wrench.

    Opposite corners i and 9 - i: s = p_i + p_(9-i) and d = p_i - p_(9-i), with n the signs of the second
    null vector and u = n d. A shift S of all s and l of all u gives no wrench; thrusts are not negative
    where |u + l| <= s + S. The best S for an l is max(A + l, Q - l), A = max(u - s), Q = max(-u - s), and
    the sum of thrusts is 4 S, least at l = (Q - A)/2. The largest thrust is then max(A + D, Q + C)/2,
    C = max(u + s), D = max(s - u), than which no other l and S give less: the optimum without a maximum
    keeps the maximum wherever it can be kept. Where not, the wrench is scaled; returns the scale, 1 for none.
    """
    a = -math.inf
    q = -math.inf
    c = -math.inf
    d = -math.inf
    for i in range(4):
        s = thrust[i] + thrust[7 - i]
        u = WALSH[7 * JETS + i] * (thrust[i] - thrust[7 - i])
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
        difference = thrust[i] - thrust[7 - i] + WALSH[7 * JETS + i] * shift
        thrust[i] = within(scale * 0.5 * (s + difference), maximum)
        thrust[7 - i] = within(scale * 0.5 * (s - difference), maximum)
    return scale


def within(thrust: float, maximum: float) -> float:
    """The thrust kept from 0 to maximum, beyond which rounding errors take it."""
    if not thrust > 0.0:
        return 0.0
    if thrust > maximum:
        return maximum
    return thrust


def nearest_levels(strength: list, force: Vector3, quantum: float, highest: float) -> tuple[Vector3, float]:
    """The attainable neighbour, nearest to a force (N), on the lattice of forces without torque.

    The lattice is 2 quantum strength[i] n[i] with integers n all even or all odd; a point is attainable
    with thrusts of at most ``highest`` quanta while |n_i| + |n_j| <= 2 highest for each two axes. A
    force beyond that is scaled first, by the second value, 1 where nothing had to be scaled.
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
        # below or above on each axis, of the even or the odd numbers
        odd = float(candidate % 2)
        above = candidate // 2
        cost = 0.0
        minimum = math.inf
        total = 0.0
        for i in range(3):
            wanted = scale * exact[i]
            trial[i] = 2.0 * float(math.floor(0.5 * (wanted - odd))) + odd + 2.0 * float(above % 2)
            above = above // 2
            miss = strength[i] * (trial[i] - wanted)
            cost = cost + miss * miss
            total = total + abs(trial[i])
            if abs(trial[i]) < minimum:
                minimum = abs(trial[i])
        if total - minimum <= 2.0 * highest and cost < best:
            best = cost
            levels = vector(*trial)
    return levels, scale


def thrust_of_levels(levels: Vector3, quantum: float, thrust: list) -> None:
    """thrust = the least propellant for a point of the lattice, in whole quanta (N)."""
    largest = -math.inf
    minimum = math.inf
    u = [0.0] * 4
    for i in range(4):
        total = 0.0
        for k in range(3):
            total = total + WALSH[JETS * k + i] * levels[k]
        u[i] = 0.5 * WALSH[7 * JETS + i] * total
        if u[i] > largest:
            largest = u[i]
        if u[i] < minimum:
            minimum = u[i]
    lift = 0.5 * (largest - minimum)
    for i in range(4):
        d = WALSH[7 * JETS + i] * (u[i] - 0.5 * (largest + minimum))
        thrust[i] = quantum * (0.5 * (lift + d))
        thrust[7 - i] = quantum * (0.5 * (lift - d))
