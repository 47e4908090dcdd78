"""Determination of the parameters that may change between steps, with a reason for each that may not.

A parameter is tunable if functions reached by `step` read it, and if no variable that the steps read but never write
depends on it through `initialize`: the next step then gives, from the present states, the same result as if the
parameter had always had its new value. Dependences are determined regardless of the order of assignments, and include
control dependence (Ferrante, Ottenstein and Warren 1987): a test affects the assignments in its branches, and
statements after a return, break or continue inside them.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Mapping
from weakref import WeakKeyDictionary

from ...block import Block
from ...roles import SAMPLE_PERIOD
from ...variables import Output, Parameter, State
from .kernel import (
    BoundFunction,
    Function,
    Kernel,
    KernelCall,
    List,
    MatrixType,
    body_of,
    is_self_attribute,
    targets_of,
)
from .typed import typecheck

SELF = "self."  # prefix of block variables among locals and arguments
PERIOD_REASON = "the sample period"
PYTHON_ONLY, OTHER_PYTHON = (
    "a block with Python only proves nothing",
    "a block outside the kernel language proves nothing",
)
AT_START, NEVER_READ = "read at the start only", "never read"
COMPUTED_ONCE = "a variable that is computed once follows from it: {}"
JUMPS = (ast.Return, ast.Break, ast.Continue)
Names = frozenset[str]


KNOWN: WeakKeyDictionary[type[Block], Mapping[str, str | None]] = WeakKeyDictionary()  # documents and C need it often


def find_fixed(block_class: type[Block]) -> Mapping[str, str | None]:
    """Return by name the reason why each parameter is fixed after initialisation, or None if it is tunable."""
    if block_class not in KNOWN:
        KNOWN[block_class] = _find_reasons(block_class)
    return KNOWN[block_class]


def tunable_parameters(block_class: type[Block]) -> list[str]:
    """Return the names of a block's tunable parameters in order of declaration."""
    return [name for name, reason in find_fixed(block_class).items() if reason is None]


def _find_reasons(block_class: type[Block]) -> Mapping[str, str | None]:
    parameters = {name: each for name, each in block_class.variables.items() if isinstance(each, Parameter)}
    kernel = None if block_class.python_only else typecheck(block_class)
    if kernel is None or kernel.step is None or kernel.violations:
        unproved = PYTHON_ONLY if kernel is None else OTHER_PYTHON
        reasons: dict[str, str | None] = dict.fromkeys(parameters, unproved)
    else:
        reasons = _prove(kernel, parameters)
    reasons |= {name: each.fixed for name, each in parameters.items() if each.fixed}
    return reasons | ({SAMPLE_PERIOD: PERIOD_REASON} if SAMPLE_PERIOD in parameters else {})


def _prove(kernel: Kernel, parameters: Iterable[str]) -> dict[str, str | None]:
    assert kernel.step is not None
    flows: dict[Function, _Flow] = {}
    for function in kernel.functions:  # callees before callers
        flows[function] = _Flow(function, flows)
    start = flows[kernel.initialize].sources if kernel.initialize else {}
    at_start = _reads(kernel.initialize) if kernel.initialize else set()
    in_steps, written = _reads(kernel.step), flows[kernel.step].sources
    variables = kernel.block_class.variables
    reasons: dict[str, str | None] = {}
    for name in parameters:
        following = _following(start, SELF + name)
        constant = [
            each
            for each, variable in variables.items()
            if isinstance(variable, State | Output)
            and SELF + each in following
            and SELF + each not in written
            and (each in in_steps or isinstance(variable, Output))
        ]
        if constant:
            reasons[name] = COMPUTED_ONCE.format(", ".join(constant))
        elif name in in_steps:
            reasons[name] = None
        else:
            reasons[name] = AT_START if name in at_start else NEVER_READ
    return reasons


def _following(sources: dict[str, Names], name: str) -> set[str]:
    """Return all names that depend on a name, directly or indirectly."""
    reached = {name}
    while True:
        more = {each for each, origins in sources.items() if not origins.isdisjoint(reached)}
        if more <= reached:
            return reached
        reached |= more


def _reads(function: Function) -> set[str]:
    """Return the names of the block's variables that a function or its callees read."""
    names: set[str] = set()
    known, ahead = {function}, [function]
    while ahead:
        each = ahead.pop()
        nodes = [part for statement in body_of(each.source.node) for part in ast.walk(statement)]
        stored = {id(_holder(part)) for part in nodes if isinstance(getattr(part, "ctx", None), ast.Store)}
        loaded = [part.attr for part in nodes if isinstance(part, ast.Attribute) and is_self_attribute(part)
                  and id(part) not in stored]  # fmt: skip
        names.update(name for name in loaded if name in each.block_class.variables)
        ahead += [callee for callee in each.callees() if callee not in known]
        known.update(ahead)
    return names


