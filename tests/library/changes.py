"""The small changes of an expression of the library that make a mutant of it.

Each is an edit of a file's text, as somebody could make it by mistake: an operator, a comparison, a
number, a function, a name, an argument or a lane is another one; a term, a factor, a function, a
side of a choice or a whole equation is left out; a loop makes one turn more or less.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source, Span
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse

from ..mutants.edit import Edit

AROUND = 20
"""The number of characters that are told before and behind a change."""


@dataclass(frozen=True, slots=True)
class Change(Edit):
    """One edit of a file of the library."""

    file: str
    """The file's import path without `std`: ``noise``, ``mtlx.noise``."""
    declaration: str
    """The full name of the declaration that it changes."""
    told: str = ""
    """The declaration, and what is replaced by what, with what is around it: no other change of the
    library is told alike, and one elsewhere in the file leaves these words as they are."""


_OPERATORS = {
    "+": ("-",), "-": ("+",), "*": ("/",), "/": ("*",), "mod": ("+", "/"), "&": ("|",), "|": ("&",),
    "<<": (">>",), ">>": ("<<",), "==": ("!=",), "!=": ("==",), "<": (">", "<="), "<=": (">", "<"),
    ">": ("<", ">="), ">=": ("<", ">"), "and": ("or",), "or": ("and",),
}  # fmt: skip
_FUNCTIONS = {
    "min": ("max",), "max": ("min",), "sin": ("cos",), "cos": ("sin",), "tan": ("sin",),
    "saturate": ("abs",), "abs": ("-",), "length": ("-length",), "dot": ("-dot", "abs(dot"),
    "normalize": ("2 * normalize",), "sqrt": ("2 * sqrt",), "reflect": ("-reflect",),
    "transpose": ("inverse",), "inverse": ("transpose",), "distance": ("-distance",),
    "determinant": ("-determinant",), "ddx": ("ddy",), "ddy": ("ddx",), "mix": ("smoothstep",),
    "smoothstep": ("mix",), "pow": ("exp2",), "group_sum": ("group_max",),
    "group_min": ("group_max",), "group_max": ("group_min",), "clamp": ("mix",),
}  # fmt: skip
"""What is written instead of a function's name; a parenthesis that it opens is closed behind."""
_COMMUTATIVE = {"dot", "min", "max", "distance"}
"""Functions of two arguments whose order does not count."""
_MAKERS = re.compile(r"(?:float|int|uint|rgba?|[iu]?vec\d|mat\d)$")
"""Names of types; what they are made of is no value of the same type."""
_FOLDS = {"sum": "max", "min": "max", "max": "min", "any": "all", "all": "any"}
_LANES = {"x": "y", "y": "x", "z": "x", "w": "z", "r": "g", "g": "r", "b": "g", "a": "r"}
_NOT_CHANGED = ast.TypeName | ast.Name
"""Records of the syntax that are no expressions."""

Place = tuple[int, int, str]
"""From where to where, and what is there then."""


def changes(name: str, text: str) -> list[Change]:
    """All changes of a file of the library, in the order of its text."""
    file = parse(Source(name, text), Report())
    found: dict[Place, str] = {}
    for declaration in file.declarations:
        if isinstance(declaration, ast.Import):
            continue
        full = f"std.{name}.{declaration.name.text}"
        names = _other_names(declaration)
        for node in _nodes(declaration):
            for edit in (*_exchanges(node, text), *_omissions(node, text), *_misnamed(node, names)):
                if text[edit[0] : edit[1]] != edit[2]:
                    found[edit] = full
    counts: Counter[str] = Counter()
    made = []
    for edit, full in sorted(found.items()):
        told = f"{full}: {_told(edit, text)}"
        counts[told] += 1
        again = f" ({counts[told]})" if counts[told] > 1 else ""
        made.append(Change(*edit, name, full, told + again))
    return made


def _told(edit: Place, text: str) -> str:
    """The words that are replaced and those that replace them, with some that are around."""
    start, end, replacement = edit
    nearby = slice(max(0, start - 20 * AROUND), start), slice(end, end + 20 * AROUND)
    before, after = (" ".join(text[part].split()) for part in nearby)
    inner = " -> ".join(_short(words) for words in (text[start:end], replacement))
    return f"{before[-AROUND:].strip()} [{inner}] {after[:AROUND].strip()}"


def _short(words: str) -> str:
    """Words on one line, the middle of which is left out if there are many."""
    line = " ".join(words.split())
    return line if len(line) < 3 * AROUND else f"{line[:AROUND]}…{line[-AROUND:]}"


