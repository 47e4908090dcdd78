"""Names and literals of the generated C."""

from __future__ import annotations

import itertools
import math
import re
from dataclasses import dataclass

from ...block import snake_case
from ...kernel.records import SCALARS, Record, count_numbers
from ...kernel.vector_types import VECTORS
from ...variables import Variable
from ..judge.kernel import (
    BOOL,
    FLOAT,
    INT,
    BoundFunction,
    Constant,
    Function,
    Kernel,
    List,
    MatrixType,
    RecordType,
    Several,
    Type,
    Value,
    VectorType,
)

C_TYPES = {FLOAT: "double", INT: "int64_t", BOOL: "bool"}

# Reserved words of C and C++ that are valid Python names, and names used by the generated code.
_RESERVED_TEXT = """
    auto break case char const continue default do double else enum extern float for goto if inline int long
    register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
    alignas alignof and_eq bitand bitor catch compl constexpr const_cast decltype delete dynamic_cast explicit export
    friend mutable namespace new noexcept not_eq nullptr operator or_eq private protected public reinterpret_cast
    static_assert static_cast template this thread_local throw typeid typename using virtual wchar_t xor xor_eq
    bool true false linux unix NULL NAN INFINITY EOF errno stdin stdout stderr fault self
    acos asin atan atan2 cbrt ceil copysign cos cosh exp exp2 expm1 fabs floor fmod isfinite isinf isnan log
    log10 log1p log2 pow sin sinh sqrt tan tanh trunc whole_ceil whole_floor whole_trunc
"""
RESERVED = frozenset(_RESERVED_TEXT.split())


# Names used by the wrappers in fmi/, which block types and functions must avoid.
_WRAPPER_NAMES_TEXT = """
    Block Byte Component DoubleInt64 Element Environment Fault Logger Mode Range Samples SavedState Snapshot Status
    Trait Variable VariableType accept_tuned add_and_subtract advance check_arithmetic check_logging check_mode
    check_ranges check_start_values check_state checked_result copy_element count_samples create_instance deserialise
    do_step double_at element_of elements_of end_step_with_fault end_with_fault exact_frexp exact_ldexp fail
    float_floor_divide float_modulo free_state get_starts has_traits instance_of int_abs int_at int_floor_divide
    int_modulo is_header is_mode is_used kind_name leave_initialisation lie_alike log_error mode_name model_hash
    model_initialize model_integration_step model_sample_period model_set_start_time model_step name_element no_strings
    no_variables not_provided pass_parameters perilune_place power_of_two prepare_get prepare_set put_double put_int
    python_repr refuse refuse_end refuse_integration refuse_interface refuse_null refuse_point
    refuse_reference refuse_set refuse_sizes refuse_step refuse_type refuse_value refuse_wide reset restart
    restore_state save_state serialise serialised_size set_fault set_start settle state_space take_samples terminate
    tune type_name whole_ceil whole_floor whole_trunc
"""
VECTOR_OPERATIONS = ("add", "subtract", "negative", "scale", "multiply", "divide", "quotient")
WRAPPER_NAMES = frozenset(
    [
        *_WRAPPER_NAMES_TEXT.split(),
        *(kind.__name__ for kind in VECTORS.values()),
        *(f"{operation}{size}" for operation in VECTOR_OPERATIONS for size in VECTORS),
    ]
)


def identifier(name: str) -> str:
    """Return the C name of a Python name."""
    return f"{name}_" if name in RESERVED or name.startswith("py_") else name


def module_prefix(module: str) -> str:
    """Return the prefix of a module: ``rng`` for ``perilune.fmus_src.mathlib.rng``."""
    return re.sub(r"\W", "_", module.split(".")[-1])


@dataclass(frozen=True)
class Names:
    """C names of a kernel's functions and module constants."""

    functions: dict[Function, str]
    constants: dict[Constant, str]


def names_of(kernel: Kernel) -> Names:
    """Return unique C names for all functions and constants of a kernel."""
    constants = [constant for function in kernel.functions for constant in function.constants.values()]
    return Names(_function_names(kernel.functions), _constant_names(constants))


