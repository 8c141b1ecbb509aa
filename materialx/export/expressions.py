"""Turns expressions of Burnish into nodes.

``Expressions`` walks the checked syntax of an equation, and gives the value of the nodes that it
has written for it. What names mean is asked of a ``Vocabulary``: that of a
material, or of the body of a function.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import isfinite, pi
from typing import Any, Protocol

from ...compiler.semantics.checking.constructors import is_constructor
from ...compiler.semantics.equations.reads import Where
from ...compiler.srgb import linear
from ...compiler.syntax import ast
from ...compiler.units import value_of
from .lanes import built, lanes, matrix_column, picked
from .nodes import Nodes
from .table import ways, written_out
from .unsayable import UnsayableError
from .values import Constant, Linked, Several, Value, lanes_of, type_named, vector

DEEPEST = 200
"""How deep expressions and calls may nest."""
_WAY_OUT = "keep it in Burnish, or give the document a texture of what it computes"
_UNSAYABLE: Mapping[type, tuple[str, str]] = {
    ast.Fold: ("MaterialX has no loops", "write the turns out, or bake what it computes"),
    ast.FoldOver: ("MaterialX has no loops", "write the turns out"),
    ast.Iterate: ("MaterialX has no loops", "write the turns out, or bake what it computes"),
    ast.With: ("MaterialX cannot replace slots of a term", "set the slots of the model"),
    ast.AtRate: ("a node cannot say at which stage it is computed", "leave out the `@`"),
    ast.Array: ("MaterialX has no arrays of values", "choose between values by `if`"),
}  # fmt: skip


@dataclass(frozen=True)
class At:
    """A place in a text: what its names mean there."""

    where: Where
    own: Mapping[str, Value | Later]
    """Arguments and parts."""
    depth: int = 0


@dataclass
class Later:
    """A part behind ``where``, whose value is computed when it is first read."""

    slot: ast.Slot
    at: At
    value: Value | None = None


class Vocabulary(Protocol):
    """What expressions ask of their surroundings."""

    def slot(self, name: str, level: int) -> Value:
        """The value of a slot of the surface."""

    def named(self, e: ast.Reference | ast.Field, at: At) -> Value | None:
        """The value of a name that is none of the text's own; nothing for what is built in."""

    def called(self, e: ast.Call, at: At, wanted: str) -> Value | None:
        """The value of a call of a declared function, or of a texture; nothing for builtins."""

    def converted(self, e: ast.Conversion, at: At) -> Value:
        """Something as it is seen from a space."""

    def swizzled(self, e: ast.Field, at: At) -> Value | None:
        """A texture that is read with lanes; nothing for all else."""


