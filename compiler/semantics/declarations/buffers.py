"""Declared storage buffers, which a host binds with any number of elements."""

from __future__ import annotations

from ....support.frozen import changed
from ...diagnostics import rules
from ...diagnostics.fixes import fix_it
from ...diagnostics.source import Span
from ...ir.leaves import Buffer, Parameter
from ...ir.node import Node, bare
from ...ir.shader import BufferInfo, ParameterInfo, count_info
from ...ir.types import Array, RuntimeArray
from ...syntax import ast
from ..inheritance.records import Definition
from ..state.context import Context
from ..types.typenames import Declared
from .enumerations import limits_of_members
from .written_types import declared_type


def buffer_of(
    ctx: Context, definition: Definition, name: str, group: str, owner: str
) -> BufferInfo | None:
    """The buffer that a ``buffer`` declares; ``None`` after reporting why it is none."""
    member = definition.member
    assert isinstance(member, ast.Buffer)
    declared = declared_type(ctx, member.type, definition.owner.module)
    if declared is None:
        return None
    if not isinstance(declared.type, RuntimeArray):
        _report_type(ctx, member, declared)
        return None
    facts = tuple((short, part.fact) for short, part in declared.members)
    buffer = Buffer(name, declared.type, group, owner, declared.fact, facts, declared.meaning)
    span = member.name.span
    one = changed(declared, type=declared.type.element, text=declared.text.removesuffix("[]"))
    element, count = element_info(one, span), count_info(buffer, span)
    return BufferInfo(buffer, declared.text, member.doc, span, element, count)


def light_buffer(name: str, array: ParameterInfo, light: str, span: Span, doc: str) -> BufferInfo:
    """Any number of lights of one type; ``array`` has one of them as its element."""
    one = array.leaf
    assert isinstance(one.type, Array)
    buffer = Buffer(
        name, RuntimeArray(one.type.element), one.group, member_facts=one.member_facts,
        meaning=one.meaning,
    )  # fmt: skip
    element = Parameter(
        "", one.type.element, fact=one.fact, member_facts=one.member_facts, meaning=one.meaning
    )
    count = count_info(buffer, span, f"The number of `{name}` that shine")
    described = ParameterInfo(element, light, "", span, members=array.members)
    return BufferInfo(buffer, f"{light}[]", doc, span, described, count)


def _report_type(ctx: Context, member: ast.Buffer, declared: Declared) -> None:
    """A buffer's length is not part of its type."""
    span, text = member.type.span, declared.text
    if isinstance(declared.type, Array):
        text = text.rpartition("[")[0]
        hint = "a buffer that is read has as many elements as the host binds: write `{}`"
    else:
        hint = "a buffer has any number of elements: write `{}`"
    name = member.type.name.span
    end = member.type.arguments[-1].span.end + 1 if member.type.arguments else name.end
    written = Span(span.source, span.start, end).text
    ctx.report.add(
        rules.WRONG_TYPE, span, expected="a type like `T[]`", found=declared.text,
        hint=fix_it(hint.format(f"{text}[]"), (span, f"{written}[]")),
    )  # fmt: skip


def element_info(declared: Declared, span: Span) -> ParameterInfo:
    """The description of an element of a declared type, in the form of a parameter."""
    one = Parameter("", declared.type, fact=declared.fact, meaning=declared.meaning)
    members = member_infos(declared, span)
    return ParameterInfo(one, declared.text, "", span, members=members)


def member_infos(declared: Declared, span: Span) -> tuple[ParameterInfo, ...]:
    """The members of a structure, as they were written."""
    return tuple(
        ParameterInfo(
            Parameter(name, part.type, fact=part.fact, meaning=part.meaning),
            part.text, "", span, limits_of_members(part), members=member_infos(part, span),
        )
        for name, part in declared.members
    )  # fmt: skip


def leaf_of(node: Node) -> Buffer | None:
    """The buffer that a value of the type ``T[]`` is; ``None`` for an argument that may be any."""
    leaf = bare(node).data
    return leaf if isinstance(leaf, Buffer) else None
