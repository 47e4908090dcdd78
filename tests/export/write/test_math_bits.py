"""Functions and operators of the subset: C gives CPython's bits and CPython's errors."""

from __future__ import annotations

import ctypes
import math
import operator
import struct
from collections.abc import Callable
from functools import cache
from random import Random

import pytest

from perilune.fmus_src.export.compilers import CompilerMissing
from perilune.fmus_src.export.judge.subset_table import MATH_FUNCTIONS
from perilune.fmus_src.export.native_fmu import C_FILES
from tests.support import lengths
from tests.support.kernels.native_instance import load

SAMPLES = lengths.size(20000)
INT64 = 2**63
EDGES = [0.0, 5e-324, 2.2250738585072014e-308, 1e-20, 0.5, 1.0, 1.0 - 2**-53, 1.0 + 2**-52, 1.5, 2.0, 3.0, 710.0, 1e22]
EDGES += [math.pi / 2, math.pi, 1e15, 2.0**52, 2.0**53, 2.0**63, 1.7976931348623157e308, math.inf]
FLOATS = [*EDGES, *(-value for value in EDGES), math.nan]
INTS = [0, 1, 2, 3, 7, 10, 2**31, 2**32, 2**53, INT64 - 1]
INTS += [-value for value in INTS] + [-INT64]

Result = tuple[object, str]  # value, and the error's name where there is one


def floats(random: Random, count: int) -> list[float]:
    """Return edge values, every bit pattern, and the ranges that functions are defined on."""
    actual = list(FLOATS)
    for _ in range(count):
        kind = random.randrange(4)
        if kind == 0:
            actual.append(struct.unpack("<d", random.randbytes(8))[0])
        elif kind == 1:
            actual.append(random.uniform(-1.0, 1.0))
        elif kind == 2:
            actual.append(random.gauss(0.0, 10.0))
        else:
            actual.append(random.choice((-1, 1)) * 10.0 ** random.uniform(-12.0, 12.0))
    return actual


def ints(random: Random, count: int) -> list[int]:
    """Return edge values and ints of every length up to 64 bits."""
    return INTS + [random.getrandbits(random.randrange(1, 64)) * random.choice((-1, 1)) for _ in range(count)]


def python_result(function: Callable, *arguments: float) -> Result:
    """Return CPython's result; an int that leaves 64 bits is the one error that only C has."""
    try:
        value = function(*arguments)
    except (ArithmeticError, ValueError) as error:
        return None, type(error).__name__
    if type(value) is int and not -INT64 <= value < INT64:
        return None, "OverflowError"
    return bits(value), ""


def bits(value: float | int | bool) -> object:
    """Return a value to be compared bit by bit; all NaNs are one."""
    if isinstance(value, float):
        return "nan" if math.isnan(value) else struct.pack("<d", value)
    return int(value)


C_TYPES = {"float": "double", "int": "int64_t", "bool": "bool"}
C_BUFFERS = {"float": ctypes.c_double, "int": ctypes.c_int64, "bool": ctypes.c_bool}


def _math_cases() -> dict[str, tuple[str, tuple[str, ...], str, Callable]]:
    """Name -> C expression of a and b, argument types, result type, Python function."""
    cases: dict[str, tuple[str, tuple[str, ...], str, Callable]] = {}
    for name, function in MATH_FUNCTIONS.items():
        arguments = ("a", "b")[: len(function.takes)]
        if name == "frexp":  # its two values apart
            cases["frexp_0"] = ("exact_frexp(a).part0", ("float",), "float", lambda a: math.frexp(a)[0])
            cases["frexp_1"] = ("exact_frexp(a).part1", ("float",), "int", lambda a: math.frexp(a)[1])
            continue
        if function.returns == ("int",):
            text = f"py_whole_int(AT(1), {name}(a))"
        elif function.faults:
            text = f"py_{name}(AT(1), {', '.join(arguments)})"
        else:
            text = f"{name}({', '.join(arguments)})"
        cases[name] = (text, function.takes, function.returns[0], getattr(math, name))
    return cases