class Expressions:
    """The nodes of expressions, in one graph."""

    def __init__(self, nodes: Nodes, meanings: Vocabulary) -> None:
        self.nodes, self._meanings = nodes, meanings
        self._forms: Mapping[type, Callable[[Any, At, str], Value]] = {
            ast.Number: self._number, ast.Color: self._color, ast.Boolean: self._boolean,
            ast.Reference: self._reference, ast.Field: self._field, ast.Unary: self._unary,
            ast.Binary: self._binary, ast.Conditional: self._conditional, ast.Call: self._call,
            ast.Index: self._index, ast.Ascription: self._ascription,
            ast.Conversion: lambda e, at, _wanted: self._meanings.converted(e, at),
        }  # fmt: skip

    def value(self, e: ast.Expression, at: At, wanted: str = "") -> Value:
        """The value of an expression; ``wanted`` is the type that its reader would like.

        Raises ``UnsayableError`` with the place.
        """
        try:
            if at.depth > DEEPEST:
                raise UnsayableError(f"this nests more than {DEEPEST} deep", "name parts of it")
            if type(e) not in self._forms:
                raise UnsayableError(*_UNSAYABLE[type(e)])
            return self._forms[type(e)](e, replace(at, depth=at.depth + 1), wanted)
        except UnsayableError as error:
            error.span = error.span or e.span
            raise

    def part(self, later: Later, wanted: str) -> Value:
        """The value of a part behind ``where``."""
        if later.value is None:
            slot = later.slot
            assert slot.value is not None
            kind = type_named(slot.type) if slot.type is not None else wanted
            later.value = self.nodes.named(self.value(slot.value, later.at, kind), slot.name.text)
        return later.value

    # ---- Constants and names

    def _number(self, e: ast.Number, _at: At, _wanted: str) -> Value:
        if e.kind in ("int", "uint"):
            return Constant("integer", (float(e.text),), is_whole=e.kind == "int")
        return vector((value_of(e.text, e.unit),), "float")

    def _color(self, e: ast.Color, _at: At, _wanted: str) -> Value:
        numbers = [linear(channel) for channel in e.channels[:3]]
        alpha = [channel / 255 for channel in e.channels[3:]]
        return vector([*numbers, *alpha], f"color{len(e.channels)}")

    def _boolean(self, e: ast.Boolean, _at: At, _wanted: str) -> Value:
        return vector((e.value,), "boolean")

    def _reference(self, e: ast.Reference, at: At, wanted: str) -> Value:
        if e.name in at.own:
            found = at.own[e.name]
            return self.part(found, wanted) if isinstance(found, Later) else found
        value = self._meanings.named(e, at)
        if value is not None:
            return value
        if e.name == "pi":
            return vector((pi,), "float")
        raise UnsayableError(f"no node gives `{e.name}`", _WAY_OUT)

    def _field(self, e: ast.Field, at: At, _wanted: str) -> Value:
        found = self._meanings.named(e, at) or self._meanings.swizzled(e, at)
        if found is not None:
            return found
        whole = self.value(e.operand, at)
        if isinstance(whole, Several):
            return whole.members[e.name.text]
        return picked(self.nodes, whole, e.name.text)

    def _ascription(self, e: ast.Ascription, at: At, _wanted: str) -> Value:
        return self.value(e.operand, at, type_named(e.type))

    def _index(self, e: ast.Index, at: At, _wanted: str) -> Value:
        whole, index = self.value(e.operand, at), self.value(e.index, at, "integer")
        if isinstance(whole, Linked | Constant) and isinstance(index, Constant):
            return matrix_column(self.nodes, whole, int(index.numbers[0]))
        return self.nodes.node("extract", {"in": whole, "index": index})

    # ---- Operations

    def _unary(self, e: ast.Unary, at: At, wanted: str) -> Value:
        value = self.value(e.operand, at, wanted)
        if e.operator == "not":
            return self.nodes.node("not", {"in": value}, "boolean")
        if e.operator != "-":
            raise UnsayableError("MaterialX has no bits of whole numbers", _WAY_OUT)
        if isinstance(value, Constant):
            return replace(value, numbers=tuple(-number for number in value.numbers))
        return self._operation("*", value, vector((-1,), "float"), wanted)

    def _binary(self, e: ast.Binary, at: At, wanted: str) -> Value:
        if e.operator in ("&", "|", "^", "<<", ">>"):
            raise UnsayableError("MaterialX has no bits of whole numbers", _WAY_OUT)
        if e.operator in ("and", "or"):
            left, right = self.value(e.left, at), self.value(e.right, at)
            return self.nodes.node(e.operator, {"in1": left, "in2": right}, "boolean")
        if e.operator in ("+", "-", "*", "/", "mod"):
            left, right = self.value(e.left, at, wanted), self.value(e.right, at, wanted)
            return self._operation(e.operator, left, right, wanted)
        category, left, right, is_turned = self._compared(e, at)
        if is_turned:
            given = {"value1": left, "value2": right}
            equal = self.nodes.node(category, given, "boolean", must=True)
            return self.nodes.node("not", {"in": equal}, "boolean")
        return self.nodes.node(category, {"value1": left, "value2": right}, "boolean", must=True)

    def _operation(self, operator: str, left: Value, right: Value, wanted: str) -> Value:
        if isinstance(left, Constant) and isinstance(right, Constant):
            folded = _folded(operator, left, right)
            if folded is not None:
                return folded
        given = {"in1": left, "in2": right}
        kinds = {getattr(value, "type", "") for value in given.values()}
        way = ways()[operator]
        if kinds == {"integer"}:
            return self.nodes.node(way.category, given, "integer", must=True)
        if any(kind.startswith("matrix") for kind in kinds):
            return self._of_matrices(operator, left, right)
        if operator in "+*" and 1 == lanes_of(getattr(left, "type", "")) < lanes_of(
            getattr(right, "type", "")
        ):
            # Nodes take one number for all lanes on the right only.
            given = {"in1": right, "in2": left}
        if operator == "-" and isinstance(left, Constant) and len(left.numbers) == 1:
            # The node for this takes one number for all lanes.
            return self.nodes.node("invert", {"in": right, "amount": left}, wanted)
        return self.nodes.node(way.category, given, wanted)

    def _of_matrices(self, operator: str, left: Value, right: Value) -> Value:
        """Products of matrices: MaterialX writes what is applied first on the left."""
        kinds = [getattr(value, "type", "") for value in (left, right)]
        if operator == "*" and kinds[1].startswith("vector"):
            return self.nodes.node("transformmatrix", {"in": right, "mat": left})
        if kinds[0] == kinds[1]:
            sides = (right, left) if operator == "*" else (left, right)
            way = ways()[operator]
            return self.nodes.node(way.category, {"in1": sides[0], "in2": sides[1]}, kinds[0])
        raise UnsayableError("MaterialX has no such operation of matrices", _WAY_OUT)

    def _compared(self, e: ast.Binary, at: At) -> tuple[str, Value, Value, bool]:
        """The node for a comparison, its operands, and true if it says the opposite."""
        left, right = self.value(e.left, at), self.value(e.right, at)
        for side in (left, right):
            if not isinstance(side, Constant | Linked) or lanes_of(side.type) != 1:
                raise UnsayableError("MaterialX compares single numbers only", "compare lanes")
        if e.operator in ("<", "<="):
            left, right = right, left
        operator = {"<": ">", "<=": ">=", "!=": "=="}.get(e.operator, e.operator)
        return ways()[operator].category, left, right, e.operator == "!="

    def _conditional(self, e: ast.Conditional, at: At, wanted: str) -> Value:
        then, otherwise = self.value(e.then, at, wanted), self.value(e.otherwise, at, wanted)
        return self._choice(e.condition, then, otherwise, at, wanted)

    def _choice(
        self, condition: ast.Expression, then: Value, otherwise: Value, at: At, wanted: str
    ) -> Value:
        """One of two values."""
        if isinstance(condition, ast.Binary) and condition.operator in (
            "<", "<=", ">", ">=", "==", "!=",
        ):  # fmt: skip
            category, left, right, is_turned = self._compared(condition, at)
        else:
            category, right, is_turned = "ifequal", vector((1,), "boolean"), False
            left = self.value(condition, at)
        sides = (otherwise, then) if is_turned else (then, otherwise)
        given = {"value1": left, "value2": right, "in1": sides[0], "in2": sides[1]}
        return self.nodes.node(category, given, wanted or _natural(then, otherwise))

    # ---- Calls

    def _call(self, e: ast.Call, at: At, wanted: str) -> Value:
        if isinstance(e.callee, ast.Reference) and e.callee.name not in at.own:
            found = self._meanings.called(e, at, wanted)
            if found is not None:
                return found
            return self._builtin(e.callee.name, e, at, wanted)
        found = self._meanings.called(e, at, wanted)
        if found is None:
            raise UnsayableError("MaterialX reads textures at their filtered level only", "")
        return found

    def _builtin(self, name: str, e: ast.Call, at: At, wanted: str) -> Value:
        if is_constructor(name):
            return built(self.nodes, name, [self.value(each, at) for each in e.arguments], wanted)
        if name == "choose" and len(e.arguments) == 3 and not e.names:
            _condition, then, otherwise = e.arguments
            sides = self.value(then, at, wanted), self.value(otherwise, at, wanted)
            return self._choice(e.arguments[0], *sides, at, wanted)
        if name in ways():
            way = ways()[name]
            values = [self.value(each, at, wanted) for each in e.arguments]
            return self.nodes.node(way.category, dict(zip(way.inputs, values, strict=True)), wanted)
        if name in written_out():
            function = written_out()[name]
            names = [argument.name.text for argument in function.arguments]
            values = [self.value(each, at, wanted) for each in e.arguments]
            own: dict[str, Value | Later] = dict(zip(names, values, strict=True))
            return self.body(function, replace(at, own=own), own, wanted)
        kind = "takes derivatives" if name in ("ddx", "ddy") else f"means `{name}`"
        raise UnsayableError(f"no node {kind}", _WAY_OUT)

    def body(
        self, function: ast.Function, at: At, own: dict[str, Value | Later], wanted: str
    ) -> Value:
        """The value of a function, written out; ``own`` has its arguments, and gets its parts."""
        inside = replace(at, own=own)
        for part in function.parts:
            own[part.name.text] = Later(part, inside)
        return self.value(function.body, inside, wanted)

    def lanes(self, value: Value) -> list[Value]:
        """The lanes of a vector."""
        return lanes(self.nodes, value)


