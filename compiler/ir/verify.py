"""Checks that a graph is well formed: what every pass may rely on and has to keep.

The form tightens on the way through the compiler. Binders are closed as semantics leaves them, then
``opened``; a ``guarded`` graph has no ``call``, and a ``stored`` one reads parameters as blocks
hold them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Literal

from . import signatures
from .build import parts_of, states_type
from .leaves import Attribute, Parameter, Resource
from .node import Folding, Formal, Iterating, Node, binders, bodies_of, formals_of, reachable
from .storage import stored_type
from .types import (
    BOOL,
    INT,
    VEC4,
    Array,
    Matrix,
    Scalar,
    ScalarKind,
    Struct,
    TallMatrix,
    Texture,
    Type,
    Vector,
    scalar_kind,
    width,
    with_width,
)

Form = Literal["semantics", "opened", "guarded", "stored"]
Variables = frozenset[tuple[Formal | int, Type]]
"""Variables of binders further out, by formal or de Bruijn index, and the types of their uses."""

_LANES: Mapping[ScalarKind, type] = {"float": float, "int": int, "uint": int, "bool": bool}


class InvalidGraphError(Exception):
    """A pass (or semantics) made a graph that is not well formed."""

    def __init__(self, node: Node, reason: str) -> None:
        operands = "".join(f"\n  {operand!r}" for operand in node.operands)
        super().__init__(f"{reason}: {node!r}{operands}")
        self.node = node


def verify(roots: Iterable[Node], *, stage: Form) -> None:
    """Raise ``InvalidGraphError`` at the first node under ``roots`` that is not well formed."""
    wanted = list(roots)
    variables: dict[int, Variables] = {}
    crossing: set[int] = set()
    for node in reachable(wanted):
        _check_order(node)
        _check_form(node, stage)
        _check_type(node, stage)
        variables[node.id] = _variables(node, variables)
        if node.op == "interpolate" and node.operands[0].id in crossing:
            raise InvalidGraphError(node, "a crossing behind a crossing")
        if node.op == "interpolate" or any(operand.id in crossing for operand in node.operands):
            crossing.add(node.id)
    for root in wanted:
        for variable, _type in variables[root.id]:
            raise InvalidGraphError(root, f"{variable} is used outside its binder")


def _check_order(node: Node) -> None:
    if any(operand.id >= node.id for operand in node.operands):
        raise InvalidGraphError(node, "an operand is not older than its user")


def _check_form(node: Node, stage: Form) -> None:
    if stage != "semantics" and (node.op == "bound" or binders(node)):
        raise InvalidGraphError(node, "a binder that has not been opened")
    if stage in ("guarded", "stored") and node.op == "call":
        raise InvalidGraphError(node, "a builtin that has not been guarded")


# --- variables -----------------------------------------------------------------------------------


def _variables(node: Node, known: Mapping[int, Variables]) -> Variables:
    """The variables in ``node`` that binders further out have to bind."""
    if node.op == "bound" and isinstance(node.data, int):
        return frozenset(((node.data, node.type),))
    if node.op == "formal" and isinstance(node.data, Formal):
        return frozenset(((node.data, node.type),))
    inside = bodies_of(node)
    others = [known[o.id] for i, o in enumerate(node.operands) if i not in inside]
    bodies = [_bound(node, known[node.operands[i].id]) for i in inside]
    found = [variables for variables in (*others, *bodies) if variables]
    return found[0].union(*found[1:]) if found else frozenset()


def _bound(node: Node, used: Variables) -> Variables:
    """Of the variables in a body of ``node``, those that it does not bind."""
    if not used:
        return used
    types = _variable_types(node)
    count = binders(node)
    left: set[tuple[Formal | int, Type]] = set()
    for variable, type_ in used:
        wanted = types.get(variable)
        if wanted is not None and wanted != type_:
            raise InvalidGraphError(node, f"{variable} is a {wanted}, used as a {type_}")
        if wanted is None:
            left.add((variable - count if isinstance(variable, int) else variable, type_))
    return frozenset(left)


def _variable_types(node: Node) -> dict[Formal | int, Type]:
    """What ``node`` binds in its body."""
    match node.data:
        case Folding():
            types: list[Type] = [INT]
        case Iterating(states=states):
            types = [INT, *(start.type for start in node.operands[1 : 1 + states])]
        case _:
            types = [argument.type for argument in node.operands[1:]]
    return dict(zip(formals_of(node) or range(len(types)), types, strict=True))


# --- types ---------------------------------------------------------------------------------------


def _check_type(node: Node, stage: Form) -> None:
    if isinstance(node.data, Parameter):
        declared = node.data.type
        wanted: Type | None = stored_type(declared) if stage == "stored" else declared
    else:
        wanted = _RULES[node.op](node)
    if wanted is None:
        raise InvalidGraphError(node, "operands or data that the operation does not take")
    if wanted != node.type:
        raise InvalidGraphError(node, f"has type {node.type} instead of {wanted}")


def _declared(node: Node) -> Type | None:
    return node.data.type if isinstance(node.data, Attribute | Resource) else None


def _own(node: Node) -> Type | None:
    """Leaves whose type stands nowhere else."""
    return None if node.operands else node.type


def _constant(node: Node) -> Type | None:
    return node.type if _holds(node.type, node.data) else None


def _holds(type_: Type, data: object) -> bool:
    match type_:
        case Scalar(kind):
            # A bool is an int to Python, but not to us.
            return isinstance(data, _LANES[kind]) and (kind == "bool") == isinstance(data, bool)
        case Vector(kind, size):
            return _all_hold(Scalar(kind), size, data)
        case Matrix(size):
            return _all_hold(Vector("float", size), size, data)
        case _:
            return False


def _all_hold(part: Type, count: int, data: object) -> bool:
    return isinstance(data, tuple) and len(data) == count and all(_holds(part, d) for d in data)


def _builtin(node: Node) -> Type | None:
    types = tuple(operand.type for operand in node.operands)
    return signatures.result_type(str(node.data), types)


def _native(node: Node) -> Type | None:
    """As a builtin; besides, hardware multiplies a stored matrix with a column."""
    match [operand.type for operand in node.operands]:
        case [TallMatrix(columns), Vector("float", size)] if node.data == "mul":
            return VEC4 if size == columns else None
        case _:
            return _builtin(node)


def _vector(node: Node) -> Type | None:
    kinds = {operand.type.kind for operand in node.operands if _is_numeric(operand)}  # type: ignore[union-attr]
    if len(kinds) != 1 or not all(map(_is_numeric, node.operands)):
        return None
    lanes = sum(width(operand.type) for operand in node.operands)
    return Vector(kinds.pop(), lanes) if 2 <= lanes <= 4 else None


def _splat(node: Node) -> Type | None:
    (lane,) = node.operands
    fits = isinstance(lane.type, Scalar) and isinstance(node.type, Vector)
    return Vector(lane.type.kind, node.type.size) if fits else None  # type: ignore[union-attr]


def _matrix(node: Node) -> Type | None:
    size = len(node.operands)
    columns = all(operand.type == Vector("float", size) for operand in node.operands)
    return Matrix(size) if columns else None


def _aggregate(node: Node) -> Type | None:
    wanted = Struct if node.op == "struct" else Array
    given = tuple(operand.type for operand in node.operands)
    return node.type if isinstance(node.type, wanted) and parts_of(node.type) == given else None


def _swizzle(node: Node) -> Type | None:
    (source,) = node.operands
    lanes = node.data
    if not isinstance(source.type, Vector) or not isinstance(lanes, tuple) or len(lanes) > 4:
        return None
    inside = lanes and all(0 <= lane < source.type.size for lane in lanes)
    return with_width(source.type.kind, len(lanes)) if inside else None


def _index(node: Node) -> Type | None:
    aggregate, position = (operand.type for operand in node.operands)
    if position not in (INT, Scalar("uint")):
        return None
    match aggregate:
        case Array(element=element):
            return element
        case Matrix(size=size):
            return Vector("float", size)
        case TallMatrix():
            return VEC4
        case Vector(kind=kind):
            return Scalar(kind)
        case _:
            return None


def _member(node: Node) -> Type | None:
    (source,) = node.operands
    members = source.type.members if isinstance(source.type, Struct) else ()
    return dict(members).get(str(node.data))


def _select(node: Node) -> Type | None:
    condition, then, otherwise = (operand.type for operand in node.operands)
    fits = condition == BOOL and then == otherwise and not isinstance(then, Texture)
    return then if fits else None


def _interpolate(node: Node) -> Type | None:
    (inner,) = node.operands
    modes = ("perspective", "flat") if scalar_kind(inner.type) == "float" else ("flat",)
    numeric = _is_numeric(inner) and scalar_kind(inner.type) != "bool"
    return inner.type if numeric and node.data in modes else None


def _fold(node: Node) -> Type | None:
    count, start, body = (operand.type for operand in node.operands)
    fits = isinstance(node.data, Folding) and count == INT and start == body
    return body if fits and _is_numeric(node.operands[2]) else None


def _iterate(node: Node) -> Type | None:
    data = node.data
    if not isinstance(data, Iterating) or len(node.operands) != 2 + 2 * data.states:
        return None
    count, *states = (operand.type for operand in node.operands)
    starts, going, nexts = states[: data.states], states[data.states], states[data.states + 1 :]
    fits = count == INT and going == BOOL and starts == nexts
    plain = all(isinstance(type_, Scalar | Vector | Matrix) for type_ in starts)
    return states_type(starts) if fits and plain else None


def _apply(node: Node) -> Type | None:
    body, *arguments = node.operands
    fits = node.data is None or (isinstance(node.data, tuple) and len(node.data) == len(arguments))
    return body.type if fits else None


def _is_numeric(node: Node) -> bool:
    return isinstance(node.type, Scalar | Vector)


_RULES: Mapping[str, Callable[[Node], Type | None]] = {
    "constant": _constant,
    "resource": _declared,
    "attribute": _declared,
    "input": _own,
    "bound": _own,
    "formal": _own,
    "call": _builtin,
    "native": _native,
    "vector": _vector,
    "splat": _splat,
    "matrix": _matrix,
    "struct": _aggregate,
    "array": _aggregate,
    "swizzle": _swizzle,
    "index": _index,
    "member": _member,
    "select": _select,
    "interpolate": _interpolate,
    "fold": _fold,
    "iterate": _iterate,
    "apply": _apply,
}
"""The type that each operation has, derived from its operands; ``None`` where they do not fit."""
