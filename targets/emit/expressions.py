"""Prints nodes of the graph as expressions, for one function body.

``Statements`` asks for the text of each value that a statement needs. A node that an earlier
statement has bound to a name is printed as that name, and every other node in place.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import ClassVar

from ...compiler.ir.node import Formal, Node, Op
from ...compiler.ir.operations import FORMAL, INPUT, MEMBER, SWIZZLE
from ...compiler.ir.types import (
    Matrix,
    Scalar,
    Struct,
    Type,
    Vector,
    scalar_kind,
    width,
)
from .context import Context
from .leaves import LeafPrinter
from .literals import literal
from .natives import EmittedFunction, Natives
from .precedence import NAME, POSTFIX, Binding, Field, Printed, choice, separable, within

DEEPEST = 200
"""The deepest nesting of expressions in a text: printers call each other for operands, and naga
refuses expressions that nest much deeper. The scheduler gives operands names long before."""

_SHIFTS = ("shift_left", "shift_right")


class Expressions:
    """Prints the nodes of one function body."""

    def __init__(
        self,
        context: Context,
        leaves: LeafPrinter,
        natives: Natives,
        functions: Mapping[Node, EmittedFunction],
    ) -> None:
        self.bound: dict[Node, Printed] = {}
        """The names of bound nodes."""
        self.formals: dict[Formal, str] = {}
        """Names of the parameters, loop indices and states in scope."""
        self.states: dict[tuple[Node, str], str] = {}
        """Names of the final states of loops with several, by the loop and the member."""
        self._forms = context.language.forms
        self._literals = context.language.literals
        self._types = context.types
        self._names = context.names
        self._leaves = leaves
        self._functions = functions
        self._natives = natives
        self._depth = 0

    def text(self, node: Node) -> str:
        """The text of a node as a part of a statement that needs no parentheses around it."""
        return self.operand(node)[0]

    def operand(self, node: Node) -> Printed:
        """The name of a bound node, or its expression."""
        (printed,) = self.operands((node,))
        return printed

    def operands(self, nodes: Iterable[Node]) -> list[Printed]:
        """The names or expressions of several nodes."""
        assert self._depth < DEEPEST, "the scheduler has to bind deep operands to names"
        self._depth += 1
        bound, printers = self.bound.get, self.PRINTERS
        printed = [bound(node) or printers[node.op](self, node) for node in nodes]
        self._depth -= 1
        return printed

    def expression(self, node: Node) -> Printed:
        """The expression that computes a node, even if the node is bound to a name already."""
        return self.PRINTERS[node.op](self, node)

    def accumulated(self, operator: str, name: str, value: Node) -> str:
        """The statement by which an iteration of a fold adds its value to a variable."""
        short = self._forms.accumulate.get(operator)
        if short is not None:
            return short.format(name=name, value=self.text(value))
        # The value comes first: `&&` and `||` may skip their second operand.
        operands = self.operand(value), (name, NAME)
        combined, _binding = self._natives.combined(operator, value.type, operands)
        return self._forms.assign.format(name=name, value=combined)

    def is_block(self, elements: tuple[Node, ...]) -> bool:
        """True if these are all members of a uniform block, in their order."""
        return self._leaves.is_block(elements)

    def _arguments(self, nodes: tuple[Node, ...]) -> str:
        return ", ".join(separable(self.operands(nodes)))

    def _parameter(self, node: Node) -> Printed:
        return self._leaves.parameter(node)

    def _texture(self, node: Node) -> Printed:
        return self._leaves.texture(node)

    def _buffer(self, node: Node) -> Printed:
        return self._leaves.buffer(node)

    def _attribute(self, node: Node) -> Printed:
        return self._leaves.attribute(node)

    def _argument(self, node: Node) -> Printed:
        return self._leaves.argument(node)

    def _interpolated(self, node: Node) -> Printed:
        return self._leaves.interpolated(node, self._corner(node))

    def _corner(self, crossing: Node) -> str:
        """The number of the corner whose value a varying is; empty if it is not one corner's."""
        return self.text(crossing.operands[1]) if len(crossing.operands) > 1 else ""

    def _constant(self, node: Node) -> Printed:
        kind = scalar_kind(node.type)
        assert kind is not None
        if isinstance(node.data, tuple):
            return self._constructed(node.type, ", ".join(self._lanes(node)))
        assert isinstance(node.data, int | float)
        return _number(literal(node.data, kind, self._literals))

    def _lanes(self, node: Node) -> list[str]:
        """The lanes of a constant, in the order in which the constructor takes them."""
        kind = scalar_kind(node.type)
        assert kind is not None and isinstance(node.data, tuple)
        lanes = [literal(lane, kind, self._literals) for lane in node.data]
        if isinstance(node.type, Matrix):
            rows = node.type.rows
            if self._forms.matrix_by_rows:
                return [lane for row in range(rows) for lane in lanes[row::rows]]
            return lanes
        return lanes[:1] if len(set(lanes)) == 1 and self._forms.splat_constant else lanes

    def _input(self, node: Node) -> Printed:
        text, type_ = self._leaves.input(INPUT.data(node))
        return (text if type_ == node.type else f"{self._types.type(node.type)}({text})"), POSTFIX

    def _native(self, node: Node) -> Printed:
        if self._forms.product_of_columns and node.data == "mul":
            made, vector = node.operands
            if made.op == "matrix" and made not in self.bound and isinstance(node.type, Vector):
                return self._product_of_columns(made, vector)
        operands = self.operands(node.operands)
        if self._forms.product_of_stored and _is_rectangular(node.operands[0].type):
            return self._product_of_stored(node.operands[1].type, *operands)
        if node.data in _SHIFTS and self._is_literal(node.operands[0]):
            operands[0] = self._typed(operands[0], node.type)
        return self._natives.print(node, operands)

    def _product_of_stored(self, type_: Type, matrix: Printed, vector: Printed) -> Printed:
        """A stored matrix times a vector of ``type_``, where it is written as a square one."""
        zeros = ", ".join([literal(0.0, "float", self._literals)] * (4 - width(type_)))
        form = self._forms.product_of_stored
        return form.format(matrix=Field(*matrix), vector=Field(*vector), zeros=zeros), POSTFIX

    def _product_of_columns(self, made: Node, vector: Node) -> Printed:
        type_, columns = self._transposed(made.type), self._arguments(made.operands)
        form = self._forms.product_of_columns
        return form.format(vector=self.text(vector), transposed=type_, columns=columns), POSTFIX

    def _transposed(self, type_: Type) -> str:
        """The type of the transpose of a matrix."""
        assert isinstance(type_, Matrix)
        return self._types.type(Matrix(type_.rows, type_.columns))

    def _vector(self, node: Node) -> Printed:
        return self._constructed(node.type, self._arguments(node.operands))

    def _constructed(self, type_: Type, parts: str) -> Printed:
        form = self._forms.constructor
        return form.format(type=self._types.type(type_), parts=parts), POSTFIX

    def _splat(self, node: Node) -> Printed:
        (lane,) = node.operands
        if "{lanes}" in self._forms.splat and lane.op == "swizzle" and lane not in self.bound:
            # `v.xxx` instead of `v.x.xxx`, which DXC does not survive where `v` is a column.
            return self._lanes_of(lane, SWIZZLE.data(lane) * width(node.type), node.type)
        return self._natives.splatted(self.operand(lane), node.type)

    def _matrix(self, node: Node) -> Printed:
        type_, transposed = self._types.type(node.type), self._transposed(node.type)
        columns = self._arguments(node.operands)
        form = self._forms.matrix
        return form.format(type=type_, transposed=transposed, columns=columns), POSTFIX

    def _array(self, node: Node) -> Printed:
        assert self._forms.array, "each element is assigned"
        type_, elements = self._types.type(node.type), self._arguments(node.operands)
        return self._forms.array.format(type=type_, elements=elements), POSTFIX

    def _swizzle(self, node: Node) -> Printed:
        return self._lanes_of(node, SWIZZLE.data(node), node.type)

    def _lanes_of(self, swizzle: Node, lanes: tuple[int, ...], type_: Type) -> Printed:
        """Some lanes of the vector that a swizzle reads."""
        (source,) = swizzle.operands
        if source.op == "cross" and source not in self.bound:
            return self._leaves.interpolated(source, self._corner(source), lanes)
        if source.op == "input" and source not in self.bound:
            text, supplied = self._leaves.input(INPUT.data(source), lanes)
            if supplied == type_:
                return text, POSTFIX
        return self._leaves.swizzle(self.operand(source), lanes, type_)

    def _index(self, node: Node) -> Printed:
        aggregate, position = node.operands
        operand, place = self.operand(aggregate), self.text(position)
        if isinstance(aggregate.type, Matrix):
            form = self._forms.column
            return form.format(matrix=Field(*operand), position=place), POSTFIX
        form = self._forms.element
        return form.format(aggregate=Field(*operand), position=place), POSTFIX

    def _member(self, node: Node) -> Printed:
        (owner,) = node.operands
        assert isinstance(owner.type, Struct)
        member = MEMBER.data(node)
        if owner.op == "iterate":
            return self.states[owner, member], NAME
        name = self._names.member(owner.type.name, member)
        text = f"{within(self.operand(owner), POSTFIX)}.{name}"
        return self._leaves.loaded((text, POSTFIX), node.type)

    def _select(self, node: Node) -> Printed:
        assert isinstance(node.operands[0].type, Scalar), "conditions are scalars"
        assert isinstance(node.type, Scalar | Vector), "matrices are chosen by a branch"
        condition, then, otherwise = self.operands(node.operands)
        if all(map(self._is_literal, node.operands[1:])):
            then, otherwise = (self._typed(side, node.type) for side in (then, otherwise))
        form = self._forms.select
        if not form:
            return choice(condition, then, otherwise)
        sides = separable((otherwise, then, condition))
        text = form.format(otherwise=sides[0], then=sides[1], condition=sides[2])
        return text, POSTFIX

    def _is_literal(self, node: Node) -> bool:
        return node.op == "constant" and node not in self.bound

    def _typed(self, literal_: Printed, type_: Type) -> Printed:
        """A literal with a type, for operators whose other operands do not fix its width."""
        form = self._literals.typed.get(type_.kind) if isinstance(type_, Scalar) else None
        return (form.format(literal_[0]), POSTFIX) if form else literal_

    def _call(self, node: Node) -> Printed:
        return self._functions[node.operands[0]].call(self.operands(node.operands[1:]))

    def _formal(self, node: Node) -> Printed:
        return self.formals[FORMAL.data(node)], NAME

    PRINTERS: ClassVar[Mapping[Op, Callable[[Expressions, Node], Printed]]] = {
        "constant": _constant,
        "parameter": _parameter,
        "texture": _texture,
        "buffer": _buffer,
        "attribute": _attribute,
        "argument": _argument,
        "cross": _interpolated,
        "input": _input,
        "native": _native,
        "vector": _vector,
        "splat": _splat,
        "matrix": _matrix,
        "array": _array,
        "swizzle": _swizzle,
        "index": _index,
        "member": _member,
        "select": _select,
        "apply": _call,
        "formal": _formal,
    }
    """The method that prints each operation; loops are not among them, as they are statements."""


def _is_rectangular(type_: Type) -> bool:
    """True for a matrix that is not square."""
    return isinstance(type_, Matrix) and not type_.is_square


def _number(text: str) -> Printed:
    """A literal as an expression. No literal can be swizzled, so it does not bind like a name; the
    lowest integer is written as a difference."""
    return text, Binding.SUM if " " in text else Binding.PREFIX
