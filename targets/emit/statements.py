"""Prints the statements of a region as lines of text.

``stage.py`` makes a ``Statements`` for each function body. The look of a statement is a form of the
language (``forms.py``). Nested regions are walked with a stack, since materials may nest ``if``
deeply.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TypeAlias

from ...compiler.ir.node import Node
from ...compiler.ir.statements import Branch, Connective, Iterate, Let, Loop, Region
from ...compiler.ir.types import UINT, Scalar, ScalarKind
from .comments import comment_lines
from .context import Context
from .expressions import Expressions
from .literals import literal
from .namer import Namer
from .origins import Mark
from .precedence import NAME, Field, prefix

INDENT = "    "

Lines: TypeAlias = Iterator["str | Lines"]
"""The lines of a block; an iterator among them yields the lines of a block inside it."""


class Statements:
    """Prints the statements of one function body."""

    def __init__(
        self, context: Context, expressions: Expressions, namer: Namer, mark: Mark
    ) -> None:
        self._forms = context.language.forms
        self._literals = context.language.literals
        self._types = context.types
        self._expressions = expressions
        self._in_place = context.in_place
        self._namer = namer
        self._mark = mark

    def lines(self, region: Region) -> list[str]:
        """The indented statements of ``region``. Names that they bind can be used afterwards."""
        return self.laid_out(self._region(region))

    def laid_out(self, block: Lines) -> list[str]:
        """The lines of a block, with those of the blocks inside it indented."""
        lines: list[str] = []
        open_ = [block]
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
                case Let() if statement.node in self._in_place:
                    continue
                case Let():
                    yield from comment_lines(statement.doc, "//")
                    if self._is_filled(statement.node):
                        yield from self._filled(statement)
                    else:
                        yield self._let(statement)
                case Branch():
                    yield from self._branch(statement)
                case Connective():
                    yield from self._connective(statement)
                case Loop():
                    yield from self._loop(statement)
                case Iterate():
                    yield from self._iterate(statement)

    def _let(self, let: Let) -> str:
        value = self._expressions.expression(let.node)[0]
        name = self._namer.declare(let.name)
        self._expressions.bound[let.node] = name, NAME
        typed = self._types.declare(name, let.node.type)
        text = self._form(let.node).format(name=name, typed=typed, value=value)
        return self._mark(text, let.node)

    def _is_filled(self, node: Node) -> bool:
        """True if a node is an array whose elements have to be assigned one by one."""
        if node.op != "array":
            return False
        if not self._forms.array:
            return True
        return not self._forms.array_of_block and self._expressions.is_block(node.operands)

    def _filled(self, let: Let) -> Lines:
        """A variable for an array, and the assignments of its elements."""
        values = [self._expressions.text(element) for element in let.node.operands]
        name = self._namer.declare(let.name)
        self._expressions.bound[let.node] = name, NAME
        typed = self._types.declare(name, let.node.type)
        yield self._mark(self._forms.variable.format(name=name, typed=typed), let.node)
        array = Field(name, NAME)
        for position, (value, node) in enumerate(zip(values, let.node.operands, strict=True)):
            element = self._forms.element.format(aggregate=array, position=position)
            yield self._mark(self._forms.assign.format(name=element, value=value), node)

    def _form(self, node: Node) -> str:
        """The form of the statement that binds a name to a node."""
        if node.op != "array":
            return self._forms.let
        constant = all(element.op == "constant" for element in node.operands)
        return self._forms.constant_array if constant else self._forms.variable_set

    def _branch(self, branch: Branch) -> Lines:
        otherwise = branch.node.operands[2]
        short = otherwise.op == "constant" and not branch.otherwise.statements
        # Values that are known before the branch are printed before its name is declared.
        test = self._test(branch)
        value = self._expressions.text(otherwise) if short else ""
        name = self._namer.declare(branch.name)
        if short:
            yield self._variable(name, branch.node, value)
        else:
            typed = self._types.declare(name, branch.node.type)
            yield self._mark(self._forms.variable.format(name=name, typed=typed), branch.node)
        yield self._opened_branch(self._forms.if_, branch, test)
        yield from self._sides(branch, name, short=short)
        self._expressions.bound[branch.node] = name, NAME

    def _test(self, branch: Branch) -> str:
        return self._expressions.text(branch.node.operands[0])

    def _opened_branch(self, form: str, branch: Branch, test: str) -> str:
        return self._mark(form.format(condition=test), branch.node.operands[0])

    def _sides(self, branch: Branch, name: str, *, short: bool) -> Lines:
        """Both sides of a branch, or its first one (``short``), after the line that opens it.

        A branch that is all of the second side goes on as ``else if``.
        """
        yield self._block(branch.then, name, branch.node.operands[1])
        while not short and (inner := _only_branch(branch)):
            branch = inner
            yield self._opened_branch(self._forms.else_if, branch, self._test(branch))
            yield self._block(branch.then, name, branch.node.operands[1])
        if not short:
            yield self._forms.else_
            yield self._block(branch.otherwise, name, branch.node.operands[2])
        yield self._forms.end

    def _connective(self, connective: Connective) -> Lines:
        """A variable with the left operand; the right one replaces it if it is needed."""
        left, right = connective.node.operands
        value = self._expressions.text(left)
        name = self._namer.declare(connective.name)
        yield self._variable(name, connective.node, value)
        is_open = name if connective.node.data == "and" else prefix("!", (name, NAME))[0]
        yield self._mark(self._forms.if_.format(condition=is_open), connective.node)
        yield self._block(connective.right, name, right)
        yield self._forms.end
        self._expressions.bound[connective.node] = name, NAME

    def _loop(self, loop: Loop) -> Lines:
        count = self._count(loop)
        start = self._expressions.text(loop.start)
        name = self._namer.declare(loop.name)
        yield self._variable(name, loop.node, start)
        yield self._opened(loop, count)
        yield self._turn(loop, name, count)
        yield self._forms.end
        self._namer.leave()
        self._expressions.bound[loop.node] = name, NAME

    def _variable(self, name: str, node: Node, value: str, owner: Node | None = None) -> str:
        """A variable with its first value.

        The line belongs to ``owner`` in the source map, if there is one: a value that is a bare
        constant has no place in the source.
        """
        typed = self._types.declare(name, node.type)
        text = self._forms.variable_set.format(name=name, typed=typed, value=value)
        return self._mark(text, owner or node)

    def _opened(self, loop: Loop | Iterate, count: str, going: Node | None = None) -> str:
        """The first line of a loop. Names that are declared after this call are inside of the loop.

        The condition ``going`` is part of that line if no statement has to come before it: drivers
        handle loops with a single exit best.
        """
        # The name is declared outside: old C compilers kept a loop's variable after the loop.
        index = self._namer.declare(loop.index.name)
        self._namer.enter()
        self._expressions.formals[loop.index] = index
        kind = loop.count.type.kind if isinstance(loop.count.type, Scalar) else "int"
        form = self._forms.loop if going is None else self._forms.loop_while
        text = form.format(
            index=index,
            index_typed=self._types.declare(index, loop.count.type),
            zero=literal(0, kind, self._literals),
            count=count,
            bound=self._bound(loop),
            going=None if going is None else Field(*self._expressions.operand(going)),
        )
        return self._mark(text, loop.node)

    def _enough(self, loop: Loop | Iterate, count: str) -> Lines:
        """The line that leaves a loop after its last iteration, if the loop only has a bound."""
        if self._forms.enough and loop.count.op != "constant":
            index = self._expressions.formals[loop.index]
            yield self._mark(self._forms.enough.format(index=index, count=count), loop.node)

    def _turn(self, loop: Loop, name: str, count: str) -> Lines:
        with self._inside():
            yield from self._enough(loop, count)
            yield from self._region(loop.body)
            combined = self._expressions.accumulated(loop.operator, name, loop.value)
            yield self._mark(combined, loop.value)

    def _iterate(self, loop: Iterate) -> Lines:
        """A loop with a variable for each state. A condition may leave it in its middle."""
        expressions = self._expressions
        count = self._count(loop)
        starts = [expressions.text(state.start) for state in loop.states]
        names = [self._namer.declare(state.name) for state in loop.states]
        for state, name, start in zip(loop.states, names, starts, strict=True):
            yield self._variable(name, state.start, start, loop.node)
            expressions.formals[state.formal] = name
        ends = loop.going.op != "constant"
        in_head = bool(loop.head.statements) or (ends and not self._forms.loop_while)
        if ends and not in_head:
            yield self._opened(loop, count, loop.going)
        else:
            yield self._opened(loop, count)
        yield self._step(loop, names, count, in_head=in_head)
        yield self._forms.end
        self._namer.leave()
        if len(names) == 1:
            expressions.bound[loop.node] = names[0], NAME
        for position, name in zip(loop.positions, names, strict=True):
            expressions.states[loop.node, str(position)] = name

    def _step(self, loop: Iterate, names: list[str], count: str, *, in_head: bool) -> Lines:
        """The body of such a loop: the condition that leaves it, and the states' new values."""
        expressions = self._expressions
        with self._inside():
            yield from self._enough(loop, count)
            yield from self._region(loop.head)
            if in_head:
                left = self._forms.leave.format(going=Field(*expressions.operand(loop.going)))
                yield self._mark(left, loop.going)
            yield from self._region(loop.body)
            kept: list[tuple[str, str, Node]] = []
            for state, name in zip(loop.states, names, strict=True):
                value = expressions.text(state.next)
                if state.kept:
                    waiting = self._namer.declare(f"{name}_next")
                    yield self._variable(waiting, state.next, value)
                    kept.append((name, waiting, state.next))
                else:
                    yield self._assigned(name, value, state.next)
            for name, waiting, node in kept:
                yield self._assigned(name, waiting, node)

    def _assigned(self, name: str, value: str, node: Node) -> str:
        return self._mark(self._forms.assign.format(name=name, value=value), node)

    def _count(self, loop: Loop | Iterate) -> str:
        """The number of iterations. It never exceeds the bound, whatever value the host has set."""
        if loop.count.op == "constant":
            return self._bound(loop)
        value = self._expressions.text(loop.count)
        return self._forms.at_most.format(value=value, bound=self._bound(loop))

    def _bound(self, loop: Loop | Iterate) -> str:
        """The largest possible number of iterations; the count itself, if it is constant."""
        kind: ScalarKind = "uint" if loop.count.type == UINT else "int"
        known = loop.count.data if loop.count.op == "constant" else loop.bound
        assert isinstance(known, int)
        return literal(min(known, loop.bound), kind, self._literals)

    def _block(self, region: Region, name: str, value: Node) -> Lines:
        """The statements of a nested region, and the assignment of ``value`` to a variable."""
        with self._inside():
            last = region.statements[-1] if region.statements else None
            if isinstance(last, Branch) and last.node is value:
                yield from self._region(Region(region.statements[:-1]))
                yield self._opened_branch(self._forms.if_, last, self._test(last))
                yield from self._sides(last, name, short=False)
            else:
                yield from self._region(region)
                yield self._assigned(name, self._expressions.text(value), value)

    @contextmanager
    def _inside(self) -> Iterator[None]:
        """Open a nested block; at its end, forget the names that were bound in it."""
        bound = self._expressions.bound
        outer = len(bound)
        self._namer.enter()
        yield
        self._namer.leave()
        while len(bound) > outer:
            bound.popitem()


def _only_branch(branch: Branch) -> Branch | None:
    """The branch that is everything on another branch's second side; ``None`` if there is more."""
    match branch.otherwise.statements:
        case (Branch() as inner,) if inner.node is branch.node.operands[2]:
            return inner
    return None
