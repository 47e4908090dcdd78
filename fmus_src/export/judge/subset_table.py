"""Subset of Python for kernels: allowed constructs, and alternatives for other constructs.

Kernels are `initialize`, `step` and every method and function they reach. They run as plain Python and are translated
to C99 with results equal to the last bit, so the subset contains only what has the same meaning in both languages.
"""

from __future__ import annotations

import ast
import math
from dataclasses import dataclass

from ...kernel import functions


@dataclass(frozen=True)
class SubsetRule:
    """Reason for rejecting a construct, and the alternative."""

    what: str
    remedy: str


@dataclass(frozen=True)
class MathFunction:
    """Function of numbers with identical bits in Python and C.

    ``faults`` are the exceptions that Python raises; without any, the C function is called directly, otherwise in its
    checked form in kernel_math.h. ``takes`` and ``returns`` are types of the subset; several values are returned
    together.
    """

    takes: tuple[str, ...] = ("float",)
    faults: tuple[str, ...] = ()
    returns: tuple[str, ...] = ("float",)


DOMAIN = ("ValueError",)
RANGE = ("OverflowError",)

TWO = ("float", "float")

# Exact, or correctly rounded, in every C library.
MATH_FUNCTIONS: dict[str, MathFunction] = {
    "sqrt": MathFunction(faults=DOMAIN),
    "fabs": MathFunction(),
    "fmod": MathFunction(TWO, DOMAIN),
    "copysign": MathFunction(TWO),
    "ldexp": MathFunction(("float", "int"), RANGE),
    "frexp": MathFunction(returns=("float", "int")),
    "floor": MathFunction(faults=DOMAIN + RANGE, returns=("int",)),
    "ceil": MathFunction(faults=DOMAIN + RANGE, returns=("int",)),
    "isfinite": MathFunction(returns=("bool",)),
    "isnan": MathFunction(returns=("bool",)),
}


def _read_rules(text: str) -> dict[str, SubsetRule]:
    """Return rules by name from pairs of lines: ``name: what is rejected``, then, indented, the alternative."""
    lines = text.strip().splitlines()
    rules = {}
    for first, remedy in zip(lines[::2], lines[1::2], strict=True):
        name, _, what = first.partition(": ")
        rules[name] = SubsetRule(what, remedy.strip())
    return rules


FAULTS_OF: dict[str | None, tuple[str, ...]] = {
    None: (),
    functions.DOMAIN_ERROR: DOMAIN,
    functions.RANGE_ERROR: RANGE,
    functions.EITHER_ERROR: DOMAIN + RANGE,
}


# Functions of `perilune` in place of those of `math`, with the same errors.
ELEMENTARY_FUNCTIONS: dict[str, MathFunction] = {
    function.__name__: MathFunction(("float",) * function.__code__.co_argcount, FAULTS_OF[error])
    for function, error in functions.FAULTS.items()
}

MATH_CONSTANTS: dict[str, float] = {"pi": math.pi, "tau": math.tau, "e": math.e, "inf": math.inf, "nan": math.nan}

BUILTIN_FUNCTIONS = ("abs", "float", "int", "len")  # and range, in a for statement

OPERATORS: tuple[type[ast.operator], ...] = (
    *(ast.Add, ast.Sub, ast.Mult, ast.Div, ast.MatMult, ast.FloorDiv, ast.Mod),
)
COMPARISONS: tuple[type[ast.cmpop], ...] = (ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Eq, ast.NotEq)

# By the node of `ast`.
REFUSED_SYNTAX: dict[type[ast.AST], SubsetRule] = {
    getattr(ast, node): rule
    for node, rule in _read_rules("""
Try: try: exceptions do not exist in a kernel
    test the condition with if before the operation
Raise: raise: a kernel cannot raise
    set the Integer output status and return
Assert: assert: a kernel cannot raise
    set the Integer output status, or test it in tests/
With: with: no objects in a kernel
    compute with floats, ints, bools and fixed lists only
Import: import inside a kernel
    import at the top of the module
ImportFrom: import inside a kernel
    import at the top of the module
Global: global: a kernel stores values in its block only
    declare a State on the block
Nonlocal: nonlocal: no nested functions
    declare a State on the block, or pass a list
Delete: del: a kernel frees no objects
    remove the statement
FunctionDef: a function inside a function
    move it to the module and pass what it needs
ClassDef: a class inside a function
    declare a State on the block
Lambda: lambda
    write a function in the module
Match: match
    write if and elif
ListComp: a list comprehension
    write a for loop over range that assigns one element at a time
GeneratorExp: a generator expression
    write a for loop over range that assigns one element at a time
SetComp: a set comprehension
    write a for loop over range that assigns one element at a time
DictComp: a dict comprehension
    write a for loop over range that assigns one element at a time
Dict: a dict
    use a list with a fixed meaning per index
Set: a set
    use a list of bools
Tuple: a tuple in a kernel
    write one statement per value; several values only in return a, b
List: a list inside an expression
    write vector(x, y, z), or give it a name of its own: name = [0.0] * n
Starred: a starred argument
    pass every argument by itself; only vector(*name[0:3]) takes one
JoinedStr: a string
    use an int and name its values as module constants
NamedExpr: an assignment inside an expression
    assign in a statement of its own
Yield: yield
    store values between steps in a State
Await: await
    remove it
Pow: the operator **
    write x * x, or pow(x, y) of perilune
LShift: a bit operator
    use *, // and % on ints
RShift: a bit operator
    use *, // and % on ints
BitAnd: a bit operator
    use `and` on bools; *, // and % on ints
BitOr: a bit operator
    use `or` on bools; *, // and % on ints
BitXor: a bit operator
    use != on bools; *, // and % on ints
Invert: a bit operator
    use `not` on bools
Is: `is`
    compare with ==
IsNot: `is not`
    compare with !=
In: `in`
    write a for loop with a comparison
NotIn: `not in`
    write a for loop with a comparison
""").items()
}

