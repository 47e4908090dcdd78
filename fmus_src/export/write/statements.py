"""C text of the statements in a kernel function."""

from __future__ import annotations

import ast

from ..judge.effects import makes_matrix
from ..judge.kernel import Function, KernelCall, List, MatrixType, Several
from ..judge.statements import is_list_binding, range_step
from .expressions import ExpressionWriter
from .matrices import MatrixWriter
from .names import Names, identifier
from .placement import list_assigned
from .writer import ZERO, FunctionWriter

FEW = 8  # largest number of elements unrolled in place of a loop


class StatementWriter(FunctionWriter):
    """Writer of one function's statements.

    A statement that can record a fault is followed by a check that returns; a value to be assigned to the block or an
    argument is first stored in a local variable, so that a fault leaves the same values as an exception in Python.
    """

    def __init__(self, function: Function, names: Names) -> None:
        super().__init__(function, names)
        self.expressions = ExpressionWriter(self)
        self.matrices = self.expressions.matrices = MatrixWriter(self, self.expressions)

    def block(self, statements: list[ast.stmt]) -> None:
        """Write statements in order, each preceded by its comments."""
        outer_names = set(self.used)
        for statement in statements:
            self.comments_before(statement)
            self.line = statement.lineno
            for name in self.placement.before.get(statement, []):
                self.lines.add(f"{self.declare(name)};")
            self.write(statement)
            self.last_line = max(self.last_line, statement.end_lineno or 0)
        self.used = outer_names  # variables of a C block end with it

    def write(self, statement: ast.stmt) -> None:
        """Write an accepted statement."""
        match statement:
            case ast.Assign():
                self.write_assign(statement)
            case ast.AnnAssign():
                self.write_annassign(statement)
            case ast.Expr():
                self.write_expr(statement)
            case ast.If():
                self.write_if(statement)
            case ast.For():
                self.write_for(statement)
            case ast.While():
                self.write_while(statement)
            case ast.Return():
                self.write_return(statement)
            case ast.Pass():
                pass
            case ast.Break():
                self.add("break;")
            case ast.Continue():
                self.add("continue;")
            case _:
                raise TypeError(f"{type(statement).__name__} passed the kernel check but cannot be translated")

    def write_expr(self, node: ast.Expr) -> None:
        text = self.expressions.write(node.value)
        self.add(f"{text};")
        if self.can_fault(node.value):
            self.check()

    def write_return(self, node: ast.Return) -> None:
        self.add(f"return {self.expressions.write(node.value)};" if node.value is not None else "return;")

    def write_assign(self, node: ast.Assign) -> None:
        target = node.targets[0]
        if isinstance(target, ast.Tuple):
            self.unpack(node, target, node.value)
        else:
            self.assign(node, target, node.value)

    def write_annassign(self, node: ast.AnnAssign) -> None:
        assert node.value is not None
        self.assign(node, node.target, node.value)

    def assign(self, node: ast.stmt, target: ast.expr, value: ast.expr) -> None:
        """Write ``target = value``; the first assignment of a local variable declares it if its uses allow."""
        if is_list_binding(value):
            assert isinstance(target, ast.Name)
            self.bind_list(node, target.id, value)
            return
        makes = makes_matrix(self.function, value) and not isinstance(self.function.calls.get(value), KernelCall)  # type: ignore[call-overload]
        whole = makes and isinstance(self.function.types[value], MatrixType)
        if whole or self.function.blocks.get(target, (None, None)) != (None, None):
            self.matrices.assign(node, target, value)
            return
        text = self.expressions.write(value)
        if isinstance(target, ast.Name):
            left = self.declare(target.id) if self.placement.declares(node, target.id) else identifier(target.id)
            self.add(f"{left} = {text};")
            if self.can_fault(value):
                self.check()
            return
        fails = self.can_fault(value)
        if (fails and not self._is_local_element(target)) or self._changes_anything(value):
            holder = target.value if isinstance(target, ast.Subscript) else target
            name = holder.attr if isinstance(holder, ast.Attribute) else ast.unparse(holder)
            text = self.keep(value, text, f"new_{name}")
            fails = False
        self._store(target, text)
        if fails:
            self.check()

    def unpack(self, node: ast.stmt, target: ast.Tuple, value: ast.expr) -> None:
        """Write ``a, b = function(...)`` or ``x, y, z = v``."""
        whole = self.keep(value, self.expressions.write(value), "parts")
        several = isinstance(self.function.types[value], Several)
        known = {*self.function.locals, *self.function.parameters}
        for number, part in enumerate(target.elts):
            text = f"{whole}.part{number}" if several else f"{whole}.x[{number}]"
            if isinstance(part, ast.Name) and part.id not in known:
                continue  # _, which nothing reads
            if isinstance(part, ast.Name):
                left = self.declare(part.id) if self.placement.declares(node, part.id) else identifier(part.id)
                self.add(f"{left} = {text};")
            else:
                self._store(part, text)

    def _store(self, target: ast.expr, text: str) -> None:
        if isinstance(target, ast.Subscript) and self.can_fault(target):
            place = self.fresh("place")
            is_matrix = target in self.function.blocks
            index = self.matrices.place(target) if is_matrix else self.expressions.index(target)
            self.add(f"const int64_t {place} = {index};")
            self.check()
            if is_matrix:
                self.add(f"{self.matrices.holder(target.value)}[{place}] = {text};")
            else:
                self.add(f"{self.expressions.write(target.value)}{self.expressions.place(target, place)} = {text};")
        else:
            self.add(f"{self.expressions.write(target)} = {text};")

    def _is_local_element(self, target: ast.expr) -> bool:
        """Return True if a target is an element, with a proven index, of a list local to the function."""
        if not isinstance(target, ast.Subscript) or not isinstance(target.value, ast.Name):
            return False
        return target.value.id in self.function.locals and not self.can_fault(target)

    def _changes_anything(self, value: ast.expr) -> bool:
        call = self.function.calls.get(value) if isinstance(value, ast.Call) else None
        return isinstance(call, KernelCall) and call.callee.changes_anything

    def bind_list(self, node: ast.stmt, name: str, value: ast.expr) -> None:
        """Write ``name = [a, b]`` or ``name = [a] * n``."""
        kind = self.function.locals[name]
        assert isinstance(kind, List)
        declares = self.placement.declares(node, name)
        if isinstance(value, ast.BinOp):
            assert isinstance(value.left, ast.List)
            self._fill(name, value.left.elts[0], kind, declares)
            return
        assert isinstance(value, ast.List)
        items = []
        for element in value.elts:
            text = self.expressions.write(element)
            items.append(self.keep(element, text, "part") if self.can_fault(element) else text)
        if declares:
            self.add(f"{self.declare(name)} = {{{', '.join(items)}}};")
        else:
            for index, item in enumerate(items):
                self.add(f"{identifier(name)}[{index}] = {item};")

    def _fill(self, name: str, item: ast.expr, kind: List, declares: bool) -> None:
        text = self.expressions.write(item)
        if not isinstance(item, ast.Constant):
            text = self.keep(item, text, "fill")
        if declares and (kind.size <= FEW or text == ZERO[kind.element]):
            items = [text] * (kind.size if kind.size <= FEW else 1)  # C fills the rest with zeros
            self.add(f"{self.declare(name)} = {{{', '.join(items)}}};")
            return
        if declares:
            self.add(f"{self.declare(name)};")
        k = self.fresh("k")
        self.add(f"for (int {k} = 0; {k} < {kind.size}; {k}++) {identifier(name)}[{k}] = {text};")

    def write_if(self, node: ast.If) -> None:
        self.lines.open(f"if ({self._condition(node.test, 'condition')}) {{", self.line)
        self.block(node.body)
        if node.orelse:
            self._else(node.orelse)
        self.lines.close("}")

    def _condition(self, test: ast.expr, name: str) -> str:
        """Return the C text of a condition, stored in a checked variable if it can fail."""
        text = self.expressions.write(test)
        return self.keep(test, text, name) if self.can_fault(test) else text

    def _else(self, statements: list[ast.stmt]) -> None:
        """Write an else branch, as ``else if`` if no statement must precede the condition."""
        inner = statements[0]
        if len(statements) == 1 and isinstance(inner, ast.If) and self._is_plain(inner):
            self.comments_before(inner)
            self.lines.reopen(f"}} else if ({self.expressions.write(inner.test)}) {{", inner.lineno)
            self.block(inner.body)
            if inner.orelse:
                self._else(inner.orelse)
        else:
            self.lines.reopen("} else {")
            self.block(statements)

    def _is_plain(self, node: ast.If) -> bool:
        """Return True if an if statement needs no declaration or check before it."""
        declares = node in self.placement.before
        hoists = any(part in self.function.hoisted for part in ast.walk(node.test))
        return not (declares or hoists or self.can_fault(node.test) or self._makes_matrices(node.test))

    def _makes_matrices(self, test: ast.expr) -> bool:
        """Return True if a condition needs statements before it."""
        return any(makes_matrix(self.function, part) for part in ast.walk(test))

    def write_while(self, node: ast.While) -> None:
        hoists = any(part in self.function.hoisted for part in ast.walk(node.test))
        if hoists or self.can_fault(node.test) or self._makes_matrices(node.test):
            self.lines.open("for (;;) {", self.line)
            goes_on = self._condition(node.test, "goes_on")
            self.add(f"if (!({goes_on})) break;")
        else:
            self.lines.open(f"while ({self.expressions.write(node.test)}) {{", self.line)
        self.block(node.body)
        self.lines.close("}")

    def write_for(self, node: ast.For) -> None:
        assert isinstance(node.iter, ast.Call)
        assert isinstance(node.target, ast.Name)
        bounds = self._bounds(node, node.iter)
        first = bounds[0] if len(bounds) == 2 else "0"
        plain = node in self.placement.plain_loops
        variable = identifier(node.target.id)
        counter = variable if plain else self.fresh(f"{variable}_counter".strip("_"))
        step = range_step(node.iter)
        compare = "<" if step > 0 else ">"
        advance = {1: f"{counter}++", -1: f"{counter}--"}.get(
            step, f"{counter} {'+' if step > 0 else '-'}= {abs(step)}"
        )
        self.lines.open(f"for (int64_t {counter} = {first}; {counter} {compare} {bounds[-1]}; {advance}) {{", self.line)
        if not plain:  # Python's loop variable may be assigned in the loop and keeps its last value
            self.add(f"{variable} = {counter};")
        self.block(node.body)
        self.lines.close("}")

    def _bounds(self, node: ast.For, call: ast.Call) -> list[str]:
        """Return first and last bound, stored in variables if their value could change during the loop."""
        changed = list_assigned([node])
        stop = call.args[:2][-1]
        texts = []
        for argument in call.args[:2]:
            text = self.expressions.write(argument)
            fixed = isinstance(argument, ast.Constant) or argument in self.function.constants
            stays = isinstance(argument, ast.Name) and argument.id not in changed
            is_length = text.isdigit()
            if not (fixed or stays or is_length):
                assert isinstance(node.target, ast.Name)
                text = self.keep(
                    argument, text, f"{identifier(node.target.id)}_{'stop' if argument is stop else 'first'}"
                )
            texts.append(text)
        return texts