def _natural(*values: Value) -> str:
    """The type of the first value that is a node's."""
    linked = (value.type for value in values if isinstance(value, Linked))
    first = next((value.type for value in values if isinstance(value, Constant)), "")
    return next(linked, first if first != "integer" else "")


def _folded(operator: str, left: Constant, right: Constant) -> Constant | None:
    """An operation of two constants; nothing if it has to be a node."""
    if left.space or right.space or {left.type, right.type} & {"boolean", "matrix33", "matrix44"}:
        return None
    size = max(len(left.numbers), len(right.numbers))
    if {len(left.numbers), len(right.numbers)} - {1, size}:
        return None
    pairs = zip(
        left.numbers * (size // len(left.numbers)),
        right.numbers * (size // len(right.numbers)), strict=True,
    )  # fmt: skip
    is_whole = left.type == right.type == "integer"
    numbers = [_result(operator, one, other, is_whole) for one, other in pairs]
    known = [number for number in numbers if number is not None and isfinite(number)]
    if len(known) < len(numbers):
        return None
    if is_whole:
        return Constant("integer", tuple(known), left.is_whole and right.is_whole)
    wide = [each.type for each in (left, right) if len(each.numbers) == size]
    kind = next((each for each in wide if each.startswith("color")), wide[0])
    return Constant("float" if kind == "integer" else kind, tuple(known))


def _result(operator: str, one: float, other: float, is_whole: bool) -> float | None:
    results = {"+": one + other, "-": one - other, "*": one * other}
    if operator == "/" and other:
        results["/"] = float(int(one / other)) if is_whole else one / other
    return results.get(operator)
