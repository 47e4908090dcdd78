"""Blocks with every use of matrices, and every fault, for comparison with their C."""

from __future__ import annotations

from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.kernel.matrices import (
    Matrix,
    add_product,
    block,
    diagonal,
    exponential,
    identity,
    inverse,
    inverse_quadratic_form,
    matrix,
    mirror,
    outer,
    zeros,
)
from perilune.fmus_src.mathlib.estimation.kalman import predict, update
from perilune.fmus_src.mathlib.vectors import dot, vector

FIRST, SECOND = block(0, 3), block(3, 3)
PAIR = block(1, 2)
AXES = 3


def trace(a: Matrix) -> float:
    """Return the sum of the diagonal, of any size."""
    total = 0.0
    for i in range(len(a)):
        total = total + a[i, i]
    return total


def symmetric(a: Matrix) -> tuple[Matrix, float]:
    """Return several values with a matrix among them."""
    mean = 0.5 * (a + a.T)
    return mean, trace(mean)


def turn(a: Matrix, k: int) -> None:
    """Change the argument, reading it elsewhere."""
    a[:, :] = a.T
    a[0, :] = a[:, k % 3]
    a[PAIR, PAIR] = a[PAIR, PAIR].T + a[0:2, 0:2]
    a[k % 3, k % 2] -= 1.0


