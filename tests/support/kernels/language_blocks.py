"""Blocks that use every construct of the subset, and every arithmetic fault, for comparison with their C."""

import math
from math import floor

from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.kernel.enumerations import Enumeration, member
from perilune.fmus_src.kernel.functions import asin, exp, log, pow, sin
from perilune.fmus_src.mathlib.vectors import Vector, Vector3, clip, cross, dot, norm, vector

TABLE = (0.5, -1.25, 3.0, 8.0)
WEIGHTS = (3, 1, 2)
LIMIT = 5
FRACTION = 0.1


def power_sum(values: list, exponent: float) -> float:
    """Sum of powers, whatever the length of the list."""
    total = 0.0
    for i in range(len(values)):
        total += pow(abs(values[i]), exponent)
    return total


def scale(values: list, factor: float) -> None:
    """Multiply every element, in place."""
    for i in range(len(values)):
        values[i] *= factor


def count_down(n: int) -> int:
    """Count steps of the Collatz sequence, at most 40."""
    steps = 0
    while n > 1 and steps < 40:
        if n % 2 == 0:
            n = n // 2
        else:
            n = 3 * n + 1
        steps += 1
    return steps


def position_of_first_above(values: list, limit: float) -> int:
    """Return index of the first element above a limit, or -1."""
    for i in range(4):
        if values[i] > limit:
            return i
    return -1


def is_between(value: float, low: float, high: float) -> bool:
    """Return True if low < value < high."""
    return low < value and value < high


def spread(values: list) -> float:
    """Return the sum of the distances from the mean; a local list does not make a function change anything."""
    distances = [0.0] * len(values)
    mean = 0.0
    for i in range(len(values)):
        mean = mean + values[i] / 4.0
    for i in range(len(values)):
        distances[i] = abs(values[i] - mean)
    return distances[0] + distances[1] + distances[2] + distances[3]


class LanguageBase(Block, interface=True):
    """Base class with members that the block below inherits and overrides."""

    x = Input(0.0, description="a number")
    k = Input(0, minimum=0, maximum=9, description="an int")
    double = Parameter(2.0, description="a name that C reserves")
    y = Output([0.0] * 8, direct=True, description="results")
    n = Output([0] * 8, direct=True, description="int results")
    flags = Output([False] * 3, direct=True, description="bool results")

    def combine(self, a: float) -> float:
        return a + self.double

    def step(self, t: float, h: float) -> None:
        self.y[0] = self.combine(t) * h


