"""The network operator: a control law as an upper triangular integer matrix. Kernel functions.

Node j holds a number z_j. Above the diagonal, matrix[i, j] is the unary operation on the edge from
node i to node j (0: no edge); matrix[j, j] is the binary operation by which node j combines its
edges. Source nodes start at the values of the sources, other nodes at the neutral element; then,
row by row,

    z_j <- binary_jj(z_j, unary_ij(z_i))

so a node is complete when its own row begins. Powers and products are limited to +-LARGEST, so
that no source value causes a division by zero or an overflow.

    unary   1 z                 7 ln|z|                13 atan z            19 sgn(z) exp(-|z|)
            2 z^2               8 tanh(z/2)            14 z^3               20 z/2
            3 -z                9 step (z >= 0)        15 cube root         21 2 z
            4 sgn(z) sqrt|z|   10 sgn (+1 at 0)        16 clip to +-1       23 z - z^3
            5 1/z              11 cos z                17 sgn(z) ln(|z|+1)
            6 exp z            12 sin z                18 sgn(z) (exp|z|-1)
    binary  0 sum, 1 product, 2 maximum, 3 minimum

Sources: Diveev 2010 (the method; 8 is written (1 - exp(-z))/(1 + exp(-z)) there); Diveev, Pupkov and
Sofronova 2013 (size, sources and the numbers in use). The numbers of maximum and minimum are chosen here.
"""

import math

from ..kernel.functions import atan, cbrt, cos, exp, expm1, log, log1p, sin, tanh
from ..kernel.matrices import Matrix
from .vectors import clip

SIZE = 16
SOURCES = 6  # number of source nodes, which are the first ones
MAXIMUM_EDGES = 120  # elements above the diagonal
EPSILON = 1e-8
LARGEST = 1e8
LOG_LARGEST = 18.420680743952367  # ln LARGEST = -ln EPSILON, where exp saturates
UNARY_OPERATIONS = (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 23)
BINARY_OPERATIONS = (0, 1, 2, 3)


def is_unary(operation: int) -> bool:
    """Return True if a number identifies a unary operation."""
    return operation >= 1 and operation <= 23 and operation != 22


def is_binary(operation: int) -> bool:
    """Return True if a number identifies a binary operation."""
    return operation >= 0 and operation <= 3


def sign(z: float) -> float:
    """Return -1 for negative numbers and +1 for others."""
    if z < 0.0:
        return -1.0
    return 1.0


def unary(operation: int, z: float, exp_saturation: float) -> float:
    """Return the result of a known unary operation on z; exp gives exp_saturation for z above LOG_LARGEST."""
    if operation == 1:
        return z
    if operation == 2:
        return clip(z * z, 0.0, LARGEST)
    if operation == 3:
        return -z
    if operation == 4:
        return sign(z) * math.sqrt(abs(z))
    if operation == 5:
        if abs(z) <= EPSILON:
            return sign(z) / EPSILON
        return 1.0 / z
    if operation == 6:
        if z > LOG_LARGEST:
            return exp_saturation
        return exp(z)
    if operation == 7:
        return log(clip(abs(z), EPSILON, math.inf))
    if operation == 8:
        return tanh(0.5 * z)
    if operation == 9:
        if z >= 0.0:
            return 1.0
        return 0.0
    if operation == 10:
        return sign(z)
    if operation == 11:
        return cos(z)
    if operation == 12:
        return sin(z)
    if operation == 13:
        return atan(z)
    if operation == 14:
        return clip(z * z * z, -LARGEST, LARGEST)
    if operation == 15:
        return cbrt(z)
    if operation == 16:
        return clip(z, -1.0, 1.0)
    if operation == 17:
        return sign(z) * log1p(abs(z))
    if operation == 18:
        if abs(z) > LOG_LARGEST:
            return sign(z) * LARGEST
        return sign(z) * expm1(abs(z))
    if operation == 19:
        return sign(z) * exp(-abs(z))
    if operation == 20:
        return 0.5 * z
    if operation == 21:
        return 2.0 * z
    return clip(z - z * z * z, -LARGEST, LARGEST)


def binary(operation: int, a: float, b: float) -> float:
    """Return the result of a known binary operation on a and b."""
    if operation == 0:
        return a + b
    if operation == 1:
        return clip(a * b, -LARGEST, LARGEST)
    if operation == 2:
        return a if a > b else b
    return a if a < b else b


def neutral(operation: int) -> float:
    """Return the neutral element of a known binary operation."""
    if operation == 0:
        return 0.0
    if operation == 1:
        return 1.0
    if operation == 2:
        return -LARGEST
    return LARGEST


def decode(matrix: Matrix, edges: list) -> int:
    """Store the positions of a matrix's edges, in row-major order, in ``edges`` and return the number of edges.

    Returns -1 if the matrix is not a network operator, because of an unknown operation or an entry below the diagonal.
    """
    count = 0
    for row in range(SIZE):
        for column in range(SIZE):
            operation = matrix[row, column]
            if row == column:
                if not is_binary(operation):
                    return -1
            elif operation != 0:
                if row > column or not is_unary(operation):
                    return -1
                edges[count] = SIZE * row + column
                count = count + 1
    return count


def evaluate(matrix: Matrix, edges: list, count: int, exp_saturation: float, nodes: list) -> None:
    """Compute the values of all nodes of a decoded network.

    On entry ``nodes`` contains the values of the sources and the neutral elements of all other nodes.
    """
    for k in range(count):
        row = edges[k] // SIZE
        column = edges[k] % SIZE
        value = unary(matrix[row, column], nodes[row], exp_saturation)
        nodes[column] = binary(matrix[column, column], nodes[column], value)
