"""Nodes that take vectors apart, put them together and convert between types."""

from __future__ import annotations

import re

from ..expressions import Call, Expression, Member, Name, Number, flat, is_literal
from ..model import Definition
from ..networks import Application, Row
from ..problems import UnsupportedError
from ..values import BARE, LANES, TYPES

_LANE_NAMES = "xyzw"


def _lane(vector: Expression, lane: int) -> Expression:
    """One lane of a vector; of a vector that is put together here, what was put in."""
    if isinstance(vector, Call) and vector.name.rstrip("1234") in ("vec", "rgb", "rgba"):
        if is_literal(vector) and len(vector.arguments) == 1:
            return vector.arguments[0]
        if len(vector.arguments) == LANES_OF.get(vector.name):
            return vector.arguments[lane]
    return Member(vector, _LANE_NAMES[lane])


LANES_OF = {"vec2": 2, "vec3": 3, "vec4": 4, "rgb": 3, "rgba": 4}


def _extract(node: Application) -> Expression:
    kind = node.input_type("in")
    value, index = node.inputs("in", "index")
    if not isinstance(index, Name) or not index.text.isdigit():
        return Name(f"{flat(value, 8)}[{flat(index)}]")
    place = int(index.text)
    if kind.startswith("matrix"):
        return Member(value, str(place))
    if place >= LANES[kind]:
        raise UnsupportedError(f"the index {place} is outside of a {kind}")
    return _lane(value, place)


def _separated(node: Application) -> Expression:
    name = node.output.removeprefix("out")
    lane = "rgba".find(name) if name in "rgba" else _LANE_NAMES.find(name)
    return _lane(node.input("in"), lane)


def _combined(node: Application) -> Expression:
    parts = [node.input(f"in{place + 1}") for place in range(_count(node))]
    lanes = [
        part
        for place, part in enumerate(parts)
        for part in _apart(part, node.input_type(f"in{place + 1}"))
    ]
    return Call(BARE[node.type], tuple(_joined(lanes)))


def _apart(part: Expression, kind: str) -> list[Expression]:
    if isinstance(part, Call) and is_literal(part) and len(part.arguments) == 1 and LANES[kind] > 1:
        return list(part.arguments) * LANES[kind]
    return [part]


def _count(node: Application) -> int:
    return int(node.node.category[-1])


def _joined(lanes: list[Expression]) -> list[Expression]:
    """``v.x, v.y`` as ``v.xy``."""
    found: list[Expression] = []
    for lane in lanes:
        last = found[-1] if found else None
        if _is_swizzle(last) and _is_swizzle(lane):
            assert isinstance(last, Member) and isinstance(lane, Member)
            if last.base == lane.base:
                found[-1] = Member(last.base, last.name + lane.name)
                continue
        found.append(lane)
    return found


def _is_swizzle(expression: Expression | None) -> bool:
    return isinstance(expression, Member) and not set(expression.name) - set(_LANE_NAMES)


def _convert(node: Application) -> Expression:
    value = node.input("in")
    kind, result = node.input_type("in"), node.type
    if kind == "boolean":
        return _of_truth(value, result)
    if result == "boolean":
        return Call("bool", (value,))
    if result == "integer":
        return Call("int", (value,))
    if kind == "integer":
        number = Call("float", (value,))
        return number if result == "float" else _spread(number, result)
    if kind == "float":
        return _spread(value, result)
    return _resized(value, kind, result)


def _of_truth(value: Expression, result: str) -> Expression:
    if value in (Name("true"), Name("false")):
        number: Expression = Number(float(value == Name("true")))
        return _spread(number, result)
    if result == "integer":
        return Call("int", (value,))
    number = Call("float", (value,))
    return number if result == "float" else _spread(number, result)


def _spread(value: Expression, result: str) -> Expression:
    """A number in all lanes; alpha is 1."""
    if result == "float":
        return value
    if result == "color4":
        return Call("vec4", (Call("vec3", (value,)), Number(1.0)))
    return Call(BARE[result], (value,))


def _resized(value: Expression, kind: str, result: str) -> Expression:
    have, want = LANES[kind], LANES[result]
    if have == want:
        return (
            value
            if isinstance(value, Call) and value.name == BARE[result]
            else Call(BARE[result], (value,))
        )
    if have > want:
        lanes = _LANE_NAMES[:want]
        return Member(value, lanes)
    rest = Number(1.0 if result == "color4" else 0.0)
    return Call(BARE[result], (value, *[rest] * (want - have)))


def _matrix(node: Application) -> Expression:
    side = int(node.type[-1])
    columns = []
    for place in range(side):
        column = node.input(f"in{place + 1}")
        if LANES[node.input_type(f"in{place + 1}")] < side:
            column = Call("vec4", (column, Number(float(place == side - 1))))
        columns.append(column)
    return Call(TYPES[node.type], tuple(columns))


_MEMBER = re.compile(r"\{\{(\w+)\}\}((?:\.\w+)+)")


def gives_member(definition: Definition) -> bool:
    """True for a leaf of a document that gives a member of one of its inputs."""
    return _MEMBER.fullmatch(definition.source) is not None


def member(node: Application) -> Expression:
    """A member of an input, which the definition of a node names: ``{{in}}.ss``."""
    assert node.node.definition is not None
    found = _MEMBER.fullmatch(node.node.definition.source)
    assert found is not None, "only leaves with such a source are written so"
    value, kind = node.input(found[1]), node.input_type(found[1])
    for name in found[2].removeprefix(".").split("."):
        value, kind = node.texts.structures.member(value, kind, name)
    if kind != node.type:
        raise UnsupportedError(f"'{found[0]}' is a {kind}, and no {node.type}")
    return value


ROWS: dict[str, Row] = {
    "extract": _extract,
    **dict.fromkeys(("separate2", "separate3", "separate4"), _separated),
    **dict.fromkeys(("combine2", "combine3", "combine4"), _combined),
    "convert": _convert,
    "creatematrix": _matrix,
}
