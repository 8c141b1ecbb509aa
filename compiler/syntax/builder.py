"""Makes the nodes of the AST.

There is one method for each production of ``burnish.lark``, of the same name. Members have none:
the table of their kinds has the functions that make them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import cast

from ..diagnostics import rules
from ..diagnostics.diagnostic import Report
from ..diagnostics.fixes import write
from ..diagnostics.source import Span
from . import ast
from .ast import Expression, Name
from .tokens import Docs, Token

_EDITION = 1

Replacement = tuple[Name, Expression]
NamedArgument = tuple[Name, Expression]
Count = tuple[Expression | None, ast.LightNumber]
Range = tuple[Expression, Expression]
Path = tuple[tuple[str, ...], bool]
Maker = Callable[..., object]
"""Makes a node: of the builder, the span, and the parts that the production hands over."""

_KINDS = {production: kind for kind in ast.KINDS for production in kind.productions}
"""The kinds of members by the productions that read them."""


class Builder:
    """Builds nodes bottom-up while the machine reduces; ``docs`` are attached by position."""

    def __init__(self, docs: Docs, report: Report) -> None:
        self._docs = docs
        self._report = report

    def doc(self, span: Span) -> str:
        """The doc comment of the node at ``span``."""
        return self._docs.of(span.start, span.end)

    # --- file ---

    def file(
        self, _: Span, edition: int | None, *declarations: ast.Declaration
    ) -> tuple[int, tuple[ast.Declaration, ...]]:
        return edition or _EDITION, declarations

    def edition(self, span: Span, number: Token) -> int:
        if number.text != str(_EDITION):
            hint = write(span, f"burnish {_EDITION}")
            self._report.add(rules.UNKNOWN_EDITION, span, edition=number.text, hint=hint)
        return _EDITION

    def module(self, _: Span, *path: Token | tuple[str, ...]) -> tuple[str, ...]:
        head, *tail = path
        texts = (head.text,) if isinstance(head, Token) else head
        return (*texts, *(cast(Token, part).text for part in tail))

    def quoted(self, _: Span, text: Token) -> Token:
        return text

    def import_all(self, span: Span, source: Token | tuple[str, ...]) -> ast.Import:
        path, quoted = _path(source)
        return ast.Import(span, path, quoted, None)

    def import_some(self, span: Span, source: Token | tuple[str, ...], *names: Name) -> ast.Import:
        path, quoted = _path(source)
        return ast.Import(span, path, quoted, names)

    def space(self, span: Span, name: Name) -> ast.Space:
        return ast.Space(span, self.doc(span), name)

    def constant(
        self, span: Span, name: Name, kind: ast.TypeName | None, value: Expression
    ) -> ast.Constant:
        return ast.Constant(span, self.doc(span), name, kind, value)

    # --- materials, lights and passes ---

    def record(
        self,
        span: Span,
        abstract: Token | None,
        kind: ast.RecordKind,
        name: Name,
        bases: tuple[Name, ...],
        by: Name | None,
        blend: Name | None,
        *members: ast.Member,
    ) -> ast.Record:
        base = bases[0] if bases else None
        doc, mixins, is_abstract = self.doc(span), bases[1:], abstract is not None
        return ast.Record(span, doc, kind, name, is_abstract, base, blend, members, mixins, by)

    def bases(self, _: Span, base: Name | None, *mixins: Name) -> tuple[Name, ...]:
        return () if base is None else (base, *mixins)

    def mixin(
        self,
        span: Span,
        name: Name,
        kind: ast.RecordKind | None,
        *members: ast.Member,
    ) -> ast.Mixin:
        return ast.Mixin(span, self.doc(span), kind or "material", name, members)

    def kind(self, _: Span, word: Token) -> str:
        return word.text

    def named_blending(self, span: Span, mode: Name) -> ast.Blending:
        return ast.Blending(span, mode)

    def set_blending(
        self, span: Span, mode: Name | None, *settings: tuple[Name, Name]
    ) -> ast.Blending:
        return ast.Blending(span, mode, settings)

    def setting(self, _: Span, name: Name, value: Name) -> tuple[Name, Name]:
        return name, value

    def strips(
        self,
        span: Span,
        shape: ast.StripShape,
        count: Expression,
        vertex: Name | None,
        turns: ast.Turns | None,
        condition: Expression | None,
        like: Expression | None,
        *equations: ast.Slot,
    ) -> ast.Strips:
        return ast.Strips(span, shape, count, vertex, turns, condition, like, equations)

    def ends(self, _: Span, *numbers: Expression) -> tuple[Expression, ...]:
        return numbers

    def shape(self, _: Span, word: Token) -> str:
        return word.text

    def repeated(self, _: Span, variable: Name, over: Range, most: Expression | None) -> ast.Turns:
        return ast.Turns(variable, *over, most)

    def scattering(self, _: Span, word: Token) -> str:
        return word.text

    def likeness(self, _: Span, number: Expression) -> Expression:
        return number

    # --- functions and terms ---

    def fn(
        self,
        span: Span,
        name: Name,
        type_parameters: tuple[ast.TypeParameter, ...],
        formals: tuple[ast.Argument, ...],
        result: ast.TypeName | None,
        body: Expression,
        parts: tuple[ast.Slot, ...],
    ) -> ast.Function:
        doc = self.doc(span)
        return ast.Function(
            span, doc, "fn", name, type_parameters, formals, result, None, body, parts
        )

    def term(
        self,
        span: Span,
        name: Name,
        type_parameters: tuple[ast.TypeParameter, ...],
        formals: tuple[ast.Argument, ...],
        result: ast.TypeName | None,
        per: Name | None,
        body: Expression,
        parts: tuple[ast.Slot, ...],
    ) -> ast.Function:
        doc = self.doc(span)
        return ast.Function(
            span, doc, "term", name, type_parameters, formals, result, per, body, parts
        )

    def parts(self, _: Span, *parts: ast.Slot | None) -> tuple[ast.Slot, ...]:
        return tuple(part for part in parts if part is not None)

    def part(
        self, span: Span, name: Name, kind: ast.TypeName | None, value: Expression
    ) -> ast.Slot:
        return ast.Slot(span, self.doc(span), name, kind, value)

    def type_parameters(
        self, _: Span, *parameters: ast.TypeParameter
    ) -> tuple[ast.TypeParameter, ...]:
        return parameters

    def type_parameter(self, span: Span, name: Name, family: Name) -> ast.TypeParameter:
        return ast.TypeParameter(span, name, family)

    def formals(self, _: Span, *formals: ast.Argument) -> tuple[ast.Argument, ...]:
        return formals

    def formal(
        self, span: Span, name: Name, kind: ast.TypeName, default: Expression | None
    ) -> ast.Argument:
        return ast.Argument(span, name, kind, default)

    # --- rigs and structures ---

    def rig(self, span: Span, name: Name, *entries: ast.RigEntry) -> ast.Rig:
        return ast.Rig(span, self.doc(span), name, entries)

    def entry(
        self,
        span: Span,
        name: Name,
        light: Name,
        count: Count | None,
        overrides: tuple[ast.Slot, ...],
    ) -> ast.RigEntry:
        bound, number = count or (None, "one")
        return ast.RigEntry(span, self.doc(span), name, light, bound, number, overrides)

    def exactly(self, _: Span, count: Expression) -> Count:
        return count, "exactly"

    def at_most(self, _: Span, count: Expression) -> Count:
        return count, "at_most"

    def any_number(self, _: Span) -> Count:
        return None, "any"

    def overrides(self, _: Span, *overrides: ast.Slot) -> tuple[ast.Slot, ...]:
        return overrides

    def override(self, span: Span, name: Name, value: Expression) -> ast.Slot:
        return ast.Slot(span, self.doc(span), name, None, value)

    def structure(
        self, span: Span, name: Name, *members: ast.StructMember
    ) -> ast.StructDeclaration:
        return ast.StructDeclaration(span, self.doc(span), name, members)

    def field(self, span: Span, name: Name, kind: ast.TypeName) -> ast.StructMember:
        return ast.StructMember(span, self.doc(span), name, kind)

    def enumeration(self, span: Span, name: Name, *members: ast.Enumerator) -> ast.Enumeration:
        return ast.Enumeration(span, self.doc(span), name, members)

    def enumerator(self, span: Span, name: Name) -> ast.Enumerator:
        return ast.Enumerator(span, self.doc(span), name)

    def extern(
        self,
        span: Span,
        name: Name,
        group: Name | None,
        bind_group: ast.Number,
        binding: ast.Number,
        *members: ast.ExternMember,
    ) -> ast.ExternBlock:
        return ast.ExternBlock(span, self.doc(span), name, group, bind_group, binding, members)

    def extern_member(
        self,
        span: Span,
        name: Name,
        kind: ast.TypeName,
        offset: ast.Number,
        default: Expression | None,
    ) -> ast.ExternMember:
        return ast.ExternMember(span, self.doc(span), name, kind, offset, default)

    # --- types ---

    def type(
        self, span: Span, name: Name, arguments: tuple[Name, ...], count: Expression | None
    ) -> ast.TypeName:
        return ast.TypeName(span, name, arguments, count)

    def unsized(self, span: Span, name: Name, arguments: tuple[Name, ...]) -> ast.TypeName:
        return ast.TypeName(span, name, arguments, unsized=True)

    def type_arguments(self, _: Span, *arguments: Name) -> tuple[Name, ...]:
        return arguments

    # --- expressions ---

    def conditional(
        self, span: Span, condition: Expression, then: Expression, otherwise: Expression
    ) -> ast.Conditional:
        return ast.Conditional(span, condition, then, otherwise)

    def fold(
        self,
        span: Span,
        operator: ast.FoldWord,
        variable: Name,
        over: Range,
        most: Expression | None,
        initial: Expression | None,
        body: Expression,
    ) -> ast.Fold:
        return ast.Fold(span, operator, ast.Turns(variable, *over, most), initial, body)

    def fold_over(
        self, span: Span, operator: ast.FoldWord, variable: Name, over: Expression, body: Expression
    ) -> ast.FoldOver:
        return ast.FoldOver(span, operator, variable, over, body)

    def folding(self, _: Span, word: Token) -> str:
        return word.text

    def up_to(self, _: Span, most: Expression) -> Expression:
        return most

    def iterate(
        self,
        span: Span,
        state: Name,
        initial: Expression,
        turns: ast.Turns,
        condition: Expression | None,
        body: Expression,
    ) -> ast.Iterate:
        return ast.Iterate(span, state, initial, turns, condition, body)

    def at_most_turns(self, span: Span, most: Expression) -> ast.Turns:
        return ast.Turns(Name("", span), ast.Number(span, "0", "int"), most, None)

    def counted_turns(
        self, _: Span, variable: Name, over: Range, most: Expression | None
    ) -> ast.Turns:
        return ast.Turns(variable, *over, most)

    def range(self, _: Span, start: Expression, end: Expression) -> Range:
        return start, end

    def binary(
        self, span: Span, left: Expression, operator: Token, right: Expression
    ) -> ast.Binary:
        return ast.Binary(span, operator.text, left, right)  # type: ignore[arg-type]

    def unary(self, span: Span, operator: Token, operand: Expression) -> ast.Unary:
        return ast.Unary(span, operator.text, operand)  # type: ignore[arg-type]

    def at_rate(self, span: Span, rate: Name, operand: Expression) -> ast.AtRate:
        return ast.AtRate(span, rate, operand)

    def conversion(self, span: Span, operand: Expression, space: Name) -> ast.Conversion:
        return ast.Conversion(span, operand, space)

    def ascription(self, span: Span, operand: Expression, kind: ast.TypeName) -> ast.Ascription:
        return ast.Ascription(span, operand, kind)

    def call(self, span: Span, callee: Expression, *arguments: Expression) -> ast.Call:
        return ast.Call(span, callee, arguments)

    def named_call(
        self, span: Span, callee: Expression, *arguments: Expression | NamedArgument
    ) -> ast.Call:
        pairs = [given if isinstance(given, tuple) else (None, given) for given in arguments]
        names, values = zip(*pairs, strict=True)
        return ast.Call(span, callee, values, names)

    def argument(self, _: Span, name: Name, value: Expression) -> NamedArgument:
        return name, value

    def member(self, span: Span, operand: Expression, name: Name) -> ast.Field:
        return ast.Field(span, operand, name)

    def index(self, span: Span, operand: Expression, index: Expression) -> ast.Index:
        return ast.Index(span, operand, index)

    def with_slots(self, span: Span, operand: Expression, *slots: Replacement) -> ast.With:
        return ast.With(span, operand, slots)

    def replacement(self, _: Span, name: Name, value: Expression) -> Replacement:
        return name, value

    def light_replacement(self, _: Span, light: Name, slot: Name, value: Expression) -> Replacement:
        return Name(f"{light.text}.{slot.text}", light.span.to(slot.span)), value

    def number(self, span: Span, token: Token) -> ast.Number:
        text = token.text
        if text[-1].isalpha() and (measured := _measured(span, text)) is not None:
            return measured
        if text.endswith("u"):
            return ast.Number(span, text[:-1], "uint")
        if text.startswith(("0x", "0X")):
            return ast.Number(span, text, "int")
        return ast.Number(span, text, "int" if text.isdigit() else "float")

    def color(self, span: Span, token: Token) -> ast.Color:
        digits = token.text[1:]
        if len(digits) == 3:
            digits = "".join(digit * 2 for digit in digits)
        return ast.Color(span, tuple(bytes.fromhex(digits)))

    def array(self, span: Span, *elements: Expression) -> ast.Array:
        return ast.Array(span, elements)

    def boolean(self, span: Span, word: Token) -> ast.Boolean:
        return ast.Boolean(span, word.text == "true")

    def reference(self, span: Span, name: Token) -> ast.Reference:
        return ast.Reference(span, name.text)

    def name(self, span: Span, token: Token) -> Name:
        return Name(token.text, span)


def maker(production: str) -> Maker | None:
    """The function that makes the node of a production; None where its parts are handed on."""
    kind = _KINDS.get(production)
    if kind is None:
        method: Maker | None = getattr(Builder, production, None)
        return method
    make = kind.productions[production]
    if "doc" in kind.node.__match_args__:
        return lambda builder, span, *parts: make(span, builder.doc(span), *parts)
    return lambda _builder, span, *parts: make(span, *parts)


def _path(source: Token | tuple[str, ...]) -> Path:
    """Path of an import, and whether it was quoted."""
    if isinstance(source, Token):
        return (source.text[1:-1],), True
    return source, False


def _measured(span: Span, text: str) -> ast.Number | None:
    """A number with a unit; ``None`` if what stands behind it is none. Few texts have units."""
    from ..units import ANGLES, parted

    digits, unit = parted(text)
    if not unit:
        return None
    return ast.Number(span, digits, "angle" if unit in ANGLES else "length", unit)
