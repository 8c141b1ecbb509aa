"""Prints regions as lines of text. Nesting is walked with a stack, for users write deep ``if``s."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from ...compiler.ir.node import Node
from ...compiler.ir.program import Branch, Let, Loop, Region, Statement
from ...compiler.ir.types import UINT, Scalar, ScalarKind
from .comments import comment_lines
from .context import Context
from .expressions import Expressions
from .literals import literal
from .namer import Namer
from .origins import Marks

INDENT = "    "

Lines: TypeAlias = Iterator["str | Lines"]
"""Lines of a block, and the lines of blocks inside it."""


class Statements:
    """Prints the statements of one function body."""

    def __init__(
        self, context: Context, expressions: Expressions, namer: Namer, marks: Marks
    ) -> None:
        self._forms = context.target.forms
        self._literals = context.target.literals
        self._types = context.types
        self._expressions = expressions
        self._namer = namer
        self._mark = marks.mark

    def lines(self, region: Region) -> list[str]:
        """The statements of ``region``; what they bind stays bound."""
        lines: list[str] = []
        open_ = [self._region(region)]
        while open_:
            item = next(open_[-1], None)
            if item is None:
                open_.pop()
            elif isinstance(item, str):
                lines.append(INDENT * (len(open_) - 1) + item)
            else:
                open_.append(item)
        return lines

    def _region(self, region: Region) -> Lines:
        for statement in region.statements:
            match statement:
                case Let():
                    yield from self._let(statement)
                case Branch():
                    yield from self._branch(statement)
                case Loop():
                    yield from self._loop(statement)

    def _let(self, let: Let) -> Lines:
        yield from comment_lines(let.doc, "//")
        value = self._expressions.expression(let.node).text
        name = self._bind(let)
        typed = self._types.declare(name, let.node.type)
        text = self._forms.let.format(name=name, typed=typed, value=value)
        yield self._mark(text, let.node)

    def _branch(self, branch: Branch) -> Lines:
        condition, then, otherwise = branch.node.operands
        test = self._expressions.text(condition)
        name = self._namer.declare(branch.name)
        typed = self._types.declare(name, branch.node.type)
        short = otherwise.op == "constant" and not branch.otherwise.statements
        if short:
            value = self._expressions.text(otherwise)
            text = self._forms.variable_set.format(name=name, typed=typed, value=value)
        else:
            text = self._forms.variable.format(name=name, typed=typed)
        yield self._mark(text, branch.node)
        yield self._mark(f"if ({test}) {{", condition)
        yield self._block(branch.then, name, "=", then)
        if not short:
            yield "} else {"
            yield self._block(branch.otherwise, name, "=", otherwise)
        yield "}"
        self._expressions.bound[branch.node.id] = name

    def _loop(self, loop: Loop) -> Lines:
        count = self._count(loop)
        start = self._expressions.text(loop.start)
        name = self._namer.declare(loop.name)
        text = self._forms.variable_set.format(
            name=name, typed=self._types.declare(name, loop.node.type), value=start
        )
        yield self._mark(text, loop.node)
        # Declared out here, since C-like languages once kept a loop's variable for what follows.
        index = self._namer.declare(loop.index.name)
        self._namer.enter()
        kind = loop.count.type.kind if isinstance(loop.count.type, Scalar) else "int"
        text = self._forms.loop.format(
            index=index,
            index_typed=self._types.declare(index, loop.count.type),
            zero=literal(0, kind, self._literals),
            count=count,
        )
        yield self._mark(text, loop.node)
        self._expressions.formals[loop.index] = index
        sign = "+=" if loop.operator == "add" else "*="
        yield self._block(loop.body, name, sign, loop.value)
        yield "}"
        self._namer.leave()
        self._expressions.bound[loop.node.id] = name

    def _count(self, loop: Loop) -> str:
        """How often to turn: never more than the bound, whatever the host has set."""
        kind: ScalarKind = "uint" if loop.count.type == UINT else "int"
        bound = literal(loop.bound, kind, self._literals)
        if isinstance(loop.count.data, int) and loop.count.op == "constant":
            return literal(min(loop.count.data, loop.bound), kind, self._literals)
        return f"min({self._expressions.text(loop.count)}, {bound})"

    def _block(self, region: Region, name: str, sign: str, value: Node) -> Lines:
        """A nested region that ends in giving ``value`` to the variable ``name``."""
        bound = self._expressions.bound
        outer = len(bound)
        self._namer.enter()
        yield from self._region(region)
        yield self._mark(f"{name} {sign} {self._expressions.text(value)};", value)
        self._namer.leave()
        while len(bound) > outer:
            bound.popitem()

    def _bind(self, statement: Statement) -> str:
        name = self._namer.declare(statement.name)
        self._expressions.bound[statement.node.id] = name
        return name
