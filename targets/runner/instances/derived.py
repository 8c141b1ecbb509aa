"""Computes derived values in double precision, from the steps in the reflection.

``Instance.blocks`` calls it, and ``reference.py`` for the program of a profile. It uses the
reference's functions, so a value means the same here as everywhere.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Protocol

from ....compiler.budget import Tally
from ....compiler.documents.representations import Kind, kind_of, lanes_of
from ....compiler.documents.steps import (
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
from ....compiler.documents.values import DerivedRow
from ....compiler.reference.functions import evaluate
from ....support.frozen import EMPTY, fresh, record
from .shapes import MOST_LANES, Elements, Members, Numbers, Shape, shape_of

Named = Any
"""A value in the form of ``shapes``, in which a structure is a mapping of its members by name."""


class Sized(Protocol):
    """A texture; steps read only its size."""

    def size(self, level: int) -> tuple[int, ...]:
        """The number of texels in each direction."""


class OfSize:
    """A texture that the host has made itself; only its size is known."""

    def __init__(self, *sides: int) -> None:
        self._sides = sides

    def size(self, level: int) -> tuple[int, ...]:
        """The number of texels in each direction."""
        return tuple(max(side >> max(level, 0), 1) for side in self._sides)


class Inputs:
    """The values of the parameters, converted to ``Named`` when a step first reads them."""

    def __init__(
        self,
        shapes: Mapping[str, Shape],
        values: Mapping[str, Any],
        textures: Mapping[str, Sized] = EMPTY,
        meter: Tally | None = None,
    ) -> None:
        """``textures`` are needed if steps read their sizes, as an extent's may.

        ``meter`` counts the steps of several computations together.
        """
        self.textures = textures
        self.meter = meter or Tally("steps", "the values that a host computes take")
        self._shapes = shapes
        self._values = values
        self._known: dict[str, Named] = {}

    def __getitem__(self, parameter: str) -> Named:
        """The stored value of a parameter."""
        if parameter not in self._known:
            value = named(self._shapes[parameter], self._values[parameter])
            self._known[parameter] = value
        return self._known[parameter]


def computed(
    rows: Iterable[DerivedRow], inputs: Inputs
) -> Iterator[tuple[DerivedRow, Shape, Named]]:
    """Each derived value of a reflection, with its row and its shape; no value is rounded yet."""
    for row in rows:
        shape = shape_of(row)
        if isinstance(shape, Elements):
            yield row, shape, compute_elements(row.steps, inputs, shape.count)
        else:
            yield row, shape, compute(row.steps, inputs)


def compute(steps: Sequence[StepRow], inputs: Inputs) -> Named:
    """The value of the last step: a tuple of lanes, or of a matrix's columns, not yet rounded."""
    return _Computation(steps, inputs).value(len(steps) - 1, ())


def compute_elements(steps: Sequence[StepRow], inputs: Inputs, count: int) -> tuple[Named, ...]:
    """The last step's value for each element of an array; its number is the only free variable.

    Elements that are not in use are computed as well; no function raises, whatever they contain.
    """
    computation = _Computation(steps, inputs)
    return tuple(computation.value(len(steps) - 1, ((i,),)) for i in range(count))


@record
class _Body:
    """The evaluation of a body for one value of each variable, up to the binder where it waits."""

    last: int
    """The number of the step whose value is wanted."""
    bound: tuple[Named, ...]
    """The values of the variables around it, the innermost first."""
    left: list[int]
    """The steps that are still to be computed, the next one last."""
    varying: dict[int, Named] = fresh(factory=dict)
    """The values of those steps that use variables."""


class _Application:
    """A function's application while its body is evaluated."""

    def __init__(self, row: StepRow, arguments: list[Named], bound: tuple[Named, ...]) -> None:
        self._body: tuple[int, tuple[Named, ...]] | None = (row.args[0], (*arguments, *bound))
        self.result: Named = None

    def following(self) -> tuple[int, tuple[Named, ...]] | None:
        """The body to evaluate next with the values of its variables; ``None`` at the end."""
        body, self._body = self._body, None
        return body

    def take(self, value: Named) -> None:
        """Receive the body's value."""
        self.result = value


class _Fold:
    """A fold while its body is evaluated, iteration by iteration."""

    def __init__(self, row: FoldStep, arguments: list[Named], bound: tuple[Named, ...]) -> None:
        (count,), self.result = arguments
        self._row, self._bound = row, bound
        self._turns = iter(range(min(count, row.bound)))

    def following(self) -> tuple[int, tuple[Named, ...]] | None:
        """The body to evaluate next with the values of its variables; ``None`` at the end."""
        turn = next(self._turns, None)
        return None if turn is None else (self._row.args[2], ((turn,), *self._bound))

    def take(self, value: Named) -> None:
        """Receive the body's value in one iteration."""
        row = self._row
        kind = kind_of(row.type)
        arguments = _of_kind(kind, [self.result, value])
        self.result = evaluate(row.operator, arguments, kind=kind)


def _binder(
    row: StepRow, arguments: list[Named], bound: tuple[Named, ...]
) -> _Application | _Fold | None:
    """The evaluation of a step that has a body; ``None`` for any other."""
    if isinstance(row, FoldStep):
        return _Fold(row, arguments, bound)
    return _Application(row, arguments, bound) if row.op == "apply" else None


