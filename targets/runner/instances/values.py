"""Converts the values that a host sets into lanes as the GPU will see them, and checks them.

The checks are strict: a declared range, the length of a direction and the bounds of an array are
promises because of which the compiler has left out guards.
"""

from __future__ import annotations

import math
import re
import struct
from collections.abc import Collection, Iterator, Mapping, Set
from typing import Any

from ....compiler.diagnostics.nearest import suggestion
from ....stdlib.builtins.facts import ULP
from .literals import color_lanes, measured
from .shapes import WHOLE, Elements, Members, Numbers, Shape, part

_WORD = re.compile(r"[A-Za-z]{3,}")
"""A word that may be the name of a colour."""

Value = Any
"""Nested tuples, as ``shapes`` explains."""

UNIT_TOLERANCE = 1e-3
"""The amount by which the length of a direction may differ from one. It is stored with length
one."""

UNIT_TYPES = frozenset({"direction", "normal"})
"""Declared types whose values have length one."""

_LENGTH_ROUNDING = 2.0 * ULP
"""The amount by which rounding three lanes to float32 may change a length of one, and a little
more."""


class ParameterError(ValueError):
    """A value that a parameter cannot have, or a name that no parameter has."""

    def __init__(self, name: str, message: str) -> None:
        super().__init__(message)
        self.name = name
        """The name of the parameter, or of a part of one: ``lamps[2].place``."""


class UnknownParameterError(ParameterError):
    """A name that no parameter has."""

    def __init__(self, name: str, message: str, *, names_no_value: bool = False) -> None:
        super().__init__(name, message)
        self.names_no_value = names_no_value
        """True for the name of something that has no value of its own, such as a light."""


def initial(shape: Shape, default: Any = None) -> Value:
    """The value before a host sets one: the declared default, or its part of ``default``."""
    default = shape.default if default is None else default
    match shape:
        case Numbers():
            return None if default is None else accepted(shape, default, None, "default")
        case Elements(element=element, count=count):
            given = default or (None,) * count
            return tuple(initial(element, each) for each in given)
        case Members(members=members):
            given = default or (None,) * len(members)
            pairs = zip(members, given, strict=True)
            return tuple(initial(member.shape, each) for member, each in pairs)


def changed(shape: Shape, old: Value, path: tuple[int, ...], given: object, name: str) -> Value:
    """``old`` with the part at ``path`` replaced. Raises ``ParameterError`` as ``accepted``
    does."""
    if not path:
        return accepted(shape, given, old, name)
    position, *further = path
    inner = changed(part(shape, position)[2], old[position], tuple(further), given, name)
    return (*old[:position], inner, *old[position + 1 :])


def accepted(shape: Shape, given: object, old: Value, name: str) -> Value:
    """The value of ``shape`` that a host means by ``given``, with floats rounded to float32.

    Hosts may pass sequences, mappings (for structures), arrays that have ``tolist``, and numbers of
    all kinds. Members that a mapping does not name keep their ``old`` value, and so do the elements
    after the end of a shorter list, if the array's elements are counted.

    Raises ``ParameterError`` for a value of another shape or type, and for one that breaks a
    promise.
    """
    match shape:
        case Numbers():
            return _numbers(shape, given, name)
        case Elements():
            return _elements(shape, given, old, name)
        case Members():
            return _members(shape, given, old, name)


def _elements(shape: Elements, given: object, old: Value, name: str) -> Value:
    items = _items(given)
    counted = shape.counter is not None
    if items is None or len(items) > shape.count or (len(items) < shape.count and not counted):
        most = f"at most {shape.count}" if counted else f"{shape.count}"
        wanted = f"a list of {most} {_plural('element', shape.count)} ({shape.type})"
        raise _misshapen(name, wanted, given, items)
    new = [accepted(shape.element, item, old[i], f"{name}[{i}]") for i, item in enumerate(items)]
    return (*new, *old[len(new) :])


def _members(shape: Members, given: object, old: Value, name: str) -> Value:
    names = [member.name for member in shape.members]
    if not isinstance(given, Mapping):
        raise _misshapen(name, f"a mapping of {', '.join(names)} ({shape.type})", given, None)
    for key in given:
        if key not in names:
            hint = suggestion(str(key), names) or f"there are {', '.join(names)}"
            raise ParameterError(f"{name}.{key}", f"`{name}` has no member `{key}`: {hint}")
    return tuple(
        accepted(member.shape, given[member.name], before, f"{name}.{member.name}")
        if member.name in given
        else before
        for member, before in zip(shape.members, old, strict=True)
    )


