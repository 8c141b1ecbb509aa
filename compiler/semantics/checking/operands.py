"""Operands that no signature of a builtin takes, and the edit that mends them.

An edit is offered where the builtin is known to take the edited operands.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ....stdlib.builtins import BUILTINS
from ...diagnostics import rules
from ...diagnostics.fixes import FixIt, Hint, either, fix_it
from ...diagnostics.source import Span
from ...ir.node import Node
from ...ir.signatures import FAMILIES
from ...ir.types import (
    FLOAT,
    MATRICES,
    VEC3,
    Array,
    Matrix,
    RuntimeArray,
    Scalar,
    Struct,
    TextureType,
    Vector,
    scalar_kind,
    width,
    with_width,
)
from ...syntax import ast
from ...syntax.quoting import closed, counted, operand, shortened, spanned
from ...syntax.rewriting import rewritten, together
from ..declarations.enumerations import shown_type
from ..hints import advice
from ..state.context import Context
from ..state.scope import FAILURE, Failure
from ..types import overloads
from ..types.operand import Operand

_INTEGERS = frozenset(FAMILIES["I"].kinds)
_LANES = "xyzw"

Written = Sequence[ast.Expression]
Edited = tuple[Operand, FixIt | None]
"""An operand as it would be, and how that is written; ``None`` where nothing changes."""


def listed(ctx: Context, operands: Sequence[Node], names: Sequence[ast.Name | None] = ()) -> str:
    """The operands' types for a message, with the names that they are given by."""
    types = [shown_type(ctx, node) for node in operands]
    pairs = zip(types, names or [None] * len(types), strict=True)
    return ", ".join(type_ if name is None else f"{name.text} = {type_}" for type_, name in pairs)


def no_signature(
    ctx: Context, name: str, operands: Sequence[Node], span: Span, shown: str, written: Written
) -> Failure:
    """Reports operands that no signature of a builtin takes, or an error in one of them."""
    if any(map(ctx.deferred.is_wrong, operands)):
        return FAILURE
    row, places = BUILTINS[name], [each.span for each in written]
    if row.operator:
        types = [shown_type(ctx, node) for node in operands]
        ctx.report.add(
            rules.NO_OPERATOR if len(types) == 2 else rules.NO_PREFIX_OPERATOR, span,
            operator=shown, left=types[0], right=types[-1],
            hint=advice.cut_quotient(ctx, operands, places)
            or _operator_hint(ctx, name, operands, written),
            labels=advice.where_cut(ctx, operands, span),
        )  # fmt: skip
        return FAILURE
    candidates = f"candidates: {overloads.signatures(row)}"
    if not overloads.takes(name, len(operands)):
        counts = sorted({len(s.split("->")[0].split(",")) for s in row.signatures})
        ctx.report.add(
            rules.WRONG_COUNT, span, name=shown,
            expected=counted(" or ".join(map(str, counts)), "argument"), found=len(operands),
            hint=_of_another_count(name, span, written)
            or _of_pairs(name, span, written) or _of_lanes(name, operands, span, written)
            or candidates,
        )  # fmt: skip
        return FAILURE
    cut = advice.cut_quotient(ctx, operands, places)
    hint = _parts(name, operands) or cut or _edited(name, operands, written) or candidates
    ctx.report.add(
        rules.NO_OVERLOAD, span, name=shown, arguments=listed(ctx, operands), hint=hint,
        labels=advice.where_cut(ctx, operands, span) if hint is cut else (),
    )  # fmt: skip
    return FAILURE


def _of_another_count(name: str, span: Span, written: Written) -> Hint:
    """The builtin for two operands of which this one is for one, as ``atan2`` is of ``atan``."""
    other = f"{name}{len(written)}"
    if other not in BUILTINS or not overloads.takes(other, len(written)):
        return ""
    arguments = ", ".join(spanned(each.span) for each in written)
    said = f"of {len(written)} arguments it is `{other}({arguments})`"
    is_named = span.text.startswith(f"{name}(")
    place = Span(span.source, span.start, span.start + len(name))
    return fix_it(said, (place, other)) if is_named else said