class MatrixLanguage(Block):
    """Matrices in every place that a value can have."""

    u = Input([0.5, -0.25, 1.5], description="a vector")
    x = Input(0.75, description="a number")
    k = Input(1, minimum=0, maximum=5, description="an int")
    inertia = Parameter([5.0, -1.0, 0.5, -1.0, 6.0, 0.0, 0.5, 0.0, 7.0], columns=3, description="square")
    table = Parameter([1, 2, 3, 4, 5, 6], columns=3, description="of ints")
    wide = State([0.0] * 10, columns=5, description="not square")
    three = State(zeros(3, 3), description="numbered through")
    p = State(identity(6), description="a covariance")
    estimate = State(zeros(6, 1), description="a column")
    a = Output([0.0, 0.0, 0.0], direct=True, description="a vector")
    y = Output([0.0] * 8, direct=True, description="numbers")
    n = Output(0, direct=True, description="an int")
    flag = Output(False, direct=True, description="a bool")

    def initialize(self) -> None:
        self.three = self.inertia
        self.p = identity(6)
        self.p[FIRST, FIRST] = self.inertia

    def fold(self, a: Matrix) -> None:
        """Fold an argument that may be the changed matrix itself."""
        self.three = a.T + a
        self.three[0:2, :] = a[1:3, :] - self.three[0:2, :]

    def small(self) -> None:
        """Use matrices that are written out."""
        skew = matrix([0.0, -self.u.z, self.u.y], [self.u.z, 0.0, -self.u.x], [-self.u.y, self.u.x, 0.0])
        product = skew @ self.inertia @ skew.T
        self.a = self.inertia @ self.u / 4.0 + product @ (0.5 * self.a) - self.three.T @ self.u
        mean, size = symmetric(self.three - 2 * product / 3.0 + self.inertia * self.x)
        self.y[0] = size
        turn(mean, self.k)
        self.three = -mean * 0.125
        self.three = self.three @ self.three
        self.fold(self.three)
        copied = self.three.copy()
        copied[1, :] = self.u
        self.three = (copied + self.three[:, :].T) * (0.01 / (1.0 + abs(trace(copied))))
        self.y[1] = (copied @ skew)[self.k % 3, 1] + outer(self.u, self.a)[0, 2] + diagonal(self.u)[1, 1]
        self.y[2] = dot(copied[PAIR, :].T @ vector(1.0, self.x), self.u) + copied[0:2, 0:2][1, 1]
        inverted, self.flag = inverse(self.inertia + skew)
        while dot(inverted @ self.u, self.u) > 1.0 and self.n < 100:
            inverted = 0.5 * inverted
            self.n = self.n + 1
        if self.k == 0:
            self.y[3] = trace(exponential(0.01 * skew, self.x / (1.0 + abs(self.x))))
        elif trace(inverted @ skew) > 0.0:
            self.y[3] = self.x
        self.n = self.table[self.k % 2, 2] + len(self.wide)

    def large(self, h: float) -> None:
        """Use matrices in loops."""
        f = identity(6)
        f[FIRST, SECOND] = h * identity(3)
        f[SECOND, 0] = 0.01 * vector(self.x, 1.0, -self.x) / (1.0 + abs(self.x))
        q = zeros(AXES + 3, 2 * AXES)
        q[SECOND, AXES : len(q) * AXES // 3] += 0.01 * h * diagonal(self.u * self.u) / (1.0 + dot(self.u, self.u))
        self.estimate = f @ self.estimate
        self.p = predict(self.p, f, q)
        row = zeros(AXES % 2, len(q) - 0)
        weights = [0.0] * (AXES * AXES - 7)
        weights[AXES // 2] = row[0, 0]
        row[0, self.k] = 1.0
        self.estimate, self.p, square = update(self.estimate, self.p, row, 1.0 + self.x * self.x, self.u.x)
        self.y[4] = square
        self.p = self.p @ f.T @ f / 1.5 + 0.1 * identity(6)
        self.p = 0.25 * self.p.T + 0.25 * self.p
        mirror(self.p, 6)
        self.y[5] = inverse_quadratic_form(self.p, self.estimate) + (row @ self.p @ row.T)[0, 0]
        self.wide = 0.5 * self.wide + self.estimate[0:2, :] @ row[:, 0:5] - self.p[0:2, 1:]
        self.wide[1, :] = self.wide[0, :] + self.wide[1, :]
        total = add_product(self.p[1:, 1:], self.wide.T @ self.wide, identity(5))
        self.y[6] = trace(total) if self.k > 2 else self.p[3, self.k]

    def step(self, t: float, h: float) -> None:
        self.small()
        self.large(h)
        self.y[7] = self.wide[1, -1] + float(self.table[0, self.k % 3])


class MatrixFaults(Block):
    """Divisions by zero and indices outside; lines and values left behind must be Python's."""

    case = Input(0, minimum=0, maximum=9, description="what to do")
    x = Input(0.0, description="divisor")
    k = Input(0, minimum=-5, maximum=8, description="index")
    u = Input([0.0, 1.0, 2.0], description="a vector")
    m = State(identity(3), description="unchanged by a fault")
    p = State(identity(6), description="unchanged by a fault")
    y = Output(1.0, direct=True, description="unchanged by a fault")
    v = Output([1.0, 2.0, 3.0], direct=True, description="unchanged by a fault")

    def shared(self, divisor: float) -> Matrix:
        self.y = self.y + 1.0
        return self.m / divisor

    def step(self, t: float, h: float) -> None:
        case = self.case
        if case == 0:
            self.m = self.m / self.x
        elif case == 1:
            self.p = self.p @ (self.p / self.x) - self.p[self.k, 0] * self.p
        elif case == 2:
            self.m = self.shared(self.x)
        elif case == 3:
            self.y = self.p[self.k, self.k]
        elif case == 4:
            self.v = self.m @ (self.u / self.x) + vector(self.p[self.k, 1], 0.0, 1.0)
        elif case == 5:
            self.p[self.k, self.case - 3] = 1.0 / self.x
        elif case == 6:
            self.v = self.m[self.k, :]
        elif case == 7:
            self.p[0:3, self.k] = self.u / self.x
        elif case == 8:
            self.m = matrix([1.0 / self.x, 0.0, 0.0], [self.p[self.k, 0], 1.0, 0.0], [0.0, 0.0, 1.0])
        elif self.y > 2.0:
            while trace(self.m / self.x) > 1.0 and self.y > 1.0:
                self.y = self.y - 1.0
