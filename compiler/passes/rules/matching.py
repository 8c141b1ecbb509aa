"""Makes a function of an equation: it looks for the left side, and builds the right one.

Every node that a pass builds is looked up in the table of rules, so little may be done for each.
The heads of the operands tell which equations can apply at all (``Case.admits``). For those, a
function is put together when it is first needed (``Case.apply``). In it, each name of the equation
is a place in a sequence of values. That begins with the operands, so that most equations need no
other sequence; the operands of operands, and data, come behind.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from itertools import product
from typing import Any

from ....support.frozen import cached_property, changed, frozen
from ...ir.node import HEADS, SPECIAL, Node, Op
from ...ir.signatures import result_type
from ...ir.types import Type
from .builder import Builder, uniform_lane
from .terms import (
    CONSTANT,
    Computed,
    Condition,
    Data,
    Function,
    Heads,
    Operation,
    Several,
    Term,
    Uniform,
    Variable,
)

Apply = Callable[[Builder, Op, Type, tuple[Node, ...], Hashable], Node | None]
"""Gives the simpler value of an operation with this type, these operands and this data, if any."""
Values = Sequence[Any]
"""The values of the names in a rule, by their places."""
Step = Callable[[list[Any]], bool]
"""Matches one more part against its term; it may add the parts of that to the values."""
Maker = Callable[[Builder, Type, Values], Any]
"""Makes a value for a result of this type; ``None`` if there is none."""
Opening = Callable[[tuple[Node, ...], Hashable], list[Any]]
"""Gives the values that an operation with these operands and this data starts with."""

_NAMED = (Variable, Several, Data)
"""The terms that are nothing but a name."""
_OPS: dict[Hashable, Op] = {head: op for op, head in HEADS.items()}


@frozen(eq=False)
class Case:
    """An equation, with all operands on its left side in one order."""

    left: Operation
    right: Term
    where: tuple[Condition, ...]
    of_calls: bool
    """True if the operations on the left have to be calls."""

    def admits(self, heads: tuple[Hashable, ...]) -> bool:
        """True if operands with these heads can match."""
        terms = self.left.operands
        if terms and isinstance(rest := terms[-1], Several):
            terms = terms[:-1]
            others = heads[len(terms) :]
            if not any(_is_among(rest.some, head) for head in others):
                return False
            if not all(_is_among(rest.every, head) for head in others):
                return False
            heads = heads[: len(terms)]
        return len(heads) == len(terms) and all(map(_is_among, map(heads_of, terms), heads))

    @cached_property
    def apply(self) -> Apply:
        """The function for operations with operands that it ``admits``."""
        return _Matching(self.left, self.of_calls).applying(self.right, self.where)


class Pattern:
    """A term that is looked for in a graph, to which nothing is done.

    The reflection looks for values by which hosts know a computation.
    """

    def __init__(self, term: Operation) -> None:
        self._heads = frozenset(term.function.heads)
        self._orders = tuple(
            (Case(each, each, (), of_calls=False), _Matching(each, of_calls=False))
            for each in orders(term)
        )

    def found_in(self, node: Node) -> Mapping[str, Any] | None:
        """The values of the names in the term if a node looks like it; otherwise ``None``."""
        if node.head not in self._heads:
            return None
        heads = tuple(operand.head for operand in node.operands)
        found = (matching.named(node) for case, matching in self._orders if case.admits(heads))
        return next((names for names in found if names is not None), None)


def orders(operation: Operation) -> Iterator[Operation]:
    """The operation with its operands in each order that they may have."""
    choices = (
        tuple(orders(term)) if isinstance(term, Operation) else (term,)
        for term in operation.operands
    )
    for operands in product(*choices):
        yield operation if operands == operation.operands else changed(operation, operands=operands)
        if operation.is_either:
            yield changed(operation, operands=operands[::-1])


def heads_of(term: Term) -> Heads | None:
    """The heads of the values that a term can stand for."""
    match term:
        case Variable(heads=heads):
            return heads
        case Uniform(value=value):
            special = SPECIAL.get((isinstance(value, bool), value))
            return CONSTANT if special is None else frozenset({special})
        case Operation(function=function):
            return frozenset(function.heads)
        case _:
            return None


def _is_among(heads: Heads | None, head: Hashable) -> bool:
    return heads is None or head in heads


class _Matching:
    """Gives the names of the left side their places, and makes functions of the values there."""

    def __init__(self, left: Operation, of_calls: bool) -> None:
        self._of_calls = of_calls
        self._places: dict[str, int] = {}
        self._count = 0
        self._steps: list[Step] = []
        self._are_operands = not _takes_more(left)
        """True if the operands are all values that there are."""
        self._begin = self._opened(left, is_root=True)

    def applying(self, right: Term, where: tuple[Condition, ...]) -> Apply:
        """A function that replaces an operation by the right side."""
        begin, steps, of_calls = self._begin, tuple(self._steps), self._of_calls
        are_operands = self._are_operands and not steps
        conditions, make = tuple(map(self._made, where)), self._result(right)

        def apply(
            builder: Builder, op: Op, type_: Type, operands: tuple[Node, ...], data: Hashable
        ) -> Node | None:
            if of_calls and op != "call":
                return None
            values: Values = operands
            if not are_operands:
                values = found = begin(operands, data)
                for matches in steps:
                    if not matches(found):
                        return None
            for holds in conditions:
                if not holds(builder, type_, values):
                    return None
            made: Node | None = make(builder, type_, values)
            return made

        return apply

    def named(self, node: Node) -> Mapping[str, Any] | None:
        """The values of all names, or ``None`` where a part of a value looks in another way."""
        values = self._begin(node.operands, node.data)
        if not all(matches(values) for matches in self._steps):
            return None
        return {name: values[place] for name, place in self._places.items()}

    # --- the left side ---------------------------------------------------------------------------

    def _opened(self, operation: Operation, is_root: bool = False) -> Opening:
        """Give the operands of an operation places, and its data the one behind them.

        The function gets these values. What else to ask of them are the steps that come next.
        """
        terms, function, place = operation.operands, operation.function, self._count
        takes_data = _takes_data(function)
        self._count += len(terms) + takes_data
        for number, term in enumerate(terms, place):
            self._look(term, number, is_told=is_root)
        if takes_data:
            data = function if function.data is None else function.data
            self._name(data.name, place + len(terms))
        fixed = len(terms) - 1 if _ends_in_several(terms) else None

        def opened(operands: tuple[Node, ...], data: Hashable) -> list[Any]:
            values: list[Any] = list(operands)
            if fixed is not None:
                values[fixed:] = [operands[fixed:]]
            if takes_data:
                values.append(data)
            return values

        return opened

    def _look(self, term: Term, place: int, is_told: bool) -> None:
        """Makes steps that ask a value for the properties in a term.

        Where ``is_told``, its head is known to be right.
        """
        heads = heads_of(term)
        if heads is not None and not is_told:
            self._steps.append(lambda values: values[place].head in heads)
        match term:
            case Variable(name=name) | Several(name=name):
                self._name(name, place)
            case Uniform(value=number) if heads is CONSTANT:
                self._steps.append(lambda values: uniform_lane(values[place]) == number)
            case Operation(label=label):
                if label is not None:
                    self._name(label.name, place)
                self._look_into(term, place)

    def _look_into(self, operation: Operation, place: int) -> None:
        """Makes steps that ask the operands of a value for the properties in their terms."""
        count = None if _ends_in_several(operation.operands) else len(operation.operands)
        of_calls = self._of_calls

        def matches(values: list[Any]) -> bool:
            node: Node = values[place]
            if count is not None and len(node.operands) != count:
                return False
            if of_calls and node.op != "call":
                return False
            values += opened(node.operands, node.data)
            return True

        self._steps.append(matches)
        opened = self._opened(operation)

    def _name(self, name: str, place: int) -> None:
        """Give a name a place; if it has one, both are one value."""
        first = self._places.setdefault(name, place)
        if first != place:
            self._steps.append(lambda values: values[first] is values[place])

    # --- the right side --------------------------------------------------------------------------

    def _result(self, term: Term) -> Maker:
        """A function that makes the value of the whole right side."""
        match term:
            case Variable(name=name):
                place = self._places[name]
                return lambda builder, type_, values: builder.fitted(values[place], type_)
            case Uniform(value=number):
                return lambda builder, type_, _values: builder.constant(type_, number)
            case Operation():
                return self._operation(term, is_whole=True)
            case _:
                return self._value(term)

    def _value(self, term: Term | Function) -> Maker:
        """A function that gives, or makes, the value of a part of the right side or condition."""
        match term:
            case Function(heads=(head,)):
                return lambda _builder, _type, _values: head
            case Variable(name=name) | Several(name=name) | Data(name=name) | Function(name=name):
                place = self._places[name]
                return lambda _builder, _type, values: values[place]
            case Uniform(value=number):
                return lambda _builder, _type, _values: number
            case Computed():
                return self._made(term)
            case Operation():
                return self._operation(term)
            case _:
                raise TypeError(term)

    def _made(self, term: Computed | Condition) -> Maker:
        """A function that calls that of the term with its arguments."""
        function, arguments = term.function, term.arguments
        places = [self._places[each.name] for each in arguments if isinstance(each, _NAMED)]
        if len(arguments) == len(places) == 1:  # most of them
            (place,) = places
            return lambda builder, type_, values: function(builder, type_, values[place])
        if len(arguments) == len(places) == 2:
            one, other = places
            return lambda builder, type_, values: function(
                builder, type_, values[one], values[other]
            )
        makers = tuple(map(self._value, arguments))
        may_fail = any(isinstance(each, Computed | Operation) for each in arguments)

        def made(builder: Builder, type_: Type, values: Values) -> Any:
            found = [make(builder, type_, values) for make in makers]
            if may_fail and None in found:
                return None
            return function(builder, type_, *found)

        return made

    def _operation(self, term: Operation, is_whole: bool = False) -> Maker:
        """A function that makes an operation. It is a builtin, or has the type of the result."""
        operands_of, function = self._operands(term.operands), term.function
        if function.heads[0] not in _OPS:
            return self._call(self._value(function), operands_of, is_whole)
        op = _OPS[function.heads[0]]
        data_of = None if function.data is None else self._value(function.data)

        def made(builder: Builder, type_: Type, values: Values) -> Node | None:
            operands = operands_of(builder, type_, values)
            data = None if data_of is None else data_of(builder, type_, values)
            return None if operands is None else builder.make(op, type_, operands, data)

        return made

    def _call(self, name_of: Maker, operands_of: Maker, is_whole: bool) -> Maker:
        """A function that makes a call.

        The whole right side has the type of the result; a part of it has the type that follows from
        its operands.
        """

        def made(builder: Builder, type_: Type, values: Values) -> Node | None:
            operands = operands_of(builder, type_, values)
            if operands is None:
                return None
            name = name_of(builder, type_, values)
            if not is_whole:
                follows = result_type(name, tuple(operand.type for operand in operands))
                assert follows is not None
                type_ = follows
            elif len(operands) == 1:
                operands = (builder.fitted(operands[0], type_),)
            return builder.call(name, type_, *operands)

        return made

    def _operands(self, terms: tuple[Term, ...]) -> Maker:
        """A function that makes operands; a number is as wide as the operand before it."""
        parts = [
            (term.value, None) if isinstance(term, Uniform) else (0, self._value(term))
            for term in terms
        ]

        def made(builder: Builder, type_: Type, values: Values) -> tuple[Node, ...] | None:
            operands: list[Node] = []
            for number, make in parts:
                operand = (
                    builder.constant(operands[0].type, number)
                    if make is None
                    else make(builder, type_, values)
                )
                if operand is None:
                    return None
                operands.append(operand)
            return tuple(operands)

        return made


def _ends_in_several(terms: tuple[Term, ...]) -> bool:
    return bool(terms) and isinstance(terms[-1], Several)


def _takes_data(function: Function) -> bool:
    """True if an operation's data has a name: it tells which of several builtins it is."""
    return function.data is not None or len(function.heads) > 1


def _takes_more(left: Operation) -> bool:
    """True if more values than the operands have names."""
    return _takes_data(left.function) or _ends_in_several(left.operands)