def _numbers(shape: Numbers, given: object, name: str) -> Value:
    if isinstance(given, str) and not shape.choices:
        given = _literal(shape, given, name)
    if not shape.columns:
        return _vector(shape, given, name)
    columns = _items(given)
    if columns is not None and len(columns) == shape.columns * shape.lanes:
        columns = _rows(columns, shape.lanes)
    if columns is None or len(columns) != shape.columns:
        wanted = f"{shape.columns} columns of {shape.lanes} numbers ({shape.type})"
        raise _misshapen(name, wanted, given, columns)
    return tuple(_vector(shape, column, name) for column in columns)


def _vector(shape: Numbers, given: object, name: str) -> Value:
    items = _items(given)
    if shape.lanes == 1 and items is None:
        lanes: tuple[Any, ...] = (_lane(shape, given, name),)
    elif items is None or len(items) != shape.lanes or shape.lanes == 1:
        amount = "one number" if shape.lanes == 1 else f"{shape.lanes} numbers"
        what = "columns of " if shape.columns else ""
        raise _misshapen(name, f"{what}{amount} ({shape.type})", given, items)
    else:
        lanes = tuple(_lane(shape, item, name) for item in items)
    has_length_one = shape.meaning in UNIT_TYPES and shape.lanes > 1
    return _unit(lanes, shape.meaning, name) if has_length_one else lanes


def _lane(shape: Numbers, given: object, name: str) -> Any:
    """A lane of the type that ``shape`` requires, within its range."""
    given = _plain(given)
    if shape.choices and isinstance(given, str):
        return _member(shape, given, name)
    if shape.kind == "bool":
        return _bool(given, shape, name)
    value = _float(given, shape, name) if shape.kind == "float" else _integer(given, shape, name)
    if shape.range is not None:
        lo, hi = map(single, shape.range) if shape.kind == "float" else shape.range
        if not lo <= value <= hi:
            raise ParameterError(name, _out_of_range(shape, given, value, name))
    return value


def _member(shape: Numbers, given: str, name: str) -> int:
    """The number of a member of an enumeration; its name may stand behind the enumeration's."""
    own = given.removeprefix(f"{shape.type}.")
    if own in shape.choices:
        return shape.choices.index(own)
    hint = suggestion(own, shape.choices) or f"there is {', '.join(shape.choices)}"
    raise ParameterError(name, f"`{name}` ({shape.type}) has no member `{given}`: {hint}")


def _bool(given: object, shape: Numbers, name: str) -> bool:
    if isinstance(given, int) and given in (0, 1):
        return bool(given)
    raise _wrong_kind(given, shape, name)


def _integer(given: object, shape: Numbers, name: str) -> int:
    if isinstance(given, bool) or not isinstance(given, int | float) or given != given // 1:
        raise _wrong_kind(given, shape, name)
    lo, hi = WHOLE[shape.kind]
    if not lo <= given <= hi:
        raise ParameterError(
            name, f"`{name}` is a 32-bit {shape.kind}, {lo} to {hi}: {shown(given)} is not"
        )
    return int(given)


def _float(given: object, shape: Numbers, name: str) -> float:
    if isinstance(given, bool | str) or not hasattr(given, "__float__"):
        raise _wrong_kind(given, shape, name)
    try:
        value = float(given)
    except OverflowError:
        value = math.inf
    if math.isnan(value) or given in (math.inf, -math.inf):
        raise ParameterError(name, f"`{name}` takes finite numbers, and {shown(given)} is none")
    rounded = single(value)
    if math.isinf(rounded):
        raise ParameterError(name, f"`{name}` is a float32, and {shown(given)} is too large for it")
    return rounded


def _unit(lanes: tuple[float, ...], meaning: str, name: str) -> tuple[float, ...]:
    """A vector of length one; one that already has this length, up to rounding, stays unchanged."""
    length = math.hypot(*lanes)
    if abs(length - 1.0) <= _LENGTH_ROUNDING:
        return lanes
    if abs(length - 1.0) <= UNIT_TOLERANCE:
        return tuple(single(lane / length) for lane in lanes)
    message = f"`{name}` is a {meaning} and has to be of length 1, not {length:.6g}"
    if length > 0.0:
        message += f": that would be ({', '.join(f'{lane / length:.6g}' for lane in lanes)})"
    raise ParameterError(name, message)


def unset(shape: Shape, value: Value, name: str) -> Iterator[tuple[str, Numbers | Elements]]:
    """The parts without a value, by name; an array of numbers without any value counts as one
    part."""
    if isinstance(shape, Numbers):
        if value is None:
            yield name, shape
    elif isinstance(shape, Elements) and all(element is None for element in value) and value:
        yield name, shape
    else:
        for position, inner in enumerate(value):
            text, _, inner_shape = part(shape, position)
            yield from unset(inner_shape, inner, name + text)