class Language(LanguageBase):
    """Every construct of the subset."""

    memory = State([1.0, 2.0, 3.0, 4.0], vector=False, description="a list that functions change")
    int_memory = State([3, -7, 12], description="ints")

    def combine(self, a: float) -> float:
        return super().combine(a) - 0.5 * self.x

    def remember(self, value: float) -> float:
        """Change the block and return its memory before."""
        before = self.memory[0]
        for i in range(3):
            self.memory[i] = self.memory[i + 1]
        self.memory[3] = value
        return before

    def loops(self) -> None:
        """Use loop variables that are assigned, kept, counted down; break and continue."""
        last = 0
        for i in range(2, 9, 3):
            last = 10 * last + i
            i = i + 100
            last += i % 7
        self.n[0] = last + i
        total = 0
        bound = self.k
        for j in range(bound):
            bound = bound - 1
            if j == 2:
                continue
            if j > 6:
                break
            total += (j + 1) * bound
        self.n[1] = total
        for _ in range(3):
            for _ in range(2):
                total -= 1
        for m in range(5, -self.k, -2):
            total = total * 2 - m
        self.n[2] = total

    def ints(self) -> None:
        """Use floor division and remainder, widening, unproven indices."""
        a = self.int_memory[0] - 40 * self.k
        b = self.k - 5
        if b != 0:
            self.n[3] = a // b
            self.n[4] = a % b
        self.n[5] = -a // 7 + abs(a) % LIMIT - int(a > 3)
        self.int_memory[self.k % 3] = (self.int_memory[self.k % 3] * 3 + count_down(self.k + 1)) % 1000 - 300
        index = self.k // 3 - 2
        self.y[1] = TABLE[index] + FRACTION * WEIGHTS[self.k % len(WEIGHTS)]
        if index >= -4 and index < 4:
            self.y[1] += self.memory[index]
        self.n[6] = int(self.x * 100.0) + floor(-self.x) + math.ceil(self.x)
        self.n[7] = position_of_first_above(self.memory, self.x)

    def lists(self) -> None:
        """Use lists declared in loops and branches, passed on, of several sizes."""
        total = 0.0
        for i in range(3):
            row = [0.25] * 12
            row[i] = row[i] + self.x
            pair = [self.x, i * self.x]
            scale(pair, 0.5)
            total += power_sum(row, 1.5) + power_sum(pair, 2.0)
        if self.k > 4:
            branch = [1.0, self.x, total]
        else:
            branch = [self.x] * 3
        self.y[2] = total + power_sum(branch, 1.0) + power_sum(self.memory, 3.0) - spread(self.memory)
        scale(self.memory, 0.75)

    def conditions(self) -> None:
        """Use and, or, not, if-else expressions, comparisons of all kinds."""
        small = not (abs(self.x) > 1.0 or self.k == 3)
        self.flags[0] = small and (self.k >= 2 or self.x < -1.0) and is_between(self.x, -2.0, 2.0)
        self.flags[1] = small != self.flags[0]
        self.flags[2] = self.x != 0.0 and 1.0 / self.x > 2.0
        self.y[3] = (1.0 if small else -1.0) * (self.x if self.x > 0.0 else -self.x)
        if self.k > 7:
            self.y[4] = 1.0
        elif self.x != 0.0 and 1.0 / self.x > 0.5:
            self.y[4] = 2.0
        elif self.k > 3:
            pass
        else:
            self.y[4] = self.y[4] - 1.0

    def initialize(self) -> None:
        self.memory[1] = self.x

    def step(self, t: float, h: float) -> None:
        super().step(t, h)
        self.loops()
        self.ints()
        self.lists()
        self.conditions()
        self.y[5] = self.remember(self.x)
        # a comment that C keeps
        total: float = self.x // 0.7 - (self.x % -0.3) + (-self.x) // self.double
        if not math.isfinite(total):
            return
        self.y[6] = total - -self.x - (self.x - (h - t)) / (3 * self.k + 1)
        self.y[7] = math.pi * float(math.floor(self.x)) + math.fmod(self.x, 2.5) + float(int(self.x))


UP = vector(0.0, 0.0, 1.0)
HALVES = vector(0.5, -2.0)


def unit(v: Vector) -> Vector:
    """Return a vector of any size divided by the sum of its sizes."""
    total = 1e-3
    for i in range(len(v)):
        total += abs(v[i])
    return v / total


def halves(values: list, factor: float) -> tuple[Vector3, Vector3, float, int, bool]:
    """Return several values of all types, from slices of a list."""
    first = vector(*values[0:3])
    if factor > 1.0:
        return first, vector(*values[3:]), factor, len(values), True
    return vector(*values[3:]), first, -factor, 0, False


def swapped(values: list, factor: float) -> tuple[Vector3, Vector3, float, int, bool]:
    """Pass on several values."""
    return halves(values, factor - 1.0)