CASES = _math_cases() | {
    "divide": ("py_divide(AT(1), a, b)", ("float", "float"), "float", operator.truediv),
    "floor_divide": ("py_float_floor_divide(AT(1), a, b)", ("float", "float"), "float", operator.floordiv),
    "modulo": ("py_float_modulo(AT(1), a, b)", ("float", "float"), "float", operator.mod),
    "multiply_add": ("a * b + a", ("float", "float"), "float", lambda a, b: a * b + a),
    "int_of_float": ("py_whole_int(AT(1), trunc(a))", ("float",), "int", int),
    "float_of_floor": ("py_whole_float(AT(1), floor(a))", ("float",), "float", lambda a: float(math.floor(a))),
    "float_of_int": ("(double)a", ("int",), "float", float),
    "int_add": ("py_add(AT(1), a, b)", ("int", "int"), "int", operator.add),
    "int_subtract": ("py_subtract(AT(1), a, b)", ("int", "int"), "int", operator.sub),
    "int_multiply": ("py_multiply(AT(1), a, b)", ("int", "int"), "int", operator.mul),
    "int_floor_divide": ("py_int_floor_divide(AT(1), a, b)", ("int", "int"), "int", operator.floordiv),
    "int_modulo": ("py_int_modulo(AT(1), a, b)", ("int", "int"), "int", operator.mod),
    "int_negative": ("py_negative(AT(1), a)", ("int",), "int", operator.neg),
    "int_abs": ("py_int_abs(AT(1), a)", ("int",), "int", abs),
}


def _source() -> bytes:
    """Write one C function per case that runs it over arrays and keeps the faults."""
    text = '#include "kernel_math.h"\n#define AT(line) &fault, "file", line\n'
    for name, (expression, arguments, returned, _) in CASES.items():
        inputs = "".join(f"const {C_TYPES[kind]} *{x}, " for kind, x in zip(arguments, ("as", "bs"), strict=False))
        reads = "".join(f"const {C_TYPES[kind]} {x} = {x}s[i]; " for kind, x in zip(arguments, "ab", strict=False))
        text += (
            f"void run_{name}({inputs}size_t count, {C_TYPES[returned]} *results, const char **whats)\n"
            f"{{ for (size_t i = 0; i < count; i++) {{ Fault fault = {{NULL, NULL, 0}}; {reads}"
            f"results[i] = {expression}; whats[i] = fault.what; }} }}\n"
        )
    return text.encode()


@cache
def harness(portable: bool) -> ctypes.CDLL:
    """Compile the cases, by the system's compiler or by zig."""
    sources = {"harness.c": _source(), "kernel_math.h": (C_FILES / "kernel" / "kernel_math.h").read_bytes()}
    return load(sources, "harness.c", portable)


def c_results(name: str, portable: bool, columns: list[list]) -> list[Result]:
    """Return the results of C, per sample."""
    _, kinds, returned, _ = CASES[name]
    count = len(columns[0])
    inputs = [(C_BUFFERS[kind] * count)(*column) for kind, column in zip(kinds, columns, strict=True)]
    results = (C_BUFFERS[returned] * count)()
    whats = (ctypes.c_char_p * count)()
    getattr(harness(portable), f"run_{name}")(*inputs, ctypes.c_size_t(count), results, whats)
    actual: list[Result] = []
    for value, what in zip(results, whats, strict=True):
        actual.append((None, what.decode().split(":")[0]) if what else (bits(value), ""))
    return actual


@pytest.mark.parametrize(
    "portable", [False, *lengths.either([True], [])], ids=lambda portable: "zig" if portable else "system"
)
@pytest.mark.parametrize("name", CASES)
def test_c_has_cpythons_bits_and_errors(name: str, portable: bool) -> None:
    random = lengths.generator(name)
    _, kinds, _, function = CASES[name]
    sampled = [(floats if kind == "float" else ints)(random, SAMPLES) for kind in kinds]
    if len(kinds) == 2:  # every edge with every edge too
        edges = [FLOATS if kind == "float" else INTS for kind in kinds]
        count = min(map(len, sampled))
        sampled = [column[:count] for column in sampled]
        sampled[0] += [a for a in edges[0] for _ in edges[1]]
        sampled[1] += [b for _ in edges[0] for b in edges[1]]
    try:
        native = c_results(name, portable, sampled)
    except CompilerMissing:
        pytest.skip("ziglang is not installed")
    for arguments, actual in zip(zip(*sampled, strict=True), native, strict=True):
        expected = python_result(function, *arguments)
        assert actual == expected, f"{name}{arguments}: Python {expected}, C {actual}"


def test_errors_name_the_place() -> None:
    source = (
        b'#include "kernel_math.h"\n'
        b'Fault place(double x) { Fault fault = {NULL, NULL, 0}; py_sqrt(&fault, "kernel.py", 12, x);\n'
        b'py_fmod(&fault, "kernel.py", 13, 1.0, 0.0); return fault; }\n'
    )
    library = load({"place.c": source, "kernel_math.h": (C_FILES / "kernel" / "kernel_math.h").read_bytes()}, "place.c")

    class Fault(ctypes.Structure):
        _fields_ = [("what", ctypes.c_char_p), ("file", ctypes.c_char_p), ("line", ctypes.c_int)]

    place = library.place
    place.restype = Fault
    first = place(ctypes.c_double(-1.0))
    assert (first.what, first.file, first.line) == (b"ValueError: math domain error", b"kernel.py", 12)
    assert place(ctypes.c_double(1.0)).line == 13
