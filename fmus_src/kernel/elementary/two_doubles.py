"""Exact rounding errors of sums and products: numbers as sums of two doubles. Kernel functions.

Sources: Knuth, "The Art of Computer Programming" 2, 1969, 4.2.2, theorem B; Dekker, "A floating-point technique for
extending the available precision", Numerische Mathematik 18, 1971.
"""

ROUND = 6755399441055744.0  # 1.5 2^52: added and subtracted, it leaves the nearest integer
SPLITTER = 134217729.0  # 2^27 + 1 (Veltkamp)


def sum_error(a: float, b: float, s: float) -> float:
    """Return a + b - s for the double s = a + b."""
    t = s - a
    return (a - (s - t)) + (b - t)


def product_error(a: float, b: float, p: float) -> float:
    """Return a b - p for the double p = a b, for factors between 2^-500 and 2^500."""
    c = SPLITTER * a
    a_high = c - (c - a)
    a_low = a - a_high
    c = SPLITTER * b
    b_high = c - (c - b)
    b_low = b - b_high
    return ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low