def _holder(target: ast.AST) -> ast.AST:
    """Return the name, or ``self.name``, whose value an assignment to an element or a block changes."""
    while isinstance(target, ast.Subscript):
        target = target.value
    return target


class _Flow:
    """Dependences in one function: ``sources`` of each local, argument and ``self.NAME`` that it assigns.

    Sources of the returned value are included. Each is a set of the function's arguments and of the block's variables.
    """

    def __init__(self, function: Function, flows: dict[Function, _Flow]) -> None:
        self.function = function
        self.flows = flows
        self.returned: Names = frozenset()
        self.sources: dict[str, Names] = {name: frozenset({name}) for name in function.parameters}
        self.assigned: set[str] = set()
        before = -1
        while before != (before := self._size()):
            self._block(body_of(function.source.node), frozenset())
        changeable = {name for name, kind in function.parameters.items() if isinstance(kind, List | MatrixType)}
        self.changed = {name: self.sources[name] for name in changeable & self.assigned}
        self.sources = {name: origins for name, origins in self.sources.items() if name.startswith(SELF)}

    def _size(self) -> int:
        return len(self.returned) + sum(1 + len(origins) for origins in self.sources.values())

    def _block(self, statements: list[ast.stmt], deciding: Names) -> None:
        """Process statements whose execution depends on ``deciding``."""
        for statement in statements:
            self._statement(statement, deciding)
            deciding |= self._leaving([statement], JUMPS) or frozenset()

    def _statement(self, node: ast.stmt, deciding: Names) -> None:
        if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
            origins = self._read(node.value, deciding) | deciding
            for target in targets_of(node):
                self._assign(target, origins)
        elif isinstance(node, ast.Return):
            self.returned |= deciding | (self._read(node.value, deciding) if node.value else frozenset())
        elif isinstance(node, ast.Expr):
            self._read(node.value, deciding)
        elif isinstance(node, ast.If):
            deciding |= self._test(node)
            self._block(node.body, deciding)
            self._block(node.orelse, deciding)
        elif isinstance(node, ast.While | ast.For):
            deciding |= self._test(node) | (self._leaving(node.body, JUMPS) or frozenset())
            if isinstance(node, ast.For):
                self._assign(node.target, deciding)
            self._block(node.body, deciding)

    def _test(self, node: ast.If | ast.While | ast.For) -> Names:
        return self._read(node.iter if isinstance(node, ast.For) else node.test, frozenset())

    def _leaving(self, statements: list[ast.stmt], jumps: tuple[type[ast.stmt], ...]) -> Names | None:
        """Return the names that decide whether a jump leaves the statements; None if there is no such jump."""
        origins: Names | None = None
        for node in statements:
            inside: Names | None = frozenset() if isinstance(node, jumps) else None
            if isinstance(node, ast.If):
                inside = self._leaving(node.body + node.orelse, jumps)
            elif isinstance(node, ast.While | ast.For):
                inside = self._leaving(node.body, (ast.Return,))
            if inside is not None:
                test = self._test(node) if isinstance(node, ast.If | ast.While | ast.For) else frozenset()
                origins = (origins or frozenset()) | inside | test
        return origins

    def _assign(self, target: ast.AST, origins: Names) -> None:
        for part in ast.walk(target):
            if isinstance(part, ast.Subscript):
                origins |= self._read(part.slice, frozenset())
        holder = _holder(target)
        name = SELF + holder.attr if isinstance(holder, ast.Attribute) else ast.unparse(holder)
        self.assigned.add(name)
        self.sources[name] = self.sources.get(name, frozenset()) | origins

    def _read(self, node: ast.AST, deciding: Names) -> Names:
        """Return the names on which an expression depends, and record the assignments of its calls."""
        if isinstance(node, ast.expr) and isinstance(self.function.types.get(node), BoundFunction):
            return frozenset()
        if isinstance(node, ast.Attribute) and is_self_attribute(node):
            return frozenset({SELF + node.attr})
        if isinstance(node, ast.Name):
            return self.sources.get(node.id, frozenset())
        call = self.function.calls.get(node) if isinstance(node, ast.Call) else None
        if isinstance(node, ast.Call) and isinstance(call, KernelCall):
            return self._call(call.callee, node.args, deciding)
        return frozenset().union(*(self._read(part, deciding) for part in ast.iter_child_nodes(node)))

    def _call(self, callee: Function, arguments: list[ast.expr], deciding: Names) -> Names:
        flow = self.flows[callee]
        passed = dict(zip(callee.parameters, arguments, strict=True))
        origins_of = {name: self._read(argument, deciding) for name, argument in passed.items()}

        def here(origins: Names) -> Names:
            return frozenset().union(*(origins_of.get(name, frozenset({name})) for name in origins))

        for name, origins in flow.sources.items():
            self.sources[name] = self.sources.get(name, frozenset()) | here(origins) | deciding
        for name, origins in flow.changed.items():
            self._assign(passed[name], here(origins) | deciding)
        return here(flow.returned)
