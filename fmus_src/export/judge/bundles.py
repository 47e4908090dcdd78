"""Replacement of bundle members in kernels: ``self.braking.burn_duration`` by ``self.braking_burn_duration``."""

from __future__ import annotations

import ast
import copy
from dataclasses import replace

from .kernel import Kernel, is_self_attribute
from .source import Source


def write_out_members(kernel: Kernel, source: Source) -> Source | None:
    """Return a method with bundle members replaced by the block's variables; None after a violation.

    ``self.command = self.braking`` becomes one assignment per member.
    """
    bundles = kernel.block_class.bundles
    if source.owner is None or not any(_is_bundle(node, bundles) for node in ast.walk(source.node)):
        return source
    writer = _WriteOut(kernel, source)
    node = writer.visit(copy.deepcopy(source.node))
    return None if writer.refused else replace(source, node=node)


def _is_bundle(node: ast.AST, bundles: object) -> bool:
    """Return True if a node is a whole bundle, such as ``self.command``."""
    return is_self_attribute(node) and node.attr in bundles  # type: ignore[attr-defined, operator]


class _WriteOut(ast.NodeTransformer):
    def __init__(self, kernel: Kernel, source: Source) -> None:
        self.kernel = kernel
        self.source = source
        self.bundles = kernel.block_class.bundles
        self.refused = False

    def refuse(self, node: ast.expr, rule: str, **details: object) -> ast.expr:
        self.kernel.report(self.source, node, rule, **details)
        self.refused = True
        return node

    def visit_Assign(self, node: ast.Assign) -> ast.AST | list[ast.AST]:
        target, source = node.targets[0], node.value
        if len(node.targets) > 1 or not (_is_bundle(target, self.bundles) and _is_bundle(source, self.bundles)):
            return self.generic_visit(node)
        stored, read = self.bundles[target.attr], self.bundles[source.attr]  # type: ignore[attr-defined]
        if stored.bundle is not read.bundle:
            return self.generic_visit(node)
        return [self.assign_member(node, stored.names[member], read.names[member]) for member in stored.names]

    def assign_member(self, node: ast.Assign, stored: str, read: str) -> ast.AST:
        """Return the assignment ``self.STORED = self.READ`` for one member of a bundle."""
        target = self.variable(node.targets[0], stored, ast.Store())
        return ast.copy_location(ast.Assign([target], self.variable(node.value, read, ast.Load())), node)

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        if _is_bundle(node, self.bundles):
            member = next(iter(self.bundles[node.attr].names))
            return self.refuse(node, "bundle", name=ast.unparse(node), member=member)
        if not _is_bundle(node.value, self.bundles):
            return self.generic_visit(node)
        bundle = self.bundles[node.value.attr]  # type: ignore[attr-defined]
        if node.attr not in bundle.names:
            names = ", ".join(bundle.names)
            return self.refuse(node, "field", kind=ast.unparse(node.value), name=node.attr, names=names)
        return self.variable(node, bundle.names[node.attr], node.ctx)

    def variable(self, node: ast.expr, name: str, context: ast.expr_context) -> ast.Attribute:
        """Return ``self.NAME`` as a node at the position of another."""
        me = ast.copy_location(ast.Name("self", ast.Load()), node)
        return ast.copy_location(ast.Attribute(me, name, context), node)
