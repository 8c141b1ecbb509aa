"""Computes derived values in double precision, from the steps in the reflection.

``Instance.blocks`` calls it. The functions are those of the reference, so a value means the same
here as everywhere.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ....compiler.reference.functions import evaluate
from ....compiler.trampoline import Step, run
from .shapes import Elements, Members, Numbers, Shape, kind_of

Row = Mapping[str, Any]
"""One row of ``steps``."""

Named = Any
"""A value in the form of ``shapes``, in which a structure is a mapping of its members by name."""


class Inputs:
    """The values of the parameters, converted to ``Named`` when a step first reads them."""

    def __init__(self, shapes: Mapping[str, Shape], values: Mapping[str, Any]) -> None:
        self._shapes = shapes
        self._values = values
        self._known: dict[str, Named] = {}

    def __getitem__(self, parameter: str) -> Named:
        """The stored value of a parameter."""
        if parameter not in self._known:
            value = named(self._shapes[parameter], self._values[parameter])
            self._known[parameter] = value
        return self._known[parameter]


def compute(steps: Sequence[Row], inputs: Inputs) -> Named:
    """The value of the last step: a tuple of lanes, or of a matrix's columns, not yet rounded."""
    return run(_Computation(steps, inputs).value(len(steps) - 1, ()))


def compute_elements(steps: Sequence[Row], inputs: Inputs, count: int) -> tuple[Named, ...]:
    """The last step's value for each element of an array; its number is the only free variable.

    Elements that are not in use are computed as well; no function raises, whatever they contain.
    """
    computation = _Computation(steps, inputs)
    return tuple(run(computation.value(len(steps) - 1, ((i,),))) for i in range(count))


class _Computation:
    """Evaluates steps. They are in order, so one loop computes all but the bodies of binders."""

    def __init__(self, steps: Sequence[Row], inputs: Inputs) -> None:
        self._steps = steps
        self._inputs = inputs
        self._depths = _depths(steps)
        self._constant: dict[int, Named] = {}
        """The values of steps that use no variable."""

    def value(self, last: int, bound: tuple[Named, ...]) -> Step[Named]:
        """The value of a step; ``bound`` are the variables around it, the innermost first."""
        varying: dict[int, Named] = {}
        for number in self._needed(last):
            found = varying if self._depths[number] else self._constant
            if number not in found:
                arguments = [
                    (varying if self._depths[argument] else self._constant)[argument]
                    for argument in _outside(self._steps[number])
                ]
                found[number] = yield self._step(self._steps[number], arguments, bound)
        return (varying if self._depths[last] else self._constant)[last]

    def _needed(self, last: int) -> list[int]:
        """The steps that ``last`` needs, including itself, without bodies and known values."""
        needed: set[int] = set()
        pending = [last]
        while pending:
            number = pending.pop()
            if number not in needed and number not in self._constant:
                needed.add(number)
                pending.extend(_outside(self._steps[number]))
        return sorted(needed)

    def _step(self, row: Row, arguments: list[Named], bound: tuple[Named, ...]) -> Step[Named]:
        match row["op"]:
            case "parameter":
                return self._inputs[row["parameter"]]
            case "call" | "native":
                kind = kind_of(self._steps[row["args"][0]]["type"])
                return evaluate(row["function"], arguments, kind=kind)
            case "bound":
                return bound[row["binder"]]
            case "apply":
                applied = yield self.value(row["args"][0], (*arguments, *bound))
                return applied
            case "fold":
                folded = yield self._folded(row, arguments, bound)
                return folded
            case "index":
                aggregate, (position,) = arguments
                part = aggregate[position]
                return part if isinstance(part, tuple | dict) else (part,)
            case op:
                return _PLAIN[op](row, arguments)

    def _folded(self, row: Row, arguments: list[Named], bound: tuple[Named, ...]) -> Step[Named]:
        (count,), total = arguments
        for turn in range(min(count, row["bound"])):
            term = yield self.value(row["args"][2], ((turn,), *bound))
            total = evaluate(row["operator"], (total, term), kind=kind_of(row["type"]))
        return total


def _outside(row: Row) -> Sequence[int]:
    """The arguments that are not a body under the step's binder."""
    arguments: Sequence[int] = row["args"]
    if row["op"] == "fold":
        return arguments[:2]
    return arguments[1:] if row["op"] == "apply" else arguments


def _depths(steps: Sequence[Row]) -> list[int]:
    """For each step, how many of the binders around it bind a variable that it uses."""
    depths: list[int] = []
    for row in steps:
        depth = max((depths[number] for number in _outside(row)), default=0)
        if row["op"] == "bound":
            depth = row["binder"] + 1
        elif row["op"] == "fold":
            depth = max(depth, depths[row["args"][2]] - 1)
        elif row["op"] == "apply":
            depth = max(depth, depths[row["args"][0]] - len(row["args"][1:]))
        depths.append(depth)
    return depths


def _constant(row: Row, _arguments: list[Named]) -> Named:
    value = row["value"]
    if isinstance(value, Sequence):
        return tuple(tuple(lane) if isinstance(lane, Sequence) else lane for lane in value)
    return (value,)


def _select(_row: Row, arguments: list[Named]) -> Named:
    (condition,), then, otherwise = arguments
    return then if condition else otherwise


_PLAIN: Mapping[str, Callable[[Row, list[Named]], Named]] = {
    "constant": _constant,
    "vector": lambda _row, arguments: tuple(lane for each in arguments for lane in each),
    "splat": lambda row, arguments: arguments[0] * int(row["type"][-1]),
    "matrix": lambda _row, arguments: tuple(arguments),
    "swizzle": lambda row, arguments: tuple(arguments[0][lane] for lane in row["lanes"]),
    "member": lambda row, arguments: arguments[0][row["member"]],
    "select": _select,
}
"""The value of each operation without variables, from the values of its arguments."""


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