def _of_lanes(name: str, operands: Sequence[Node], span: Span, written: Written) -> Hint:
    """About ``normalize(1, 2, 2)``: these numbers are the lanes of one vector."""
    types = [node.type for node in operands]
    if not all(isinstance(type_, Scalar) for type_ in types) or len(types) not in (2, 3, 4):
        return ""
    vector = Vector("float", len(types))
    takes_numbers = overloads.resolve(name, (Operand(FLOAT),))
    if takes_numbers or not overloads.resolve(name, (Operand(vector),)):
        return ""
    lanes = ", ".join(each.span.text for each in written)
    first, last = written[0].span, written[-1].span
    said = f"a vector is one argument: `{shortened(f'{name}({vector}({lanes}))')}`"
    place = Span(span.source, first.start, last.end)
    return fix_it(said, (place, f"{vector}({lanes})"))


_OF_PAIRS = ("max", "min")
"""Builtins of two operands that other languages have for any number of them."""


def _of_pairs(name: str, span: Span, written: Written) -> Hint:
    """About ``max(a, b, c)``: two at a time."""
    if name not in _OF_PAIRS or len(written) < 3:
        return ""
    call = written[0].span.text
    for argument in written[1:]:
        call = f"{name}({call}, {argument.span.text})"
    return fix_it(f"two at a time: `{shortened(call)}`", (span, call))


_OF_SQUARES = {"determinant": "a determinant", "inverse": "an inverse"}
"""Builtins of square matrices, and what they give."""


def _parts(name: str, operands: Sequence[Node]) -> str:
    """Builtins are of numbers: of textures, structures and arrays they take the parts."""
    for node in operands:
        if isinstance(node.type, Matrix) and not node.type.is_square and name in _OF_SQUARES:
            return f"only square matrices have {_OF_SQUARES[name]}: mat2, mat3 and mat4"
        if isinstance(node.type, Struct):
            return f"name the members that count: `a.{node.type.members[0][0]}`"
        if isinstance(node.type, Array):
            return "name the elements that count: `a[0]`, or `sum i in 0..n : a[i]`"
        if isinstance(node.type, TextureType):
            return advice.READ
        if isinstance(node.type, RuntimeArray):
            return advice.ELEMENTS
    return ""


# --- edits ---------------------------------------------------------------------------------------


def _edited(name: str, operands: Sequence[Node], written: Written) -> Hint:
    """The smallest edits after which a builtin takes the operands."""
    if len(written) != len(operands):
        return ""
    for edit in (_as_floats, _of_one_length):
        edits = edit(operands, written)
        parts = [part for _, part in edits if part is not None]
        if parts and overloads.resolve(name, tuple(o for o, _ in edits)):
            return together("write {}", parts)
    return ""


def _as_floats(operands: Sequence[Node], written: Written) -> list[Edited]:
    """Every integer as a float, but for literals, which adapt by themselves."""
    edits: list[Edited] = []
    for node, expression in zip(operands, written, strict=True):
        known = overloads.operand(node)
        if known.constant or scalar_kind(node.type) not in _INTEGERS:
            edits.append((known, None))
            continue
        type_ = with_width("float", width(node.type))
        edits.append((Operand(type_), rewritten(expression.span, f"{type_}({{text}})", "`{}`")))
    return edits


def _of_one_length(operands: Sequence[Node], written: Written) -> list[Edited]:
    """Every vector with as many lanes as the shortest."""
    sizes = [node.type.size for node in operands if isinstance(node.type, Vector)]
    edits: list[Edited] = []
    for node, expression in zip(operands, written, strict=True):
        known = overloads.operand(node)
        if not isinstance(node.type, Vector) or node.type.size == min(sizes):
            edits.append((known, None))
            continue
        type_ = with_width(node.type.kind, min(sizes))
        lanes = rewritten(expression.span, f"{{operand}}.{_LANES[: min(sizes)]}", "`{}`")
        edits.append((Operand(type_), lanes))
    return edits


# --- operators -----------------------------------------------------------------------------------


