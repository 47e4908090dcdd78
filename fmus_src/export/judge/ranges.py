"""Ranges of the ints in a kernel, to prove indices and sums valid before anything runs.

Whatever is not proven is checked at run time. A range is valid for the entire function, regardless of the order of its
statements; the ranges of arguments cover every call.
"""

from __future__ import annotations

import ast

from .expressions import is_read_only
from .kernel import (
    INT,
    BuiltinCall,
    Function,
    IntegerRange,
    Kernel,
    KernelCall,
    MatrixType,
    is_self_attribute,
    length_of,
    targets_of,
)
from .statements import range_step

INT64 = IntegerRange(-(2**63), 2**63 - 1)
INT32 = IntegerRange(-(2**31), 2**31 - 1)  # FMI Integers, hence inputs and parameters
EXACT = IntegerRange(-(2**53), 2**53)  # ints that a double holds exactly
ROUNDS_BEFORE_WIDENING = 4


def find_ranges(kernel: Kernel) -> None:
    """Determine ranges, callers first so that ranges of arguments are known; report values that are never valid."""
    for function in reversed(kernel.functions):
        ranges = _Ranges(kernel, function)
        ranges.settle()
        ranges.check()


class _Ranges:
    """Ranges of one function's variables and expressions."""

    def __init__(self, kernel: Kernel, function: Function) -> None:
        self.kernel = kernel
        self.function = function
        function.ranges = dict(function.parameter_ranges)
        self.loops = _loops_of_reads(function)

    def settle(self) -> None:
        """Join the ranges of all values assigned to each variable until none changes."""
        binding = (ast.For, ast.Assign, ast.AnnAssign)
        parts = [part for part in ast.walk(self.function.source.node) if isinstance(part, binding)]
        parts.sort(key=lambda part: (part.lineno, part.col_offset))  # in order of a variable's assignments
        rounds = 0
        changed = True
        while changed:
            rounds += 1
            changed = False
            for node in parts:
                for name, interval in self._assign(node):
                    before = self.function.ranges.get(name, interval)
                    after = before.join(interval)
                    if after != before and rounds > ROUNDS_BEFORE_WIDENING:
                        after = INT64
                    if after != self.function.ranges.get(name):
                        self.function.ranges[name] = after
                        changed = True

    def _assign(self, node: ast.AST) -> list[tuple[str, IntegerRange]]:
        """Return the ints that a statement assigns to variables, with their ranges."""
        if isinstance(node, ast.For) and isinstance(node.target, ast.Name) and isinstance(node.iter, ast.Call):
            return [(node.target.id, self.loop_range(node.iter))]
        if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
            names = [target.id for target in targets_of(node) if isinstance(target, ast.Name)]
            if len(targets_of(node)) > 1:
                return [(name, INT64) for name in names if self.function.locals.get(name) is INT]
            if names and self.function.types.get(node.value) is INT:
                return [(names[0], self.of(node.value))]
        return []

    def loop_range(self, call: ast.Call) -> IntegerRange:
        """Return the range of a loop variable."""
        bounds = [self.of(argument) for argument in call.args[:2]]
        first = bounds[0] if len(bounds) == 2 else IntegerRange(0, 0)
        stop = bounds[-1]
        if range_step(call) > 0:
            return IntegerRange(first.low, max(first.low, stop.high - 1))
        return IntegerRange(min(first.high, stop.low + 1), first.high)

    def of(self, node: ast.expr) -> IntegerRange:
        """Return the range of an int expression."""
        return _clamp(self.without_bounds(node))

    def without_bounds(self, node: ast.expr) -> IntegerRange:
        """Return the range of an int expression before it is limited to 64 bits."""
        if isinstance(node, ast.Constant) and isinstance(node.value, int):
            return IntegerRange(int(node.value), int(node.value))
        if node in self.function.constants and not isinstance(self.function.constants[node].value, tuple):
            value = self.function.constants[node].value
            return IntegerRange(int(value), int(value))
        if node in self.loops:
            return self.loop_range(self.loops[node])
        if isinstance(node, ast.Name):
            return self.function.ranges.get(node.id, INT64)
        holder = node.value if isinstance(node, ast.Subscript) else node
        if is_self_attribute(holder):
            return INT32 if is_read_only(self.function, holder) else INT64
        if isinstance(node, ast.UnaryOp):
            inner = self.of(node.operand)
            return IntegerRange(-inner.high, -inner.low) if isinstance(node.op, ast.USub) else inner
        if isinstance(node, ast.BinOp):
            return _combine(node.op, self.of(node.left), self.of(node.right))
        if isinstance(node, ast.IfExp):
            return self.of(node.body).join(self.of(node.orelse))
        if isinstance(node, ast.Call):
            return self._of_call(node)
        return INT64

    def _of_call(self, node: ast.Call) -> IntegerRange:
        call = self.function.calls.get(node)
        if isinstance(call, BuiltinCall):
            argument = self.function.types[node.args[0]]
            length = length_of(argument)
            if call.name == "len" and length is not None:
                return IntegerRange(length, length)
            if argument is INT:
                inner = self.of(node.args[0])
                if call.name == "abs":
                    low = 0 if inner.low <= 0 <= inner.high else min(abs(inner.low), abs(inner.high))
                    return IntegerRange(low, max(abs(inner.low), abs(inner.high)))
                return inner
        return INT64

    def check(self) -> None:
        """Record run-time checks, report definite errors, and pass ranges on to callees."""
        function = self.function
        for node, kind in list(function.types.items()):
            if isinstance(node, ast.Subscript) and node not in function.parts:
                for index, size in indices_of(function, node):
                    self._judge_index(node, index, size)
            computed = kind is INT and isinstance(node, ast.BinOp | ast.UnaryOp | ast.Call)
            if not function.is_total and computed and not self.without_bounds(node).within(INT64):
                function.unproven.add(node)
            if isinstance(node, ast.Compare):
                self._judge_mixed(node, "compared")
            elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
                self._judge_mixed(node, "divided")
        for node, call in function.calls.items():
            if isinstance(call, KernelCall):
                self._pass_on(call.callee, node.args)

    def _judge_index(self, node: ast.Subscript, index: ast.expr, size: int) -> None:
        interval = self.of(index)
        if not self.function.is_total and not interval.within(IntegerRange(0, size - 1)):
            self.function.unproven.add(node)
            self.function.unproven_indices.add(index)
        if interval.high < -size or interval.low >= size:
            self.kernel.report(
                self.function.source, node, "index", index=ast.unparse(index), name=ast.unparse(node.value), size=size
            )

    def _judge_mixed(self, node: ast.Compare | ast.BinOp, use: str) -> None:
        """Report mixed operands: Python compares ints with floats, and divides ints, exactly; C rounds the int."""
        operands = [node.left, node.right if isinstance(node, ast.BinOp) else node.comparators[0]]
        kinds = [self.function.types.get(operand) for operand in operands]
        exact = all(
            self.of(operand).within(EXACT) for operand, kind in zip(operands, kinds, strict=True) if kind is INT
        )
        both_ints = kinds[0] is INT and kinds[1] is INT
        matters = both_ints if isinstance(node, ast.BinOp) else INT in kinds and not both_ints
        if matters and not exact:
            self.kernel.report(self.function.source, node, "wide int", use=use)

    def _pass_on(self, callee: Function, arguments: list[ast.expr]) -> None:
        for (name, kind), argument in zip(callee.parameters.items(), arguments, strict=True):
            if kind is INT:
                interval = self.of(argument)
                callee.parameter_ranges[name] = callee.parameter_ranges.get(name, interval).join(interval)