class _Computation:
    """Evaluates steps. They are in order, so one loop computes all but the bodies of binders.

    Bodies may contain bodies without limit, so those that wait for an inner one are kept on a list.
    """

    def __init__(self, steps: Sequence[StepRow], inputs: Inputs) -> None:
        self._steps = steps
        self._inputs = inputs
        self._depths = _depths(steps)
        self._constant: dict[int, Named] = {}
        """The values of steps that use no variable."""

    def value(self, last: int, bound: tuple[Named, ...]) -> Named:
        """The value of a step; ``bound`` are the variables around it, the innermost first."""
        body = self._begun(last, bound)
        waiting: list[tuple[_Body, _Application | _Fold]] = []
        while True:
            entered = self._advance(body)
            if entered is not None:
                waiting.append((body, entered))
            elif waiting:
                waiting[-1][1].take(self._values(body.last, body)[body.last])
            else:
                return self._values(last, body)[last]
            outer, binder = waiting[-1]
            inner = binder.following()
            if inner is not None:
                body = self._begun(*inner)
            else:
                waiting.pop()
                body = outer
                number = body.left.pop()
                self._values(number, body)[number] = binder.result

    def _begun(self, last: int, bound: tuple[Named, ...]) -> _Body:
        """The evaluation of a body, with the steps that ``last`` needs and that are not known."""
        needed: set[int] = set()
        pending, count = [last], 1
        while pending:
            number = pending.pop()
            if number not in needed and number not in self._constant:
                needed.add(number)
                arguments = _outside(self._steps[number])
                pending.extend(arguments)
                count += len(arguments) + 1
        self._inputs.meter.add(count)
        return _Body(last, bound, sorted(needed, reverse=True))

    def _values(self, number: int, body: _Body) -> dict[int, Named]:
        """The values among which a step's value is kept."""
        return body.varying if self._depths[number] else self._constant

    def _advance(self, body: _Body) -> _Application | _Fold | None:
        """Compute steps until none is left, or until one needs the value of an inner body."""
        while body.left:
            number = body.left[-1]
            row = self._steps[number]
            values = self._values(number, body)
            if number not in values:
                arguments = [self._values(each, body)[each] for each in _outside(row)]
                binder = _binder(row, arguments, body.bound)
                if binder is not None:
                    return binder
                values[number] = self._step(row, arguments, body.bound)
            body.left.pop()
        return None

    def _step(self, row: StepRow, arguments: list[Named], bound: tuple[Named, ...]) -> Named:
        """The value of a step without a body, from the values of its arguments."""
        match row:
            case ParameterStep():
                return self._inputs[row.parameter]
            case TextureStep():
                return self._inputs.textures[row.texture]
            case CallStep(op="call", function="texture_size"):
                texture, (level,) = arguments
                return texture.size(level)
            case CallStep():
                kind = kind_of(self._steps[row.args[0]].type)
                return evaluate(row.function, _of_kind(kind, arguments), kind=kind)
            case BoundStep():
                return bound[row.binder]
            case IndexStep():
                aggregate, (position,) = arguments
                part = aggregate[position]
                return part if isinstance(part, tuple | dict) else (part,)
            case _:
                return _plain(row, arguments)


def _outside(row: StepRow) -> Sequence[int]:
    """The arguments that are not a body under the step's binder."""
    arguments: Sequence[int] = row.args
    if row.op == "fold":
        return arguments[:2]
    return arguments[1:] if row.op == "apply" else arguments


def _depths(steps: Sequence[StepRow]) -> list[int]:
    """For each step, the number of binders around it that bind a variable which the step uses."""
    depths: list[int] = []
    for row in steps:
        depth = max((depths[number] for number in _outside(row)), default=0)
        if isinstance(row, BoundStep):
            depth = row.binder + 1
        elif isinstance(row, FoldStep):
            depth = max(depth, depths[row.args[2]] - 1)
        elif row.op == "apply":
            depth = max(depth, depths[row.args[0]] - len(row.args[1:]))
        depths.append(depth)
    return depths


def _of_kind(kind: Kind, arguments: list[Named]) -> list[Named]:
    """The arguments of a function of floats, as floats if the first one is an integer.

    Python's integers have no largest one, and would grow with each product.
    """
    if kind != "float" or not any(type(lane) is int for lane in arguments[0]):
        return arguments
    return [tuple(map(float, arguments[0])), *arguments[1:]]


def _plain(row: StepRow, arguments: list[Named]) -> Named:
    """The value of a step that needs only the values of its arguments."""
    match row:
        case ConstantStep():
            return _constant(row.value)
        case ComposedStep(op="vector"):
            return _few([lane for each in arguments for lane in each])
        case ComposedStep(op="matrix"):
            return _few(arguments)
        case SplatStep():
            (lane,) = arguments[0]
            return _few([lane] * lanes_of(row.type))
        case SwizzleStep():
            return _few([arguments[0][lane] for lane in row.lanes])
        case MemberStep():
            return arguments[0][row.member]
        case SelectStep():
            (condition,), then, otherwise = arguments
            return then if condition else otherwise
        case _:
            return tuple(arguments)  # An array of its elements.


def _constant(value: Any) -> Named:
    if isinstance(value, Sequence):
        return _few([_few(lane) if isinstance(lane, Sequence) else lane for lane in value])
    return (value,)


def _few(lanes: Sequence[Named]) -> Named:
    """The lanes of a vector, or the columns of a matrix. Raises ``ValueError`` for too many."""
    if len(lanes) > MOST_LANES:
        raise ValueError(f"nothing has {len(lanes)} lanes")
    return tuple(lanes)


def named(shape: Shape, value: Any) -> Named:
    """A value in the form of ``shapes``, converted to ``Named``."""
    match shape:
        case Numbers():
            return value
        case Elements(element=element):
            return tuple(named(element, inner) for inner in value)
        case Members(members=members):
            pairs = zip(members, value, strict=True)
            return {member.name: named(member.shape, inner) for member, inner in pairs}
