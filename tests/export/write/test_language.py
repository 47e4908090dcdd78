"""Every construct of the subset, and every fault, has the same meaning in C and in Python. Truth: CPython."""

from __future__ import annotations

from inspect import getsourcelines

from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.judge.kernel import Constant
from perilune.fmus_src.export.judge.subset import check
from perilune.fmus_src.export.write.translate import translate
from tests.support import lengths
from tests.support.kernels.comparison import Pair, fly
from tests.support.kernels.language_blocks import (
    Engine,
    Faults,
    Language,
    Readiness,
    Tank,
    Valve,
    VectorFaults,
    VectorLanguage,
)
from tests.support.kernels.matrix_blocks import MatrixFaults, MatrixLanguage
from tests.support.kernels.record_blocks import RecordFaults, RecordLanguage
from tests.support.kernels.users_blocks import Bundles


def test_blocks_are_in_the_subset() -> None:
    assert check(Language) == []
    assert check(Faults) == []
    assert check(VectorLanguage) == []
    assert check(VectorFaults) == []
    assert check(MatrixLanguage) == []
    assert check(MatrixFaults) == []
    assert check(RecordLanguage) == []
    assert check(RecordFaults) == []


def test_every_construct_is_bitwise_equal() -> None:
    pair = Pair(Language, lengths.generator("language"))
    rows, _ = fly(pair, lengths.size(2000))
    assert len(set(rows)) > 0.9 * len(rows)


def test_everything_that_vectors_can_do_is_bitwise_equal() -> None:
    pair = Pair(VectorLanguage, lengths.generator("vectors"))
    rows, _ = fly(pair, lengths.size(2000))
    assert len(set(rows)) > 0.9 * len(rows)


def test_vectors_of_any_floats_are_bitwise_equal() -> None:
    pair = Pair(VectorLanguage, lengths.generator("wild vectors"))
    pair.wild = True
    fly(pair, lengths.size(2000))


def test_every_fault_of_vectors_is_at_the_same_line_and_leaves_the_same_values() -> None:
    pair = Pair(VectorFaults, lengths.generator("vector faults"))
    pair.wild = True
    fly(pair, lengths.size(3000))
    lines = {message.split(" line ")[1].split(",")[0] for message in pair.faults}
    assert len(lines) >= 9, sorted(lines)


def test_everything_that_matrices_can_do_is_bitwise_equal() -> None:
    pair = Pair(MatrixLanguage, lengths.generator("matrices"))
    rows, _ = fly(pair, lengths.size(2000))
    assert len(set(rows)) > 0.9 * len(rows)


def test_matrices_of_any_floats_are_bitwise_equal() -> None:
    pair = Pair(MatrixLanguage, lengths.generator("wild matrices"))
    pair.wild = True
    fly(pair, lengths.size(1000))


def test_every_fault_of_matrices_is_at_the_same_line_and_leaves_the_same_values() -> None:
    pair = Pair(MatrixFaults, lengths.generator("matrix faults"))
    pair.wild = True
    fly(pair, lengths.size(3000))
    lines = {message.split(" line ")[1].split(",")[0] for message in pair.faults}
    assert len(lines) >= 9, sorted(lines)


def test_everything_that_records_can_do_is_bitwise_equal() -> None:
    pair = Pair(RecordLanguage, lengths.generator("records"))
    rows, _ = fly(pair, lengths.size(2000))
    assert len(set(rows)) > 0.9 * len(rows)


def test_every_fault_of_records_is_at_the_same_line_and_leaves_the_same_values() -> None:
    pair = Pair(RecordFaults, lengths.generator("record faults"))
    pair.wild = True
    fly(pair, lengths.size(3000))
    lines = {message.split(" line ")[1].split(",")[0] for message in pair.faults}
    assert len(lines) >= 5, sorted(lines)


def test_everything_that_bundles_can_do_is_bitwise_equal_with_its_fault() -> None:
    pair = Pair(Bundles, lengths.generator("bundles"))
    pair.wild = True
    rows, _ = fly(pair, lengths.size(2000))
    assert len(set(rows)) > 0.9 * len(rows)
    divided = f"line {getsourcelines(Bundles.weaken)[1] + 2}: ZeroDivisionError"
    assert pair.faults
    assert all(divided in message for message in pair.faults)


def test_enumerations_of_one_module_may_name_their_members_alike() -> None:
    assert [Engine.READY, Tank.READY, Valve.READY] == [0, 1, 2]
    fly(Pair(Readiness, lengths.generator("statuses")), lengths.size(200))


def test_a_constant_that_is_not_a_number_has_one_name() -> None:
    """NaN is not equal to itself, and dataclasses compare field by field since Python 3.13."""
    assert Constant("math", "nan", float("nan")) == Constant("math", "nan", float("nan"))
    assert len({Constant("math", "nan", float("nan")), Constant("math", "nan", float("nan"))}) == 1
    assert Constant("m", "GOOD", 1) != Constant("m", "GOOD", 2)


def test_generated_integrators_are_readable() -> None:
    text = translate(RecordLanguage, "{guid}")
    assert "MotionRecord k2 = record_language_derivatives(self, " in text
    assert "} MotionRecord;" in text
    assert text.count("/* runge_kutta_4 (fmus_src/kernel/integrators.py:") == 3  # for a record, a vector, a float


def test_generated_matrices_are_readable() -> None:
    text = translate(MatrixLanguage, "{guid}")
    assert "typedef struct Matrix6x6 {" in text
    assert "p_1.x[6 * i + j] = p->x[6 * i + j] - k.x[i] * ph.x[j];" in text
    assert "static inline Matrix3x3 matrices_outer(const" not in text


def test_generated_vectors_are_readable() -> None:
    text = translate(VectorLanguage, "{guid}")
    assert "Vector3 kept; " in text
    assert "a = add3(a, scale3(2.0, self->scale));" in text
    assert "static inline Vector3 language_blocks_unit_3(" in text
    assert "typedef struct Vector3Vector3DoubleInt64Bool {" in text


def test_every_fault_is_at_the_same_line_and_leaves_the_same_values() -> None:
    pair = Pair(Faults, lengths.generator("faults"))
    pair.wild = True
    fly(pair, lengths.size(4000))
    lines = {message.split(" line ")[1].split(",")[0] for message in pair.faults}
    assert len(lines) >= 24, sorted(lines)


def test_generated_source_is_readable() -> None:
    text = translate(Language, "{guid}")
    assert "/* a comment that C keeps */" in text
    assert "typedef struct Language {" in text
    assert "double double_;" in text
    assert "output: int results" in text
    assert "static double language_blocks_power_sum(" in text
    assert max(len(line) for line in text.splitlines()) <= 130


def test_indices_proven_in_their_own_loop_are_not_checked() -> None:
    assert "py_index" not in translate(catalogue()["thrust_allocation"], "{guid}")