def _operator_hint(ctx: Context, name: str, operands: Sequence[Node], written: Written) -> Hint:
    """A hint how to mend ``x * i`` between a float and an integer, and the like."""
    of_bits = all(signature.startswith("I") for signature in BUILTINS[name].signatures)
    ways: tuple[Callable[[], Hint], ...] = (
        lambda: _parts(name, operands),
        lambda: _bits(name, operands) if of_bits else "",
        lambda: _edited(name, operands, written),
        lambda: _integers(operands, written),
        lambda: _of_matrices(ctx, name, operands, written),
        lambda: advice.joined_types(name, operands[0].type, operands[-1].type),
    )
    return next((hint for way in ways if (hint := way())), "")


def _bits(name: str, operands: Sequence[Node]) -> str:
    """A hint how to mend an operator that takes integers only."""
    kinds = {scalar_kind(node.type) for node in operands}
    if "float" in kinds:
        power = "a power is written `pow(x, y)`; " if name == "bit_xor" else ""
        return f"{power}bits are those of integers: convert with `int(…)`, or see `bits_of`"
    if "bool" in kinds:
        return "bools are combined by `and` and `or`, and negated by `not`"
    return ""


def _integers(operands: Sequence[Node], written: Written) -> Hint:
    """A hint how to mend an operator between an ``int`` and a ``uint``."""
    if {scalar_kind(node.type) for node in operands} != _INTEGERS:
        return ""
    types = [node.type for node in operands]
    if len(written) != 2 or not all(isinstance(type_, Scalar) for type_ in types):
        return "convert one with `int(…)` or `uint(…)`, which keep the bits"
    left = rewritten(written[0].span, f"{types[1]}({{text}})", "`{}`")
    right = rewritten(written[1].span, f"{types[0]}({{text}})", "`{}`")
    said = f"write {left.text} or {right.text}, which keeps the bits"
    return FixIt(said, (*left.fixes, *right.fixes))


def _of_matrices(ctx: Context, name: str, operands: Sequence[Node], written: Written) -> Hint:
    """A hint how to mend an operator between matrices, or between a matrix and something else."""
    if len(operands) != 2 or not isinstance(operands[0].type, Matrix):
        return ""
    by, what = operands[0].type, operands[1].type
    if name == "div" and isinstance(what, Scalar):
        return _by_reciprocal(written)
    meaning = ctx.meanings.of(operands[0])
    if what == VEC3 and meaning is not None and meaning.kind == "transform":
        space = meaning.spaces[0]
        return f"say what it moves: `(… as point<{space}>)` or `(… as vector<{space}>)`"
    if name in ("add", "sub") and isinstance(what, Matrix):
        return "matrices of one type are added and subtracted"
    if name != "mul":
        return ""
    if isinstance(what, Vector) and what.size < by.columns and by.rows in (by.columns, what.size):
        return _moved(by, what, written)
    return _fitting(by)


def _by_reciprocal(written: Written) -> Hint:
    """About ``matrix / number``."""
    matrix, number = (operand(each.span) for each in written) if written else ("m", "v")
    said = f"a matrix is multiplied: `{matrix} * (1.0 / {number})`"
    whole = [written[0].span.to(each.span) for each in written[1:]]
    exact = " * (1.0 / ".join(closed(each.span.text) for each in written) + ")"
    return fix_it(said, (whole[0], exact)) if whole else said


def _moved(by: Matrix, what: Vector, written: Written) -> Hint:
    """About a matrix that moves, times a vector that lacks the last lane."""
    matrix, vector = (operand(each.span) for each in written) if written else ("m", "v")
    longer = ", 0" * (by.columns - what.size - 1) + ", 1"
    place = f"{matrix} * vec{by.columns}({vector}{longer})"
    if by.rows > what.size:
        place = f"({place}).{_LANES[: what.size]}"
    along = f"mat{what.size}({matrix}) * {vector}"
    said = f"a place is moved by `{place}`, a direction turned by `{along}`"
    is_short = "…" not in place
    return (
        either(said, written[0].span.to(written[1].span), place, along)
        if written and is_short
        else said
    )


def _fitting(matrix: Matrix) -> str:
    """The types by which a matrix can be multiplied: they have a row for each of its columns."""
    *most, last = [str(other) for other in MATRICES if other.rows == matrix.columns]
    fitting = f"a vec{matrix.columns}, or a {', '.join(most)} or {last}"
    return f"to the right of a {matrix} stands {fitting}"
