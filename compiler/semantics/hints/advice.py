"""The way out of a mistake about types and names, as messages tell it."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from types import MappingProxyType

from ....stdlib.builtins import BUILTINS
from ...diagnostics.diagnostic import Label
from ...diagnostics.fixes import Hint, either, fix_it, write, write_color
from ...diagnostics.nearest import is_searched_out, respelling
from ...diagnostics.source import Span
from ...ir.node import Node, bare
from ...ir.types import (
    Array,
    Matrix,
    RuntimeArray,
    Scalar,
    TextureType,
    Type,
    Vector,
    scalar_kind,
    width,
)
from ...syntax import ast
from ...syntax.quoting import closed, counted, shortened, spanned
from ...syntax.rewriting import rewritten
from ..names.modules import Symbol
from ..state.context import Context
from ..state.scope import RigEntry, Scope
from ..types.typenames import NAMED

_FEW = 8
"""The number of names up to which all are listed."""

ELEMENTS = "elements of a buffer are read by their number: `name[i]`"
OF_A_STEP = "what a step leaves is read by other steps, as `step.target`; a number reads none"
READ = "a texture is read: `name(coordinate)`"
_LANES = "xyzw"
_COLORS = "rgba"


def fitting_type(found: Type, wanted: Type, declared: str, span: Span) -> Hint:
    """A hint how to make the value at ``span``, whose type is not the wanted one, fit."""
    text = spanned(span)
    match found, wanted:
        case TextureType(), _:
            return "" if isinstance(wanted, TextureType) else READ
        case RuntimeArray(), _:
            return ELEMENTS
        case _, TextureType():
            return "what is read from a texture needs a slot with a name of its own"
        case Vector(kind="bool"), Scalar(kind="bool"):
            one = f"`all({text})` or `any({text})` makes one bool"
            said = f"{one}; `choose(c, x, y)` chooses in each lane"
            return either(said, span, f"all({span.text})", f"any({span.text})")
        case _, Scalar(kind="bool"):
            return "a comparison makes a bool, as in `x > 0`"
        case Scalar(), Vector():
            return rewritten(span, f"{wanted}({{text}})", "write `{}` for equal lanes")
        case Scalar(kind="float"), Scalar(kind="int" | "uint") if _is_literal(text):
            whole = f"{float(text):.0f}"
            is_whole = float(text) == float(whole)
            return write(span, whole) if is_whole else "it has to be a whole number"
        case Scalar(), Scalar():
            return rewritten(span, f"{wanted}({{text}})")
        case Array(), Vector():
            lanes = ", ".join(_LANES[: wanted.size])
            said = f"brackets make an array; a vector is `{wanted}({lanes})`"
            elements = span.text.removeprefix("[").removesuffix("]")
            is_literal = span.text == f"[{elements}]" and found.count == wanted.size
            return fix_it(said, (span, f"{wanted}({elements})")) if is_literal else said
        case Array(), Array() if found.element == wanted.element:
            return f"{counted(found.count, 'element')} here: write them all, or `{found}`"
        case Vector(), Scalar() | Vector():
            return _of_lanes(found, wanted, declared, span)
    return ""


def _is_literal(text: str) -> bool:
    """True if a text is one number in decimals."""
    return text.replace(".", "", 1).isdecimal()


_WHOLE_QUOTIENT = r"([0-9]+)\s*/\s*[0-9]+"


def cut_quotient(ctx: Context, operands: Iterable[Node], places: Sequence[Span] = ()) -> Hint:
    """About a quotient of two whole literals, ``1 / 3``, where a float is wanted.

    ``places`` are those of the operands, if they are known; a name is read there, or the quotient.
    """
    found = _cut_quotient(operands)
    if found is None:
        return ""
    number, node, x, y = found
    said = f"`{x} / {y}` of whole numbers is {x // y}: write `{x}.0 / {y}`"
    for span in (*places[number : number + 1], ctx.places.first(node)):
        written = None if span is None else re.fullmatch(_WHOLE_QUOTIENT, span.text)
        if span is not None and written is not None:
            place = span.start + written.end(1)
            return fix_it(said, (Span(span.source, place, place), ".0"))
    return said


def where_cut(ctx: Context, operands: Iterable[Node], around: Span) -> list[Label]:
    """A label at the quotient that ``cut_quotient`` is about, if it stands elsewhere."""
    found = _cut_quotient(operands)
    place = None if found is None else ctx.places.first(found[1])
    if place is None or (
        place.source is around.source and around.start <= place.start < around.end
    ):
        return []
    return [Label(place, "this is a whole number")]


def _cut_quotient(operands: Iterable[Node]) -> tuple[int, Node, int, int] | None:
    """The number of the operand that is such a quotient, the operand, and its two numbers."""
    for number, node in enumerate(map(bare, operands)):
        if node.op != "call" or node.data != "div" or scalar_kind(node.type) != "int":
            continue
        x, y = (bare(part).data for part in node.operands)
        if isinstance(x, int) and isinstance(y, int) and y:
            return number, node, x, y
    return None


def _of_lanes(found: Vector, wanted: Scalar | Vector, declared: str, span: Span) -> Hint:
    if scalar_kind(wanted) != found.kind:
        is_as_wide = width(wanted) == found.size
        return rewritten(span, f"{wanted}({{text}})") if is_as_wide else ""
    if isinstance(wanted, Scalar):
        return rewritten(span, "{operand}.x", "read one lane, as in `{}`")
    if wanted.size < found.size:
        letters = _COLORS if declared.startswith("rgb") else _LANES
        lanes = f"read {wanted.size} lanes: `{{}}`"
        return rewritten(span, f"{{operand}}.{letters[: wanted.size]}", lanes)
    filled = "".join((", 0", ", 0", ", 0", ", 1")[found.size : wanted.size])
    return rewritten(span, f"{wanted}({{text}}{filled})", "say what the other lanes are: `{}`")


def joined_types(operator: str, left: Type, right: Type) -> str:
    """A hint how to mend an operator between bools and numbers, or a vector before a matrix."""
    kinds = [scalar_kind(type_) for type_ in (left, right) if isinstance(type_, Scalar | Vector)]
    if isinstance(left, TextureType) or isinstance(right, TextureType):
        return READ
    if operator in ("and", "or"):
        return "`and` and `or` take bools: compare the number first, as in `x > 0`"
    if len(kinds) == 2 and "bool" in kinds and kinds != ["bool", "bool"]:
        return "`float(…)` makes 0 or 1 of a bool"
    if isinstance(left, Vector) and isinstance(right, Matrix):
        by = "m" if left.size == right.columns else "transpose(m)"
        fits = left.size in (right.columns, right.rows)
        return f"vectors are columns: the matrix stands first, `{by if fits else 'm'} * v`"
    return ""


def _is_called(name: str) -> bool:
    """True if a name is that of a builtin function."""
    row = BUILTINS.get(name)
    return row is not None and not row.operator and row.method is None


def is_read(name: str) -> bool:
    """True if textures are read by a method of this name."""
    return any(row.method == name for row in BUILTINS.values())


def missing_member(type_: Type, name: str, whole: Span) -> Hint:
    """The hint for ``v.name``, which does not exist; it stands at ``whole``."""
    if isinstance(type_, TextureType):
        return f"reads are called: `{name}(…)`" if is_read(name) else READ
    if isinstance(type_, RuntimeArray):
        return "elements are read by their number, `b[i]`, and `b.count` is how many there are"
    if isinstance(type_, Array):
        return "elements are read by their number, `a[i]`; the length is that of the declared type"
    if _is_called(name):
        value = whole.text.rpartition(".")[0].rstrip()
        call = re.compile(_CALL).match(whole.source.text, whole.end)
        given = f", {call[1]}" if call is not None and call[1].strip() else ""
        said = f"`{name}` is a function: write `{shortened(f'{name}({value}{given})')}`"
        return fix_it(said, _as_function(name, value, whole))
    if hint := _chained(name, whole):
        return hint
    if isinstance(type_, Matrix):
        return "columns are read by their number, `m[i]`, and rows of them behind that, `m[i][j]`"
    if isinstance(type_, Scalar):
        return f"{type_} is one number" + (", called `x` if need be" if set(name) != {"x"} else "")
    lanes = width(type_) if isinstance(type_, Vector) else 0
    names = f"its lanes are `{_LANES[:lanes]}`, or `{_COLORS[:lanes]}`"
    return f"{names}: up to four of them, and not mixed" if lanes else ""


_CALL = r"\s*\(([^()\n]*(?:\([^()\n]*\)[^()\n]*)*)\)"
"""A call with arguments that are calls at most."""


def _chained(name: str, whole: Span) -> Hint:
    """About ``v.mul(2)``, whose callee stands at ``whole``: it is ``v * 2`` here."""
    from ....stdlib.builtins.foreign_words import CHAINED

    call = re.compile(_CALL).match(whole.source.text, whole.end)
    if name not in CHAINED or call is None:
        return ""
    value, given = whole.text.rpartition(".")[0].rstrip(), call[1].strip()
    if ("{1}" in CHAINED[name]) != bool(given):
        return ""
    is_call = CHAINED[name].endswith(")")
    parts = (value, given) if is_call else (_operand(value), _operand(given))
    written = CHAINED[name].format(*parts)
    said = f"operators stand between their operands: `{shortened(written)}`"
    if is_call or name.startswith("to"):
        said = f"it is `{shortened(written)}` here"
    exact = written if is_call or written == parts[0] else f"({written})"
    return fix_it(said, (Span(whole.source, whole.start, call.end()), exact))


def _operand(text: str) -> str:
    """A text as something can be written beside it; parentheses around all of it are enough."""
    is_whole = text.startswith("(") and text.find(")") == len(text) - 1
    return text if is_whole else closed(text)


_ARGUMENTS = r"\s*\(\s*(\)?)"


def _as_function(name: str, value: str, whole: Span) -> tuple[Span, str]:
    """The edit from ``v.name``, ``v.name()`` or ``v.name(a)`` to ``name(v)`` or ``name(v, a)``."""
    behind = re.compile(_ARGUMENTS).match(whole.source.text, whole.end)
    if behind is None:
        return whole, f"{name}({value})"
    span = Span(whole.source, whole.start, behind.end())
    return span, f"{name}({value}" + (")" if behind[1] else ", ")


def nearest_or_all(name: str, span: Span, known: Iterable[str]) -> Hint:
    """The nearest of the known names to the one at ``span``, or all, where they are few."""
    if is_searched_out(span.source):
        return ""
    names = list(dict.fromkeys(known))
    hint = respelling(name, span, names)
    if hint or not 0 < len(names) <= _FEW:
        return hint
    return f"there is {', '.join(f'`{each}`' for each in names)}"


def of_a_record(name: str, scope: Scope) -> str:
    """About a slot that is named outside of all records: in a function, a constant or a default."""
    if name == "inherited":
        return "only the equations of a material, light, pass or rig build on what a base says"
    if scope.surface is not None or scope.instance is not None:
        term = name == "material" and scope.instance is None
        return "a term reads the slots of the surface by their own names" if term else ""
    if not any(name in slots for slots in _slots(scope)):
        return ""
    return (
        f"`{name}` belongs to a record: functions see their arguments and constants, terms also "
        "the surface, and constants and defaults of parameters see constants only"
    )


def _slots(scope: Scope) -> Iterable[Collection[str]]:
    """The names of the slots of each record that is visible."""
    for visible in scope.module.visible():
        for symbol in scope.module.known(visible):
            if isinstance(symbol.declaration, ast.Record | ast.Mixin):
                members = symbol.declaration.members
                yield {member.name.text for member in members if ast.is_named(member)}


def of_a_light(name: str, rig: Iterable[RigEntry]) -> str:
    """About a light of the rig, or a slot of such a light, that is read like a value."""
    entries = tuple(rig)
    if any(entry.short_name == name for entry in entries):
        return "lights are read in a `term … per light`, which is summed over them: `light.diffuse`"
    if any(name in entry.record.definitions for entry in entries):
        return f"each light has one: a `term … per light` reads it as `light.{name}`"
    return ""


def unshaded(symbol: Symbol) -> str:
    """About a record that is named like a value; empty for anything else."""
    declaration = symbol.declaration
    if not isinstance(declaration, ast.Record):
        return ""
    if declaration.kind == "pass":
        return f"a pass is drawn by a step of a frame, which says what: `{symbol.name}(models)`"
    if declaration.kind == "kernel":
        return f"a kernel is run by a step of a frame: `{symbol.name}()`"
    shared = f"a function, or a base, `: {symbol.name}`"
    return f"a {declaration.kind} is no value: what several share is {shared}"


_DECLARED_AS: Mapping[str, str] = MappingProxyType(
    {
        "name": "nothing declares it: `{0} = …` does, or `param {0} : type` if the host sets it",
        "function": "nothing declares it: a function is `fn {0}(…) = …`, "
        "a texture `map {0} : texture2d`",
        "slot": "slots that are set here are declared outside of these braces: `{0} : type`",
    }
)


_DIGITS = re.compile(r"(?=.*[0-9])(?:[0-9a-fA-F]{6}|[0-9a-fA-F]{8})")
"""The digits of a colour that begin with a letter, so that they are read as a name."""


def undeclared(kind: str, name: str, span: Span) -> Hint:
    """A hint how to declare a name that nothing declares, or what it is if it is no name."""
    if kind == "name" and _DIGITS.fullmatch(name):
        return write_color(span, name)
    return _DECLARED_AS.get(kind, "").format(name)


def uncalled(name: str) -> str:
    """The hint for a function or type without arguments; empty if it is neither."""
    if name in NAMED:
        return f"`{name}` is a type: `{name}(…)` makes a value of it"
    if _is_called(name):
        return f"`{name}` is a function: `{name}(…)`"
    return ""