def filled(shape: Shape, value: Value) -> Value:
    """The value with zeros in place of missing parts."""
    if not isinstance(shape, Numbers):
        return tuple(filled(part(shape, i)[2], inner) for i, inner in enumerate(value))
    if value is not None:
        return value
    zero = {"float": 0.0, "bool": False}.get(shape.kind, 0)
    column = (zero,) * shape.lanes
    return (column,) * shape.columns if shape.columns else column


def plain(shape: Shape, value: Value) -> Any:
    """The value in the form that hosts use: numbers, tuples, and mappings for structures."""
    match shape:
        case Numbers():
            return value[0] if value is not None and shape.lanes == 1 else value
        case Elements(element=element):
            return tuple(plain(element, inner) for inner in value)
        case Members(members=members):
            pairs = zip(members, value, strict=True)
            return {member.name: plain(member.shape, inner) for member, inner in pairs}


def rounded(value: Value) -> Value:
    """The value with every float replaced by the nearest float32."""
    if isinstance(value, tuple):
        return tuple(map(rounded, value))
    return single(value) if isinstance(value, float) else value


def single(value: float) -> float:
    """The nearest float32; infinite if the number is too large."""
    try:
        rounded: float = struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)
    return rounded


def _literal(shape: Numbers, text: str, name: str) -> object:
    """The value of a literal text: a colour, an angle or a length."""
    if shape.is_color and text.startswith("#"):
        lanes = color_lanes(text)
        if lanes is None:
            raise ParameterError(name, f"`{name}`: {text} is no colour, which would be #b5651d")
        return lanes if len(lanes) >= shape.lanes else (*lanes, 1.0)
    number = measured(text, shape.meaning)
    if number is None:
        raise _wrong_kind(text, shape, name)
    return number


# --- messages ------------------------------------------------------------------------------------


def shown(given: object) -> str:
    """A value as text for a message, shortened if it is long."""
    given = _plain(given)
    if isinstance(given, float) and given.is_integer() and abs(given) < 1e15:
        return str(int(given))
    text = repr(given)
    return text if len(text) <= 40 else f"{text[:37]}..."


def _out_of_range(shape: Numbers, given: object, value: float, name: str) -> str:
    """The message about a number outside of its range; an angle may be written in degrees."""
    assert shape.range is not None
    if shape.meaning != "angle":
        limits = f"{shown(shape.range[0])}..{shown(shape.range[1])}"
        return f"`{name}` is declared in {limits}: {shown(given)} is not"
    low, high = (f"{math.degrees(limit):g}deg" for limit in shape.range)
    said, degrees = f"`{name}` is declared in {low}..{high}", f"{math.degrees(value):.5g}deg"
    if float(value).is_integer() and shape.range[0] <= math.radians(value) <= shape.range[1]:
        return f"{said}: {shown(given)} is {degrees}; did you mean {shown(given)}deg?"
    return f"{said}: {degrees} is not"


def _wrong_kind(given: object, shape: Numbers, name: str) -> ParameterError:
    said = f"`{name}` ({shape.type}) cannot hold {shown(given)}"
    if shape.is_color and isinstance(given, str) and _WORD.fullmatch(given):
        from ....stdlib.builtins.elsewhere import VALUES

        color = VALUES.get(given.casefold(), "")
        said += f": a colour is written {color if color.startswith('#') else '#b5651d'}"
    return ParameterError(name, said)


def _misshapen(
    name: str, wanted: str, given: object, items: tuple[Any, ...] | None
) -> ParameterError:
    found = shown(given) if items is None else f"a list of {len(items)}"
    return ParameterError(name, f"`{name}` takes {wanted}, and was given {found}")


def _plural(noun: str, count: int) -> str:
    return noun if count == 1 else f"{noun}s"


def _plain(given: object) -> object:
    """Arrays of any library as lists, and their scalars as Python's numbers."""
    return given.tolist() if hasattr(given, "tolist") else given


def _items(given: object) -> tuple[Any, ...] | None:
    """The items of an ordered collection; ``None`` for anything else."""
    given = _plain(given)
    if isinstance(given, str | bytes | bytearray | Mapping | Set):
        return None
    return tuple(given) if isinstance(given, Collection) else None


def _rows(items: tuple[Any, ...], length: int) -> tuple[Any, ...]:
    return tuple(items[at : at + length] for at in range(0, len(items), length))
