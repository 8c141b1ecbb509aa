"""Vectors that are taken apart and put together."""

from __future__ import annotations

from collections.abc import Sequence

from .nodes import Nodes
from .unsayable import UnsayableError
from .values import (
    SAME_LANES,
    Constant,
    Linked,
    Value,
    lanes_of,
    retyped,
    type_of_constructor,
    vector,
)

_LETTERS = ("xyzw", "rgba")


def lanes(nodes: Nodes, value: Value) -> list[Value]:
    """The lanes of a vector; of a number, itself."""
    if isinstance(value, Constant):
        return [Constant("float", (number,)) for number in value.numbers]
    if not isinstance(value, Linked) or not lanes_of(value.type):
        raise UnsayableError("this has no lanes")
    if lanes_of(value.type) == 1:
        return [value]
    return [_lane(nodes, value, place) for place in range(lanes_of(value.type))]


def _lane(nodes: Nodes, value: Value, place: int) -> Value:
    if isinstance(value, Constant):
        return Constant("float", (value.numbers[place],))
    assert isinstance(value, Linked)
    return nodes.lane(value, place)


def picked(nodes: Nodes, value: Value, names: str) -> Value:
    """Some lanes of a vector, by their letters."""
    letters = next((each for each in _LETTERS if set(names) <= set(each)), "")
    if not letters or not isinstance(value, Constant | Linked):
        raise UnsayableError(f"nothing has a member `{names}` in MaterialX")
    places = [letters.index(name) for name in names]
    if lanes_of(value.type) == 1 and places == [0]:
        return value
    if len(places) == 1:
        return _lane(nodes, value, places[0])
    is_color = letters == "rgba" and len(places) > 2
    kind = f"{'color' if is_color else 'vector'}{len(places)}"
    if isinstance(value, Constant):
        return vector([value.numbers[place] for place in places], kind)
    have = lanes_of(value.type)
    if places == list(range(have)):
        return value
    if places == list(range(len(places))):
        if value.type.startswith("color") and len(places) > 2:
            kind = f"color{len(places)}"
        return nodes.plain("convert", kind, {"in": value})
    return combined(nodes, [_lane(nodes, value, place) for place in places], kind)


def combined(nodes: Nodes, values: Sequence[Value], kind: str) -> Value:
    """Single lanes as a vector."""
    if all(isinstance(value, Constant) for value in values):
        return vector([v.numbers[0] for v in values if isinstance(v, Constant)], kind)
    given = {f"in{place + 1}": value for place, value in enumerate(values)}
    return nodes.node(f"combine{len(values)}", given, kind)


def built(nodes: Nodes, name: str, values: Sequence[Value], wanted: str) -> Value:
    """The value of a constructor, such as ``vec3(a, 0, 1)``."""
    kind = type_of_constructor(name)
    if not kind:
        raise UnsayableError(f"MaterialX has no type `{name}`", "use numbers, vectors or colours")
    if SAME_LANES.get(kind) == wanted:
        kind = wanted
    if kind.startswith("matrix"):
        return _matrix(nodes, kind, values)
    if len(values) == 1:
        return _of_one(nodes, kind, values[0])
    given = {f"in{place + 1}": value for place, value in enumerate(values)}
    shapes = [lanes_of(getattr(value, "type", "")) for value in values]
    if _is_filled(kind, values):
        return nodes.node("convert", {"in": values[0]}, kind, must=True)
    if shapes in ([3, 1], [2, 2]) and not all(isinstance(value, Constant) for value in values):
        target = kind if shapes == [3, 1] else "vector4"
        return nodes.node("combine2", given, target, must=True)
    return combined(nodes, [lane for value in values for lane in lanes(nodes, value)], kind)


def _is_filled(kind: str, values: Sequence[Value]) -> bool:
    """True for a vector with one lane more, which a conversion fills: with 0, and alpha with 1."""
    if len(values) != 2:
        return False
    vector_value, last = values
    if not isinstance(vector_value, Linked) or lanes_of(vector_value.type) != lanes_of(kind) - 1:
        return False
    filling = 1.0 if kind == "color4" else 0.0
    return isinstance(last, Constant) and last.numbers == (filling,) and len(last.numbers) == 1


def _of_one(nodes: Nodes, kind: str, value: Value) -> Value:
    """A conversion: one number for all lanes, fewer lanes, or another kind of number."""
    if isinstance(value, Constant):
        if kind in ("integer", "boolean", "float") and len(value.numbers) == 1:
            number = value.numbers[0]
            whole = {"integer": float(int(number)), "boolean": float(bool(number))}
            return vector((whole.get(kind, number),), kind)
        found = retyped(value, kind)
        if found is not None:
            return found
        return vector(value.numbers[: lanes_of(kind)], kind)
    if not isinstance(value, Linked):
        raise UnsayableError("this is no number or vector")
    if value.type == kind or SAME_LANES.get(value.type) == kind:
        return value
    if kind == "integer" and value.type != "boolean":
        # A float is cut off towards zero.
        down = nodes.node("floor", {"in": value}, "integer", must=True)
        up = nodes.node("ceil", {"in": value}, "integer", must=True)
        sides: dict[str, Value] = {"value1": value, "value2": vector((0,), "float")}
        return nodes.node("ifgreatereq", {**sides, "in1": down, "in2": up}, "integer", must=True)
    if kind == "boolean" and value.type == "float":
        zero = nodes.node(
            "ifequal", {"value1": value, "value2": vector((0,), "float")}, "boolean", must=True
        )
        return nodes.node("not", {"in": zero}, "boolean")
    return nodes.node("convert", {"in": value}, kind, must=True)


def _matrix(nodes: Nodes, kind: str, values: Sequence[Value]) -> Value:
    """A matrix of its columns, of one number on the diagonal, or of all numbers."""
    side = int(kind[-1])
    constants = [value for value in values if isinstance(value, Constant)]
    if len(constants) == len(values):
        numbers = [number for value in constants for number in value.numbers]
        if len(numbers) == 1:
            places = range(side * side)
            numbers = [numbers[0] * (place % (side + 1) == 0) for place in places]
        return vector(numbers, kind)
    if len(values) != side:
        raise UnsayableError("MaterialX makes matrices of whole columns")
    given = {f"in{place + 1}": value for place, value in enumerate(values)}
    return nodes.node("creatematrix", given, kind, must=True)


def matrix_column(nodes: Nodes, value: Value, place: int) -> Value:
    """A lane of a vector, or a column of a matrix."""
    if isinstance(value, Constant):
        if not value.type.startswith("matrix"):
            return Constant("float", (value.numbers[place],))
        side = int(value.type[-1])
        return vector(value.numbers[place * side : (place + 1) * side], f"vector{side}")
    return _lane(nodes, value, place)


def upright(nodes: Nodes, value: Value) -> Value:
    """Coordinates with v downwards as those with v upwards, and back."""
    if isinstance(value, Linked) and value.node in nodes.upright:
        return nodes.upright[value.node]
    x, y = lanes(nodes, value)
    down = nodes.node("subtract", {"in1": vector((1,), "float"), "in2": y})
    found = nodes.node("combine2", {"in1": x, "in2": down}, "vector2", must=True)
    if isinstance(found, Linked):
        nodes.upright[found.node] = value
    return found
