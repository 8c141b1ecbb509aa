"""Turns the steps of derived values into expressions of the parameters that they read.

``gathering`` calls ``Values`` for the rows of a derived block. Builtins mean what the reference
defines: its functions are traced, as they are for web pages. Those of one number that take several
operations are functions in the binding as well (``helpers``), so that code stays short.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..compiler.documents.representations import kind_of, lanes_of
from ..compiler.documents.steps import (
    BoundStep,
    CallStep,
    ComposedStep,
    ConstantStep,
    FoldStep,
    IndexStep,
    MemberStep,
    ParameterStep,
    SelectStep,
    SplatStep,
    StepRow,
    SwizzleStep,
    TextureStep,
)
from ..compiler.reference.functions import LaneKind, evaluate, is_lanewise
from ..compiler.tracing import Expression, Tracing, given, made, wrapped
from .fields import Field, Numbers, Structure
from .helpers import Helpers
from .statements import Place

Value = Any
"""A tuple of lanes, or of columns or elements; or what is stored, ``Stored``."""


class Stored:
    """A parameter, or a part of one, whose lanes are read when they are needed."""

    def __init__(
        self,
        block: str,
        way: tuple[str | int | None, ...],
        indices: tuple[Expression, ...],
        field: Field,
        *,
        is_element: bool = False,
    ) -> None:
        self._block, self._way, self._indices = block, way, indices
        self._field = field
        self._is_array = bool(field.capacity) and not is_element

    def at(self, index: Expression) -> Value:
        """The element of an array with this number."""
        is_known = index.op == "constant"
        way = (*self._way, index.value if is_known else None)
        indices = self._indices if is_known else (*self._indices, index)
        return Stored(self._block, way, indices, self._field, is_element=True).read()

    def member(self, word: str) -> Value:
        """The member of a structure of this name."""
        assert isinstance(self._field.type, Structure)
        field = next(each for each in self._field.type.fields if each.name == word)
        return Stored(self._block, (*self._way, field.word), self._indices, field).read()

    def elements(self) -> tuple[Value, ...]:
        """All elements of an array."""
        return tuple(self.at(wrapped(number)) for number in range(self._field.capacity))

    def read(self) -> Value:
        """The lanes of a number, a vector or a matrix; itself if it is anything else."""
        kind = self._field.type
        if self._is_array or isinstance(kind, Structure):
            return self
        if not kind.columns:
            return self._lanes(kind, ())
        return tuple(self._lanes(kind, (column,)) for column in range(kind.columns))

    def _lanes(self, kind: Numbers, column: tuple[int, ...]) -> tuple[Expression, ...]:
        if kind.lanes == 1:
            return (self._load(kind, column),)
        return tuple(self._load(kind, (*column, lane)) for lane in range(kind.lanes))

    def _load(self, kind: Numbers, last: tuple[int, ...]) -> Expression:
        is_choice = bool(self._field.choices)
        place = Place(block=self._block, way=self._way, part=last, is_choice=is_choice)
        read: Any = "bool" if kind.truth else "float" if kind.kind == "float" else "int"
        natural = kind.kind == "uint"
        return made("load", *self._indices, kind=read, is_natural=natural, value=place)


class Values:
    """Evaluates steps to expressions; values that several rows need are one expression."""

    def __init__(
        self, parameters: Mapping[str, tuple[str, Field]], helpers: Helpers, hints: dict[int, str]
    ) -> None:
        """``parameters`` are the block and field of each parameter.

        ``hints`` gets a word for what expressions are, by which they are named.
        """
        self._parameters = parameters
        self._helpers = helpers
        self._hints = hints
        self.sources: dict[str, None] = {}
        """Names of the blocks that were read, in this order."""

    def of(self, steps: Sequence[StepRow], bound: tuple[Value, ...] = ()) -> Value:
        """The value of the last step; ``bound`` has the number of the element, if there is one."""
        return _Body(self, steps).value(len(steps) - 1, bound)

    def parameter(self, name: str) -> Value:
        """The value of a parameter."""
        block, field = self._parameters[name]
        self.sources.setdefault(block)
        return Stored(block, (field.word,), (), field).read()

    def texture_size(self, texture: str, level: Expression, lanes: int) -> Value:
        """The size of a texture at a level: only what a frame computes may depend on it."""
        raise NotImplementedError(texture)

    def applied(self, function: str, kind: LaneKind, operands: Sequence[Value]) -> Value:
        """The value of a builtin."""
        of_matrices = any(isinstance(lanes[0], tuple) for lanes in operands)
        if of_matrices or not is_lanewise(function):
            found = _expressions(evaluate(function, operands, Tracing(), kind))
        else:
            width = max(map(len, operands))
            rows = [lanes * width if len(lanes) == 1 else lanes for lanes in operands]
            lanes = zip(*rows, strict=True)
            found = tuple(self._helpers.applied(function, kind, each) for each in lanes)
        self._name(found, function)
        return found

    def _name(self, found: Value, function: str) -> None:
        for number, lane in enumerate(found):
            suffix = f"_{'xyzw'[number]}" if len(found) > 1 else ""
            if isinstance(lane, tuple):
                self._name(lane, f"{function}{number}")
            elif isinstance(lane, Expression):
                self._hints.setdefault(id(lane), f"{_NOUNS.get(function, function)}{suffix}")


_NOUNS = {
    "add": "sum", "sub": "difference", "mul": "product", "div": "quotient", "mod": "rest",
    "neg": "opposite", "abs": "magnitude", "eq": "same", "ne": "differs", "lt": "below",
    "le": "at_most", "gt": "above", "ge": "at_least", "and": "both", "or": "either",
    "not": "inverted", "cos": "cosine", "sin": "sine", "tan": "tangent", "dot": "inner_product",
    "min": "least", "max": "largest", "sqrt": "root", "inversesqrt": "inverse_root",
    "to_float": "number", "to_int": "whole", "to_uint": "whole", "pow": "power",
}  # fmt: skip
"""Words for the values of functions whose names are verbs, or taken by many languages."""


class _Body:
    """The evaluation of the steps of one value."""

    def __init__(self, values: Values, steps: Sequence[StepRow]) -> None:
        self._values, self._steps = values, steps

    def value(self, last: int, bound: tuple[Value, ...]) -> Value:
        """The value of a step; ``bound`` are the variables around it, the innermost first."""
        known: dict[int, Value] = {}
        pending = [last]
        while pending:
            number = pending[-1]
            row = self._steps[number]
            missing = [each for each in _outside(row) if each not in known]
            if missing:
                pending.extend(reversed(missing))
                continue
            if number not in known:
                known[number] = self._step(row, [known[each] for each in _outside(row)], bound)
            pending.pop()
        return known[last]

    def _step(self, row: StepRow, arguments: list[Value], bound: tuple[Value, ...]) -> Value:
        match row:
            case ParameterStep():
                return self._values.parameter(row.parameter)
            case ConstantStep():
                return _constant(row.value, kind_of(row.type))
            case BoundStep():
                return bound[row.binder]
            case TextureStep():
                return row.texture
            case CallStep(op="call", function="texture_size"):
                texture, (level,) = arguments
                return self._values.texture_size(texture, level, lanes_of(row.type))
            case CallStep():
                kind = kind_of(self._steps[row.args[0]].type)
                return self._values.applied(row.function, kind, arguments)
            case ComposedStep(op="apply"):
                return self.value(row.args[0], (*arguments, *bound))
            case FoldStep():
                return self._fold(row, arguments, bound)
            case _:
                return _plain(row, arguments)

    def _fold(self, row: FoldStep, arguments: list[Value], bound: tuple[Value, ...]) -> Value:
        """The lanes of a fold: a loop, whose body reads the number of the term and its lanes."""
        (count,), start = arguments
        key = len(self._values._hints), id(row), *map(id, start)
        turn = given(("turn", key), "int", is_natural=True)
        states = tuple(
            given(("state", key, number), lane.kind, is_natural=lane.is_natural)
            for number, lane in enumerate(start)
        )
        term = self.value(row.args[2], ((turn,), *bound))
        following = self._values.applied(row.operator, kind_of(row.type), [states, term])
        loop = Loop(turn, states, following, row.bound)
        fold = made("fold", count, *start, kind="int", value=loop)
        return tuple(
            made("lane", fold, kind=lane.kind, is_natural=lane.is_natural, value=number)
            for number, lane in enumerate(states)
        )


class Loop:
    """What a fold repeats."""

    def __init__(
        self,
        turn: Expression,
        states: tuple[Expression, ...],
        following: tuple[Expression, ...],
        bound: int,
    ) -> None:
        self.turn, self.states, self.following, self.bound = turn, states, following, bound


def _outside(row: StepRow) -> Sequence[int]:
    """The arguments that are not a body under the step's binder."""
    arguments: Sequence[int] = row.args
    if row.op == "fold":
        return arguments[:2]
    return arguments[1:] if row.op == "apply" else arguments