REFUSED_FUNCTIONS: dict[str, str] = {
    "hypot": "write math.sqrt(x * x + y * y); hypot of CPython differs from that of C in its last bits",
    "dist": "write math.sqrt of the sum of squares",
    "fsum": "add in a for loop",
    "sum": "add in a for loop, starting from 0.0",
    "min": "write the comparison with if, or use clip of perilune.fmus_src.mathlib.vectors",
    "max": "write the comparison with if, or use clip of perilune.fmus_src.mathlib.vectors",
    "round": "write math.floor(x + 0.5)",
    "bool": "write x != 0.0 or n != 0",
    "divmod": "write // and % separately",
    "pow": "write from perilune import pow",
    "print": "put the value on an Output",
    "range": "use range in a for statement only",
    "list": "declare [0.0] * n and copy in a for loop",
    "enumerate": "write for i in range(n)",
    "zip": "write for i in range(n)",
    "sorted": "write the comparisons",
    "degrees": "stay in radians; multiply by 180.0 / math.pi where a table needs degrees",
    "radians": "stay in radians; multiply by math.pi / 180.0 where a table needs degrees",
}

REFUSED_MATH = "write from perilune import {name}: the C library's result depends on the processor"

LANGUAGE_PAGE = "What a kernel may use"  # of the documentation site, derived from this file
OTHER_SYNTAX = SubsetRule("{name} is outside of the subset", f'write what the page "{LANGUAGE_PAGE}" lists')
OTHER_FUNCTION = f'use a function of the page "{LANGUAGE_PAGE}", define one in the file, or declare python_only = True'