def _function_names(functions: list[Function]) -> dict[Function, str]:
    """Return a C name for each function: its module (or the class of a method) and its name.

    If this is not unique, the module's folder or the sizes of its lists are added.
    """
    names: dict[Function, str] = {}
    owners: dict[str, object] = {}
    for function in functions:
        source = function.source
        prefix = snake_case(source.owner.__name__) if source.owner is not None else module_prefix(source.module)
        name = f"{prefix}_{source.name.strip('_')}"
        if owners.setdefault(name, source.function) is not source.function:
            name = re.sub(r"\W", "_", f"{source.module}_{source.qualified_name}")
        if name in WRAPPER_NAMES:
            name += "_"
        if name in names.values():
            name = "_".join([name, *filter(None, map(_distinction, function.parameters.values()))])
        while name in names.values():  # same sizes, other element types
            name += "_"
        names[function] = name
    return names


def _distinction(kind: Type) -> str:
    """Return the suffix that distinguishes a function with these arguments from others of the same name."""
    if isinstance(kind, BoundFunction):
        return kind.function.__name__
    if isinstance(kind, RecordType):
        return kind.record.__name__
    if isinstance(kind, MatrixType):
        return f"{kind.rows}x{kind.columns}"
    return str(kind.size) if isinstance(kind, List | VectorType) else ""


def block_type_name(name: str) -> str:
    """Return the struct type of a block class."""
    return f"{name}Block" if name in WRAPPER_NAMES or name in RESERVED else name


def _constant_names(constants: list[Constant]) -> dict[Constant, str]:
    """Return C names of constants: ``TERMINAL_GUIDANCE_UNLIMITED`` for ``UNLIMITED`` of terminal_guidance.

    Folders are added if needed. Equal names of members of several enumerations in one module are numbered.
    """
    names: dict[Constant, str] = {}
    for constant in dict.fromkeys(constants):
        short = f"{module_prefix(constant.module)}_{constant.name.strip('_')}".upper()
        long = re.sub(r"\W", "_", f"{constant.module}_{constant.name}").upper()
        candidates = itertools.chain((short, long), (f"{long}_{n}" for n in itertools.count(2)))
        used = set(names.values())
        names[constant] = next(name for name in candidates if name not in used)
    return names


def literal(value: float | int | bool) -> str:
    """Return a C literal of a number that reads back to the same bits."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value) if abs(value) < 2**31 else f"INT64_C({value})"
    if math.isnan(value):
        return "NAN"
    if math.isinf(value):
        return "INFINITY" if value > 0.0 else "-INFINITY"
    return repr(value)


def c_type(kind: Value | Several) -> str:
    """Return the C type: ``double``, ``Vector3``, ``Motion``; ``DoubleVector3`` for a float and a vector."""
    if isinstance(kind, RecordType):
        return f"{kind.record.__name__}Record"
    if isinstance(kind, MatrixType):
        return f"{'' if kind.element is FLOAT else kind.element.name.title()}Matrix{kind.rows}x{kind.columns}"
    if isinstance(kind, Several):
        return "".join(name[0].upper() + name[1:] for name in (c_type(part).removesuffix("_t") for part in kind.parts))
    return VECTORS[kind.size].__name__ if isinstance(kind, VectorType) else C_TYPES[kind]


def declaration(kind: Type, name: str, constant: bool = False) -> str:
    """Return ``double x`` for a scalar, ``const double *x`` for a list or matrix argument that is not changed."""
    if isinstance(kind, List):
        qualifier = "const " if constant else ""
        return f"{qualifier}{C_TYPES[kind.element]} *{name}"
    assert not isinstance(kind, BoundFunction)  # which has no value
    if isinstance(kind, MatrixType):
        return f"{'const ' if constant else ''}{c_type(kind)} *{name}"
    return f"{c_type(kind)} {name}"


def member(variable: Variable, position: int) -> str:
    """Return the path of a variable's element in the block's struct: ``mass``, ``position.x[0]``, ``thrust[7]``."""
    name = identifier(variable.name)
    if variable.record is not None:
        return f"{name}.{_field_path(variable.record, position)}"
    if variable.is_vector or variable.shape:
        return f"{name}.x[{position}]"
    return f"{name}[{position}]" if variable.is_array else name


def _field_path(record: type[Record], position: int) -> str:
    """Return the path of a record's number in its struct: ``attitude.x[1]``."""
    for name, field in record.fields.items():
        size = count_numbers(field.kind)
        if position < size:
            if isinstance(field.kind, type) and issubclass(field.kind, Record):
                return f"{identifier(name)}.{_field_path(field.kind, position)}"
            return identifier(name) if field.kind in SCALARS else f"{identifier(name)}.x[{position}]"
        position -= size
    raise IndexError(position)


def comment(text: str) -> str:
    """Return text that is safe inside a C comment."""
    return text.replace("*/", "* /").replace("/*", "/ *")