class VectorLanguage(Block):
    """Everything that vectors can do."""

    u = Input([1.0, 2.0, 3.0], description="a vector")
    pair = Input([0.5, -0.5], description="two")
    q = Input([1.0, 0.1, 0.2, 0.3], description="four")
    x = Input(1.0, description="a number")
    k = Input(0, minimum=0, maximum=9, description="an int")
    scale = Parameter([2.0, 3.0, 4.0], description="a vector that is not changed")
    a = Output([0.0, 0.0, 0.0], direct=True, description="results")
    b = Output([0.0, 0.0, 0.0], direct=True, description="results")
    two = Output([0.0, 0.0], direct=True, description="results")
    four = Output([0.0, 0.0, 0.0, 0.0], direct=True, description="results")
    y = Output([0.0] * 8, direct=True, description="numbers")
    n = Output(0, direct=True, description="an int")
    flag = Output(False, direct=True, description="a bool")
    kept = State([0.0, 0.0, 0.0], description="a vector kept from before the step")
    longer = State([1.0, 2.0, 3.0, 4.0, 5.0, 6.0], description="a list")
    u_moved = State([0.0, 0.0, 0.0], description="a vector")
    x_before = State(0.0, description="a number")

    def remember(self, v: Vector3) -> tuple[Vector3, float]:
        """Change the block and return its memory before."""
        before = self.kept
        self.kept = v
        return before, dot(before, v)

    def axis(self, k: int) -> Vector3:
        if k == 0:
            return self.scale
        return -self.scale if k % 2 == 0 else UP

    def moved_on(self, place: Vector3, speed: Vector3, time: float) -> tuple[Vector3, Vector3]:
        """Bind arguments again, from several values too."""
        while time < 2.0:
            place, speed = self.moved(place, speed, 0.5)
            time = time + 0.75
        return place, speed

    def moved(self, place: Vector3, speed: Vector3, h: float) -> tuple[Vector3, Vector3]:
        speed = speed - 0.25 * place
        return place + h * speed, speed

    def operators(self) -> None:
        a = self.u
        b = a  # a copy in effect
        a += 2.0 * self.scale
        a = a - b / 4.0 + self.scale * b * self.x
        self.a = -(a - UP) * 0.5 - 3 * b
        self.b = cross(self.a, b) + (self.a if self.x > 0.0 else -b)
        self.two = self.pair * HALVES - self.k * self.pair + self.pair / HALVES
        self.four = unit(self.q) + 0.25 * self.q
        if norm(b) > 0.0:
            self.a = a / norm(b)

    def components(self) -> None:
        w, x, y, z = self.q
        self.y[0] = w * self.q.x + x * self.q[0] - y * self.q[-1] + z * (self.u + self.scale).y
        self.y[1] = self.u[self.k % 3] + cross(self.u, UP)[self.k % 2] + self.q[1:4].z + self.q[2:4][1]
        self.two = self.q[0:2] - self.u[1:]
        self.b = self.b + self.q[1:4] - vector(self.u.z, self.pair.x, float(self.k))
        self.y[2] = abs(vector(x, -y).y) + math.fabs(self.q[1:4].x) + clip(self.u.x, -1.0, 1.0) + float(len(self.q))
        total = vector(0.0, 0.0, 0.0)
        for i in range(3):
            total = total + self.u[i] * self.axis(i + self.k)
        self.y[3] = dot(total, unit(self.u))
        fixed = [self.x] * 3
        fixed[self.k % 3] = 7.0
        self.y[4] = norm(vector(*fixed) + unit(vector(*self.longer[2:5])))

    def step(self, t: float, h: float) -> None:
        first = self.kept
        self.operators()
        self.components()
        self.b, self.a, self.x_before, self.n, self.flag = swapped(self.longer, self.x)
        before, product = self.remember(self.u)
        self.y[5] = product
        self.u_moved, self.kept = self.moved_on(self.scale, self.kept, 0.1)
        self.y[6] = norm(first - before)  # 0: a name keeps its vector whatever is stored meanwhile
        _, other, _, count, _ = halves(self.longer, self.x)
        self.y[7] = other.x + float(count)
        for i in range(6):
            self.longer[i] = 0.5 * self.longer[i] + self.q[i % 4]


class VectorFaults(Block):
    """Divisions of vectors by zero; lines and values left behind must be Python's."""

    case = Input(0, minimum=0, maximum=7, description="what to do")
    x = Input(0.0, description="divisor")
    u = Input([0.0, 1.0, 2.0], description="a vector")
    a = Output([1.0, 2.0, 3.0], direct=True, description="unchanged by a fault")
    b = Output([1.0, 2.0, 3.0], direct=True, description="unchanged by a fault")
    y = Output(1.0, direct=True, description="unchanged by a fault")

    def shared(self, divisor: float) -> tuple[Vector3, float]:
        self.b = self.b + UP
        return self.u / divisor, 1.0

    def inverse(self, v: Vector3) -> Vector3:
        return UP / v

    def step(self, t: float, h: float) -> None:
        case = self.case
        if case == 0:
            self.a = self.u / self.x
        elif case == 1:
            self.a = UP / self.u + self.u
        elif case == 2:
            self.a, self.y = self.shared(self.x)
        elif case == 3:
            self.a = self.inverse(self.u) / math.sqrt(self.x)
        elif case == 4:
            self.a = vector(1.0 / self.x, math.sqrt(self.x - 1.0), 0.0)
        elif case == 5:
            self.y = (self.u / self.x)[case % 3] + self.u[case % 4]
        elif case == 6:
            self.b = self.inverse(self.u / self.x)
        else:
            x, y, z = self.u / self.x
            self.y = x + y + z