def _nodes(root: object) -> Iterator[object]:
    """All records of a syntax tree below one."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if isinstance(node, tuple | list):
            waiting += node
        elif type(node).__module__.startswith(ast.__name__) and not isinstance(node, _NOT_CHANGED):
            yield node
            fields: tuple[str, ...] = vars(type(node))["__match_args__"]
            waiting += [getattr(node, field) for field in fields]


# --- something else is written -------------------------------------------------------------------


def _exchanges(node: object, text: str) -> Iterator[Place]:
    """The edits of one node that write something else."""
    match node:
        case ast.Binary(operator=operator) if operator in _OPERATORS:
            at = _operator_of(node, text)
            for other in _OPERATORS[operator]:
                yield at, at + len(operator), other
        case ast.Number(span=span, text=digits, kind=kind):
            for number in _other_numbers(digits, kind):
                yield span.start, span.start + len(digits), number
        case ast.Boolean(span=span, value=value):
            yield span.start, span.end, "false" if value else "true"
        case ast.Conditional(then=then, otherwise=otherwise):
            yield from _exchanged(text, then.span, otherwise.span)
        case ast.Call():
            yield from _other_calls(node, text)
        case ast.Field(name=ast.Name(text=lanes, span=span)) if set(lanes) <= _LANES.keys():
            for place, lane in enumerate(lanes, span.start):
                yield place, place + 1, _LANES[lane]
            yield span.start, span.end, lanes[::-1]
        case ast.Fold(span=span, operator=word) if word in _FOLDS:
            yield span.start, span.start + len(word), _FOLDS[word]
        case ast.Turns(start=start, end=end):
            for bound in (start.span.end, end.span.end):
                yield from ((bound, bound, other) for other in (" + 1", " - 1"))


def _operator_of(node: ast.Binary, text: str) -> int:
    """The place of an operator between its operands, which may be in parentheses."""
    end = node.left.span.end
    return end + text[end : node.right.span.start].index(node.operator)


def _other_numbers(digits: str, kind: str) -> Iterator[str]:
    """Other numbers of the same kind: 1 more, and 1 less, or a quarter."""
    if digits.startswith("0x"):
        yield f"{int(digits, 16) + 1}"
    elif kind in ("int", "uint") or digits.isdigit():
        yield f"{int(digits) + 1}"
        if int(digits):
            yield f"{int(digits) - 1}"
    else:
        yield repr(float(digits) * 1.25 + 0.0625 * (float(digits) == 0))
        yield repr(float(digits) * 0.75)


def _other_calls(node: ast.Call, text: str) -> Iterator[Place]:
    """Another function is called, or two neighbouring arguments are exchanged."""
    name = node.callee.name if isinstance(node.callee, ast.Reference) else ""
    start, end = node.callee.span.start, node.callee.span.end
    for function in _FUNCTIONS.get(name, ()):
        if opened := function.count("("):
            rest = text[end : node.span.end]
            yield start, node.span.end, function + rest + opened * ")"
        else:
            yield start, end, function
    if name not in _COMMUTATIVE:
        for one, other in pairwise(node.arguments):
            yield from _exchanged(text, one.span, other.span)


def _exchanged(text: str, one: Span, other: Span) -> Iterator[Place]:
    first, last = text[one.start : one.end], text[other.start : other.end]
    yield one.start, other.end, last + text[one.end : other.start] + first


def _other_names(declaration: ast.Declaration) -> dict[str, str]:
    """For names in a declaration another one, of the same type as far as one is written."""
    alike = defaultdict[object, list[str]](list)
    named: list[ast.Argument | ast.Param | ast.Slot] = []
    match declaration:
        case ast.Function(arguments=arguments, parts=parts):
            named = [*arguments, *parts]
        case ast.Record(members=members) | ast.Mixin(members=members):
            named = [each for each in members if isinstance(each, ast.Param | ast.Slot)]
    for each in named:
        span = None if each.type is None else each.type.span
        alike[span and span.source.text[span.start : span.end]].append(each.name.text)
    pairs = (zip(names, names[1:] + names[:1], strict=True) for names in alike.values())
    return dict(pair for some in pairs for pair in some)


def _misnamed(node: object, names: dict[str, str]) -> Iterator[Place]:
    """The edit of a reference that names something else."""
    if isinstance(node, ast.Reference) and node.name in names:
        yield node.span.start, node.span.end, names[node.name]


# --- something is left out -----------------------------------------------------------------------


def _omissions(node: object, text: str) -> Iterator[Place]:
    """The edits of one node that leave something out."""
    match node:
        case ast.Binary(operator=operator, span=span):
            at = _operator_of(node, text)
            yield span.start, span.end, text[span.start : at].strip()
            yield span.start, span.end, text[at + len(operator) : span.end].strip()
        case ast.Unary(span=span, operator=operator):
            yield span.start, span.start + len(operator), ""
        case ast.Conditional(span=span, then=then, otherwise=otherwise):
            for side in (then.span, otherwise.span):
                yield span.start, span.end, f"({text[side.start : side.end]})"
        case ast.Call(callee=ast.Reference(name=name), span=span) if not _MAKERS.match(name):
            for argument in node.arguments:
                kept = text[argument.span.start : argument.span.end]
                yield span.start, span.end, f"({kept})"
        case ast.Conversion(span=span, operand=operand):
            yield operand.span.end, span.end, ""
        case ast.Fold(initial=initial, turns=turns) if initial is not None:
            before = turns.most or turns.end
            yield before.span.end, initial.span.end, ""
        case ast.Slot(span=span, type=None, value=value) if value is not None:
            yield span.start, span.end, ""
        case ast.Discard(span=span) | ast.Depth(span=span) | ast.WorkGroup(span=span):
            yield span.start, span.end, ""
