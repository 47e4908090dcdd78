"""Real roots of polynomials up to the fourth degree. Kernel functions.

A polynomial is a list of five floats, c[0] + c[1] x + ... + c[4] x^4; leading coefficients may be 0. Turning points,
the roots of the derivative, isolate the roots, which Newton's method within a bracket (Press et al. 2007, section 9.4)
computes to the last bits.
"""

import math

LARGEST = 1e15  # larger roots are ignored
SETTLED = 1e-12  # relative to the root; after a smaller Newton step only rounding errors remain


def evaluate(c: list, x: float) -> float:
    """Return the value of the polynomial at x."""
    return (((c[4] * x + c[3]) * x + c[2]) * x + c[1]) * x + c[0]


def quadratic_roots(c0: float, c1: float, c2: float, roots: list) -> int:
    """Store the real roots of c0 + c1 x + c2 x^2 in ascending order, computed without cancellation; return their
    number, 0 to 2.
    """
    discriminant = c1 * c1 - 4.0 * c2 * c0
    if not discriminant >= 0.0:
        return 0
    q = -0.5 * (c1 + math.copysign(math.sqrt(discriminant), c1))
    count = 0
    if c2 != 0.0:
        roots[0] = q / c2
        count = 1
    if q != 0.0:
        roots[count] = c0 / q
        count = count + 1
    if count == 2 and roots[1] < roots[0]:
        larger = roots[0]
        roots[0] = roots[1]
        roots[1] = larger
    return count


def root_between(c: list, low: float, high: float, rising: bool, guess: float) -> float:
    """Return the root in [low, high], where the polynomial is monotone and changes sign.

    The search begins at ``guess`` if it lies between the bounds, otherwise at their middle.
    """
    x = guess
    if not (guess > low and guess < high):
        x = 0.5 * (low + high)
    step = high - low
    for _ in range(200):
        value = evaluate(c, x)
        slope = ((4.0 * c[4] * x + 3.0 * c[3]) * x + 2.0 * c[2]) * x + c[1]
        if value == 0.0:
            return x
        if (value < 0.0) == rising:
            low = x
        else:
            high = x
        newton = x
        if slope != 0.0:
            newton = x - value / slope
        before = x
        # each iteration at least halves the Newton step or the bracket
        if newton > low and newton < high and abs(newton - x) <= 0.5 * abs(step):
            x = newton
            if abs(x - before) <= SETTLED * x:
                return x
        else:
            x = 0.5 * (low + high)
        step = x - before
        if step == 0.0:
            return x
    return x


def first_crossing(c: list, low: float, high: float, guess: float) -> float:
    """Return the root in (``low``, ``high``], where the polynomial must be monotone, or 0 if there is none."""
    value = evaluate(c, low)
    if value == 0.0:
        return 0.0
    rising = value < 0.0
    near = low
    far = 2.0 * low
    if low <= 0.0:
        far = 1.0
    while far < high and not crosses(rising, evaluate(c, far)):
        near = far
        far = 2.0 * far
    if far >= high:
        far = high
        if not crosses(rising, evaluate(c, far)):
            return 0.0
    return root_between(c, near, far, rising, guess)


def crosses(rising: bool, value: float) -> bool:
    """Return True if the value of a function that rises from below 0, or else falls from above 0, has reached 0."""
    if rising:
        return value >= 0.0
    return value <= 0.0


def positive_roots(c: list, turning: list, turnings: int, roots: list) -> int:
    """Store the positive roots at which the polynomial changes sign in ascending order; return their number.

    ``turning`` contains ``turnings`` turning points in ascending order; nonpositive ones are skipped. ``roots`` must
    have four elements.
    """
    count = 0
    low = 0.0
    for k in range(turnings + 1):
        high = LARGEST
        if k < turnings and turning[k] < LARGEST:
            high = turning[k]
        if high > low:
            root = first_crossing(c, low, high, 0.0)
            if root > 0.0:
                roots[count] = root
                count = count + 1
            low = high
    return count