class Faults(Block):
    """One arithmetic fault per case; the line and the values left behind must be Python's."""

    case = Input(0, minimum=0, maximum=24, description="what to do")
    x = Input(0.0, description="operand; 0 in half of the cases")
    result = Output(1.0, direct=True, description="result; unchanged by a fault")
    values = Output([1.0, 2.0, 3.0], vector=False, direct=True, description="results; unchanged by a fault")
    count = Output(0, direct=True, description="changed before a fault, unless its argument faults")

    def bump(self, amount: float) -> float:
        self.count = self.count + 1
        return 1.0 / amount

    def inverse(self, value: float) -> float:
        return 1.0 / value

    def step(self, t: float, h: float) -> None:
        case = self.case
        x = self.x
        zero = 0 * case
        self.count = self.count % 100 + 1
        if case == 0:
            self.result = 1.0 / x
        elif case == 1:
            self.result = h // x
        elif case == 2:
            self.result = h % x
        elif case == 3:
            self.result = math.sqrt(-1.0 - abs(x)) + 1.0 / x
        elif case == 4:
            self.values[1] = log(x)
        elif case == 5:
            self.values[case % 2] = exp(710.0 + x)
        elif case == 6:
            self.result = asin(1.5 + x * x)
        elif case == 7:
            self.result = pow(x, -1.0) + pow(-2.0, 0.5)
        elif case == 8:
            self.result = 1.0 / (x * x) + math.sqrt(
                -1.0 - x * x,
            )
        elif case == 9:
            self.count = 7 // zero
        elif case == 10:
            self.count = 7 % zero
        elif case == 11:
            self.count = int(1e308 * 10.0 * x)
        elif case == 12:
            self.count = math.floor(1e308 * 10.0)
        elif case == 13:
            self.result = self.values[case % 9]
        elif case == 14:
            self.values[case % 4] = 1.0 + self.inverse(x)
        elif case == 15:
            self.result = self.bump(1.0 / x)
        elif case == 16:
            self.result = self.bump(x)
        elif case == 17:
            self.values[2] = self.inverse(1.0) + self.inverse(self.inverse(x))
        elif case == 18:
            if x > 3.0 or 1.0 / x > 0.0:
                self.result = 5.0
        elif case == 19:
            while x < 50.0 and math.sqrt(x - 1.0) > 0.1:
                x = x - 1.0
        elif case == 20:
            for i in range(int(1.0 / (x + 1.0))):
                if i < 9:
                    self.result = float(i)
        elif case == 21:
            parts = [1.0, 2.0 / x, math.sqrt(x)]
            self.result = parts[1]
        elif case == 22:
            parts = [1.0 / x] * 3
            self.result = parts[2]
        elif case == 23:
            self.result = x if x > 1.0 else 1.0 / x
        else:
            self.result = math.fmod(1.0, x) + sin(1e308 * 10.0)


class Engine(Enumeration):
    """Status of the engine."""

    READY = member("cold")


class Tank(Enumeration):
    """Status of the tank."""

    FULL = member("full")
    READY = member("pressurised")


class Valve(Enumeration):
    """Status of the valve."""

    SHUT = member("shut")
    OPEN = member("open")
    READY = member("checked")


class Readiness(Block):
    """Members of one name and different values."""

    count = Input(0, description="number that is added")
    engine = Output(0, description="of the engine")
    tank = Output(0, description="of the tank")
    valve = Output(0, description="of the valve")

    def step(self, t: float, h: float) -> None:
        self.engine = Engine.READY + self.count
        self.tank = Tank.READY + self.count
        self.valve = Valve.READY + self.count