def _plain(row: StepRow, arguments: list[Value]) -> Value:
    """The value of a step that needs only the values of its arguments."""
    match row:
        case ComposedStep(op="vector"):
            return tuple(lane for each in arguments for lane in each)
        case SplatStep():
            return tuple(arguments[0] * lanes_of(row.type))
        case SwizzleStep():
            return tuple(arguments[0][lane] for lane in row.lanes)
        case MemberStep():
            return arguments[0].member(row.member)
        case IndexStep():
            aggregate, (position,) = arguments
            return _part(aggregate, position)
        case SelectStep():
            (condition,), then, otherwise = arguments
            return _chosen(condition, _whole(then), _whole(otherwise))
        case _:
            return tuple(arguments)  # A matrix of its columns, or an array of its elements.


def _part(aggregate: Value, position: Expression) -> Value:
    """An element, a column or a lane."""
    if isinstance(aggregate, Stored):
        return aggregate.at(position)
    if position.op == "constant":
        part = aggregate[position.value]
        return part if isinstance(part, (tuple, Stored)) else (part,)
    parts = [part if isinstance(part, tuple) else (part,) for part in map(_whole, aggregate)]
    found = parts[-1]
    for number in reversed(range(len(parts) - 1)):
        found = _chosen(position == number, parts[number], found)
    return found


def _whole(value: Value) -> Value:
    """All elements of a stored array as a tuple; other values as they are."""
    return value.elements() if isinstance(value, Stored) else value


def _chosen(condition: Expression, then: Value, otherwise: Value) -> Value:
    if isinstance(then, tuple):
        return tuple(_chosen(condition, *each) for each in zip(then, otherwise, strict=True))
    return Tracing.where(condition, then, otherwise)


def _expressions(value: Any) -> Value:
    """The lanes of a value as expressions, those that are plain numbers among them."""
    if isinstance(value, tuple):
        return tuple(map(_expressions, value))
    return wrapped(value)


def _constant(value: Any, kind: LaneKind) -> Value:
    if isinstance(value, Sequence):
        lanes = [_constant(each, kind) for each in value]
        return tuple(lane if isinstance(each, Sequence) else lane[0]
                     for lane, each in zip(lanes, value, strict=True))  # fmt: skip
    return (wrapped({"float": float, "bool": bool}.get(kind, int)(value)),)