# Rules for constructs composed of allowed elements.
RULES: dict[str, SubsetRule] = _read_rules("""
no source: {name}: its source cannot be read
    define it in a .py file
no initialize: {name}: initialize is not a method
    write def initialize(self) -> None
no variables: {name} declares no variables
    declare its inputs, parameters, states and outputs
python only: {name} declares python_only
    it has no C form; build its Python flavour
decorator: {name} has a decorator
    write a plain method, or a function in the module
signature: {name}: {detail}
    declare every argument as float, int, bool, Vector3, Matrix or list, without defaults
return type: {name}: no return type of the subset
    declare -> None, float, int, bool, Vector3, Matrix or tuple[float, Vector3]; pass a list to be filled
missing return: {name}: a path ends without return
    return a value at the end
return value: returns {got}, declared {expected}
    return the declared type; float(n) widens an int
recursion: {name} calls itself, directly or through others
    write a for loop with a bound
unbound: {name} may be read before it is assigned
    give it a value before the if or the loop
no import: {name} is not imported
    write {words} at the top of the file
unknown name: {name} is not a local variable, kernel function or constant of the module
    assign it first, or define it as a float or int constant of the module
undeclared: self.{name} is not declared
    declare it in the class: {name} = State(...)
read-only: {name} is an input, a parameter or a constant and is changed here
    copy it to a State
list rebound: the list {name} is rebound
    copy element by element: for i in range(n)
list shared: a list is given a second name
    declare [0.0] * n and copy element by element
list size: the list {name} has no fixed size here
    write [0.0] * n with n an int constant, or [0.0] * (n + 2)
list literal: {detail}
    write a list of floats, of ints or of bools, or [0.0] * n
list replaces itself: a new value of {name} reads the old one
    assign its elements one at a time
index: index {index} is outside {name}, which has {size} elements
    correct the index or the size
type change: {name} is {before} and becomes {after}
    use two variables; start floats from 0.0; float(n)
argument type: {name} takes {expected} for {argument}, got {got}
    float(n) widens an int
argument count: {name} takes {expected} arguments, got {got}
    pass every argument
keyword: an argument passed by name
    pass arguments by position
number: {name} of {got}
    use numbers; bools and lists have no arithmetic
condition: {got} used as a truth value
    compare it: x != 0.0, n != 0
comparison: {left} compared with {right}
    compare numbers with numbers, bools with == or !=
chained comparison: a chained comparison
    write a < b and b < c
branches: one value is {left}, the other {right}
    give both the same type; float(n) widens an int
wide int: an int that may exceed 2^53 is {use} as a float would be
    convert it first: float(n), which rounds it once
int literal: an int beyond 64 bits
    write it as a float
no effect: an expression without effect
    assign it, or remove it
string: a string or other constant
    use an int and name its values as module constants
function: {name} is not in the subset
    {remedy}
changes inside expression: {name} changes its arguments or the block inside a larger expression
    call it in a statement of its own: x = {name}(...)
conditional order: this part of an and, or, or if-else expression can fail in more than one way
    assign its parts to variables first, or write nested ifs
one target: an assignment to several targets
    write one statement per target
number of targets: {targets} targets for {got}
    write one target per value
several values: {name} returns {got}
    assign them in a statement of their own: a, b = {name}(...)
vector sizes: a {left} with a {right}
    use vectors of one size
vector operator: operator {name} of {left} and {right}
    vectors take + - * / with vectors of their size, and * / with numbers; dot(a, b) is the scalar product
vector size: a vector of {got}
    make it of two, three or four, or use a list
matrix operator: operator {name} of {left} and {right}
    matrices take + - with their like, @ with matrices and vectors, * and / by numbers; dot(a, b) is of two vectors
matrix sizes: a {left} with a {right}
    use matrices whose rows and columns fit
matrix size: {name} with a size that is not a constant int above 0
    write zeros(6, N + 2) or identity(len(p)): of ints, int constants of the module, lengths, and + - * // % of these
matrix rows: matrix of anything but rows of floats, all of one length
    write matrix([a, b], [c, d])
matrix sum: add_product of anything but three matrices whose sizes fit
    write add_product(q, a, b) where q + a @ b has a value
matrix index: {name} is a matrix and takes two indices
    write p[i, j], p[i, :] or p[POSITION, VELOCITY] with POSITION = block(0, 3) in the module
matrix block: {part} is neither an int nor a block inside the matrix
    write POSITION = block(0, 3) in the module, or constant bounds 0:3
matrix shared: {name} is a second name of the matrix {value}
    write {value}.copy()
matrix rebound: the argument {name} is a matrix and is assigned another
    assign its elements, {name}[:, :] = ..., or use a variable of its own
matrix changed: {name} changes its argument {argument}, which is also used elsewhere or is not a variable
    pass a variable that is used for it only, or a copy()
list for vector: a {left} with a {right}
    make the list a vector: vector(*name), vector(*name[0:3])
list and vector: {name} takes a {expected} for {argument}, got a {got}
    vector(*name) makes a vector of a list; a list takes a vector's elements one at a time
list stored: a list is stored in the vector {name}
    write {name} = vector(x, y, z), or vector(*name)
component: a {kind} has no component {name}
    it has {names}; or write v[k]
component assigned: {name} is a vector, whose components cannot be assigned
    make a new one: {name} = vector(x, y, z); or declare it with vector=False, which makes it a list
record operator: operator {name} of {left} and {right}
    records of floats and vectors take + - with their like, and * / with numbers
record: {name} without each of its fields in their order
    write {name}({names})
record names: {name} uses two records of the same name, {first} and {second}
    give one of them another name: C has a struct for each
replace: replace of anything but a named record
    write replace(record, field=value)
field: {kind} has no field {name}
    it has {names}
field assigned: {name} is a record, whose fields cannot be assigned
    make a new one: {name} = replace({name}, field=value)
bundle: {name} is a bundle, which is not a value
    write its members, {name}.{member}, or assign it to another of its kind: self.command = self.braking
derivatives: {name} is given to a function to be called, and changes its arguments or the block
    return the result, and assign it where the state is declared
part: {part} does not select two to four of its {size} elements
    write constants from 0 to {size}
part of a list: {part} is a list in Python
    write vector(*{part}), or a for loop over range
part of an expression: a part of {name}
    give it a name first
target: an assignment to anything but a variable, self.name or an element
    assign one of these
for range: for over anything but range
    write for i in range(n)
range step: the step of range is not a constant
    write a non-zero int literal, or a while loop
loop else: else of a loop
    set a bool in the loop and test it afterwards
""")
