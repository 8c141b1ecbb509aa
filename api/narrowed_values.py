"""Reads what a parameter of a specialised shader may be: one value, or a part of its range.

``specialising.py`` calls ``narrowed_info``. Values are written as for ``burnish render --set``.
"""

from __future__ import annotations

from ..compiler.ir.leaves import Number
from ..compiler.ir.shader import ConstantValue, ParameterInfo
from ..compiler.ir.types import Array, Scalar, Type, Vector, scalar_kind, width
from ..compiler.reflection.parameters import choices_of
from ..stdlib.builtins.facts import Fact
from ..support.frozen import changed
from ..targets.runner.instances.shapes import Numbers
from ..targets.runner.instances.texts import parse
from ..targets.runner.instances.values import ParameterError, accepted, single


def narrowed_info(info: ParameterInfo, text: str, name: str) -> ParameterInfo:
    """The declaration of a parameter that has one value, such as ``0``, or a range, ``0.3..0.5``.

    Raises ``ParameterError`` for what it cannot be.
    """
    shape = _shape(info, name)
    low, dots, high = text.partition("..")
    if dots:
        return _in_range(info, _lane(shape, low, name), _lane(shape, high, name), name)
    if isinstance(info.leaf.type, Array):
        lane = _lane(shape, text, name)
        return _in_range(info, lane, lane, name)
    return _with_value(info, _lanes(shape, text, name))


def _shape(info: ParameterInfo, name: str) -> Numbers:
    """The form of a value; for an array, that of an element."""
    type_: Type = info.leaf.type
    declared = info.declared_type
    if isinstance(type_, Array):
        type_, declared = type_.element, declared.rpartition("[")[0]
    kind = scalar_kind(type_)
    if kind is None or not isinstance(type_, Scalar | Vector):
        raise ParameterError(
            name, f"`{name}` ({info.declared_type}) cannot be narrowed: numbers, vectors and "
            "arrays of these can",
        )  # fmt: skip
    names = tuple(choice.name for choice in choices_of(info.leaf) or ())
    return Numbers(declared, kind, width(type_), range=info.range, choices=names)


def _lane(shape: Numbers, written: str, name: str) -> Number:
    """A number that each lane of a value may be."""
    type_ = shape.kind if shape.lanes > 1 else shape.type
    one = Numbers(type_, shape.kind, 1, range=shape.range, choices=shape.choices)
    (lane,) = _lanes(one, written, name)
    return lane


def _lanes(shape: Numbers, written: str, name: str) -> tuple[Number, ...]:
    """The lanes of a value, as those of a constant in a text: not rounded to float32 yet."""
    given = parse(written, shape, name)
    rounded: tuple[Number, ...] = accepted(shape, given, None, name)
    lanes = tuple(given) if isinstance(given, list) else (given,)
    same = all(
        isinstance(lane, float) and single(lane) == other
        for lane, other in zip(lanes, rounded, strict=False)
    )
    return lanes if same else rounded


def _in_range(info: ParameterInfo, low: Number, high: Number, name: str) -> ParameterInfo:
    """A parameter all lanes of which lie between two numbers; its default is moved there."""
    if low > high:
        raise ParameterError(name, f"the range {low:g}..{high:g} of `{name}` is empty")
    fact = Fact(float(low), float(high), unit=info.leaf.fact.unit, kind=info.leaf.fact.kind)
    return changed(
        info, leaf=changed(info.leaf, fact=fact), range=(low, high),
        default=_moved(info.default, low, high),
    )  # fmt: skip


def _moved(default: ConstantValue | None, low: Number, high: Number) -> ConstantValue | None:
    """A default with each lane at the nearest number of a range."""
    if isinstance(default, tuple):
        return tuple(lane for each in default if (lane := _moved(each, low, high)) is not None)
    return None if default is None else min(max(default, low), high)


def _with_value(info: ParameterInfo, lanes: tuple[Number, ...]) -> ParameterInfo:
    """A parameter that has one value, which becomes its default."""
    low, high = min(lanes), max(lanes)
    fact = Fact(float(low), float(high), unit=info.leaf.fact.unit, kind=info.leaf.fact.kind)
    value = lanes[0] if len(lanes) == 1 else lanes
    limits = info.range if scalar_kind(info.leaf.type) == "bool" else (low, high)
    return changed(
        info, leaf=changed(info.leaf, fact=fact, value=value), range=limits, default=value
    )