def indices_of(function: Function, node: ast.Subscript) -> list[tuple[ast.expr, int]]:
    """Return the indices of an element, row or column, each with the size of its dimension."""
    kind = function.types[node.value]
    if not isinstance(kind, MatrixType):
        size = length_of(kind)
        assert size is not None
        return [(node.slice, size)]
    assert isinstance(node.slice, ast.Tuple)
    each = zip(node.slice.elts, function.blocks[node], (kind.rows, kind.columns), strict=True)
    return [(index, size) for index, block, size in each if block is None]


def _loops_of_reads(function: Function) -> dict[ast.expr, ast.Call]:
    """Return the loop's range for each read of a loop variable inside its loop, unless the body assigns it."""
    by_read: dict[ast.expr, ast.Call] = {}
    loops = [node for node in ast.walk(function.source.node) if isinstance(node, ast.For)]
    for loop in loops:  # outer loops first, so that inner ones overwrite them
        if isinstance(loop.target, ast.Name) and isinstance(loop.iter, ast.Call):
            name = loop.target.id
            uses = [part for child in loop.body for part in ast.walk(child)]
            named = [part for part in uses if isinstance(part, ast.Name) and part.id == name]
            if all(isinstance(part.ctx, ast.Load) for part in named):
                by_read |= dict.fromkeys(named, loop.iter)
    return by_read


def _clamp(interval: IntegerRange) -> IntegerRange:
    """Limit a range to 64 bits: larger values end the call with an error, so no variable contains them."""
    return IntegerRange(min(max(interval.low, INT64.low), INT64.high), max(min(interval.high, INT64.high), INT64.low))


def _combine(operator: ast.operator, left: IntegerRange, right: IntegerRange) -> IntegerRange:
    if isinstance(operator, ast.Add):
        return IntegerRange(left.low + right.low, left.high + right.high)
    if isinstance(operator, ast.Sub):
        return IntegerRange(left.low - right.high, left.high - right.low)
    if isinstance(operator, ast.Mult):
        corners = [a * b for a in (left.low, left.high) for b in (right.low, right.high)]
        return IntegerRange(min(corners), max(corners))
    if isinstance(operator, ast.FloorDiv) and right.low > 0:
        corners = [a // b for a in (left.low, left.high) for b in (right.low, right.high)]
        return IntegerRange(min(corners), max(corners))
    if isinstance(operator, ast.Mod) and right.low > 0:
        return IntegerRange(0, right.high - 1)
    return IntegerRange(-(2**63), 2**63)  # // and % by what may be 0, or -1: checked at run time
