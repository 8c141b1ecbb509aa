"""Declared parameters, textures and buffers as leaves, with their descriptions for a host."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from math import hypot
from typing import TypeVar

from ....stdlib.builtins.facts import UNKNOWN, Fact
from ....support.frozen import EMPTY, changed
from ...diagnostics import rules
from ...diagnostics.fixes import fix_it
from ...diagnostics.nearest import nearest, respelt
from ...diagnostics.source import Span
from ...ir.groups import STANDARD_GROUPS
from ...ir.leaves import Attribute, Parameter, behind
from ...ir.meaning import ANGLE, Meaning
from ...ir.node import Node
from ...ir.shader import (
    AttributeInfo,
    BufferInfo,
    ConstantValue,
    ExternInfo,
    LeafInfo,
    ParameterInfo,
    TextureInfo,
)
from ...ir.stages import INSTANCES, VERTICES
from ...ir.types import (
    FLOAT,
    INT,
    Array,
    Matrix,
    Opaque,
    Scalar,
    TextureType,
    Type,
    Vector,
    scalar_kind,
)
from ...syntax import ast
from ...syntax.quoting import quoted
from ..inheritance.inherited import leaf_definitions
from ..inheritance.records import Definition, Record
from ..names.kept_of_library import KeptOfLibrary
from ..names.modules import Symbol
from ..state.context import Context
from ..state.evaluation import node_of
from ..state.scope import Failure, Scope
from ..types.meaning_rules import is_enum, weakened
from ..types.typenames import Declared
from .buffers import buffer_of, member_infos
from .contracts import as_declared, needs_unit
from .enumerations import limits_of_members
from .textures import texture_of, unknown_word
from .written_types import declared_type, named_struct

DEFAULT_GROUPS: Mapping[str, str] = {
    "material": "material",
    "light": "rig",
    "pass": "frame",
    "kernel": "draw",
    "frame": "frame",
}
"""The group of a parameter that names none, by the kind of its record."""

STEPS = (VERTICES, INSTANCES)
"""The domains that an attribute can be declared ``per``; the first is the default."""


Leaves = tuple[LeafInfo, ...]
"""A record's leaves in declaration order."""

Kind = TypeVar("Kind", bound=LeafInfo)


def of_kind(kind: type[Kind], leaves: Iterable[LeafInfo]) -> tuple[Kind, ...]:
    """The leaves of one kind among some."""
    return tuple(info for info in leaves if isinstance(info, kind))


def all_parameters(
    leaves: Sequence[LeafInfo], externs: Iterable[ExternInfo]
) -> tuple[ParameterInfo, ...]:
    """All parameters of a shader.

    They are the declared ones, those that count elements, and the members of the host's blocks.
    """
    counts = (info.count for info in of_kind(BufferInfo, leaves))
    members = (member.info for block in externs for member in block.members)
    return (*of_kind(ParameterInfo, leaves), *counts, *members)


def leaves_of(
    ctx: Context, record: Record, owner: str = "", given: Mapping[str, Definition] = EMPTY
) -> Leaves:
    """The parameters, textures, buffers and vertex inputs that instances of ``record`` read.

    One that a derived record, or a rig entry (``given``), has set by an equation is none any more,
    unless an equation builds on it. A host calls them by their names behind that of ``owner``.
    """
    symbol, key = record.symbol, (record.chain, owner)
    is_shared = symbol.module.is_standard and isinstance(symbol.declaration, ast.Record)
    if not is_shared or given:
        return _leaves(ctx, record, owner, given)
    known = _LIBRARY.find(symbol, key)
    if known is None:
        before = ctx.report.count
        known = _leaves(ctx, record, owner, given)
        if ctx.report.count == before and all(map(_is_shared, known)):
            _LIBRARY.keep(symbol, key, known)
    return known


_LIBRARY: KeptOfLibrary[Leaves] = KeptOfLibrary(256)
"""Leaves of records of the library, by the chain of records and the owner's name."""


def _is_shared(info: LeafInfo) -> bool:
    """True if a leaf is the same in every compile.

    A structure is called as is best in each program (``named_struct``).
    """
    if isinstance(info, ParameterInfo):
        return not info.members
    return not isinstance(info, BufferInfo)


def _leaves(ctx: Context, record: Record, owner: str, given: Mapping[str, Definition]) -> Leaves:
    return tuple(
        changed(info, library=_library_name(record, name), declared_by=definition.owner.name)
        if isinstance(info, ParameterInfo | TextureInfo)
        else info
        for name, definition in leaf_definitions(record, given)
        for info in _LEAVES_OF[type(definition.member)](ctx, definition, name, owner)
    )


def _library_name(record: Record, name: str) -> str:
    """The name in the library of a parameter or a texture; an empty text for others.

    A host tells it by this from others that only have the same name.
    """
    declared = (ast.Param, ast.Texture)
    owners = (each.owner for each in record.definitions[name] if isinstance(each.member, declared))
    found = next(filter(None, map(library_name, owners)), "")
    return found and f"{found}.{name}"


def library_name(symbol: Symbol) -> str:
    """The declaration of the library that a symbol is: ``std.lights.Lantern``; empty for others."""
    module = symbol.module
    return f"{module.import_path}.{symbol.name}" if module.is_standard else ""


_STANDARD: KeptOfLibrary[ParameterInfo] = KeptOfLibrary(1024)
"""Parameters of the library: by the record that declares them, by their name, and by the owner of
the leaf. Checking their ranges and defaults takes a while."""


def _of_param(ctx: Context, definition: Definition, name: str, owner: str) -> Leaves:
    if not definition.owner.module.is_standard:
        return _found(parameter_of(ctx, definition, name, owner))
    symbol, key = definition.owner, (definition.owner, name, owner)
    known = _STANDARD.find(symbol, key)
    if known is not None:
        return (known,)
    before = ctx.report.count
    info = parameter_of(ctx, definition, name, owner)
    if info is not None and _is_shared(info) and ctx.report.count == before:
        _STANDARD.keep(symbol, key, info)
    return _found(info)


def _of_texture(ctx: Context, definition: Definition, name: str, owner: str) -> Leaves:
    member = definition.member
    assert isinstance(member, ast.Texture)
    group = _group(ctx, definition, member.group)
    return _found(texture_of(ctx, definition, behind(owner, name), group, owner))


def _of_buffer(ctx: Context, definition: Definition, name: str, owner: str) -> Leaves:
    member = definition.member
    assert isinstance(member, ast.Buffer)
    group = _group(ctx, definition, member.group)
    return _found(buffer_of(ctx, definition, behind(owner, name), group, owner))


def _found(info: LeafInfo | None) -> Leaves:
    return () if info is None else (info,)


def _group(ctx: Context, definition: Definition, named: ast.Name | None) -> str:
    if named is None:
        declaration = definition.owner.declaration
        assert isinstance(declaration, ast.Record | ast.Mixin)
        return DEFAULT_GROUPS[declaration.kind]
    if named.text not in STANDARD_GROUPS:
        meant = nearest(named.text, STANDARD_GROUPS)
        if meant is not None:
            hint = respelt(named.text, named.span, meant)
            ctx.report.add(rules.UNUSUAL_GROUP, named.span, name=named.text, hint=hint)
    return named.text


def parameter_of(
    ctx: Context, definition: Definition, name: str, owner: str
) -> ParameterInfo | None:
    """The leaf that a ``param`` declares, by the name and its owner; ``None`` after reporting."""
    member = definition.member
    assert isinstance(member, ast.Param)
    module = definition.owner.module
    declared = declared_type(ctx, member.type, module)
    if declared is None:
        return None
    if isinstance(declared.type, Opaque):
        word = "map" if isinstance(declared.type, TextureType) else "buffer"
        what = "texture" if word == "map" else "storage buffer"
        other = "" if word == "map" else ", or write how many elements there are: `[4]`"
        ctx.report.add(
            rules.WRONG_TYPE, member.type.span, expected="a value", found=declared.text,
            hint=fix_it(
                f"declare a {what} with `{word} {member.name.text} : {declared.text}`{other}",
                (Span(member.span.source, member.span.start, member.name.span.start), f"{word} "),
            ),
        )  # fmt: skip
        return None
    limits = _range(ctx, member, definition, declared)
    limits = limits or limits_of_members(declared)
    fact = declared.fact if limits is None else Fact(*limits)
    default = _default(ctx, member, definition, declared, limits)
    parameter = Parameter(
        behind(owner, name), declared.type, _group(ctx, definition, member.group), owner, fact,
        tuple((short, part.fact) for short, part in declared.members), meaning=declared.meaning,
    )  # fmt: skip
    return ParameterInfo(
        parameter, declared.text, member.doc, member.name.span, limits, default,
        member_infos(declared, member.name.span),
    )  # fmt: skip


def limits_of(ctx: Context, definition: Definition) -> tuple[float, float] | None:
    """The range that a ``param`` declares, if it does."""
    member = definition.member
    assert isinstance(member, ast.Param)
    if member.range is None:
        return None
    declared = declared_type(ctx, member.type, definition.owner.module)
    return None if declared is None else _range(ctx, member, definition, declared)


def _range(
    ctx: Context, member: ast.Param, definition: Definition, declared: Declared
) -> tuple[float, float] | None:
    if member.range is None:
        return None
    type_ = declared.type.element if isinstance(declared.type, Array) else declared.type
    if (
        is_enum(declared.meaning)
        or scalar_kind(type_) in (None, "bool")
        or not isinstance(type_, Scalar | Vector)
    ):
        hint = "its members are its range: leave `in …` out" if is_enum(declared.meaning) else ""
        ctx.report.add(rules.NO_RANGE, member.range[0].span, type=declared.text, hint=hint)
        return None
    limits = []
    for expression in member.range:
        node = node_of(ctx, expression, Scope(definition.owner.module))
        if isinstance(node, Node) and not _is_number(node.type):
            ctx.report.add(rules.WRONG_TYPE, expression.span, expected="a number", found=node.type)
            return None
        if declared.meaning == ANGLE:
            node = as_declared(ctx, node, changed(declared, type=FLOAT, text="angle"), expression)
        limits.append(ctx.constants.number(node, expression.span))
    lo, hi = limits
    if lo is None or hi is None:
        return None
    if lo > hi:
        span = member.range[0].span.to(member.range[1].span)
        ctx.report.add(rules.EMPTY_RANGE, span, range=f"{lo:g}..{hi:g}")
        return None
    return lo, hi


def _is_number(type_: Type) -> bool:
    return isinstance(type_, Scalar) and type_.kind != "bool"


def _default(
    ctx: Context,
    member: ast.Param,
    definition: Definition,
    declared: Declared,
    limits: tuple[float, float] | None,
) -> ConstantValue | None:
    if member.default is None:
        return None
    scope = Scope(definition.owner.module)
    node = node_of(ctx, member.default, scope, declared)
    # A direction is brought to length one below.
    node = as_declared(ctx, node, changed(declared, fact=UNKNOWN), member.default)
    if isinstance(node, Failure):
        return None
    value = ctx.constants.value(node, member.default.span)
    if value is None:
        return None
    if needs_unit(declared):
        value = _unit(ctx, value, member.default)
    if limits is not None and not is_within(value, *limits):
        shown = range_text(member, limits)
        ctx.report.add(rules.OUT_OF_RANGE, member.default.span, value="this default", range=shown)
    return value


def range_text(member: ast.Param, limits: tuple[float, float]) -> str:
    """A parameter's range as it is written."""
    assert member.range is not None
    low, high = (quoted(bound) for bound in member.range)
    return f"{low}..{high}" if "…" not in low + high else f"{limits[0]:g}..{limits[1]:g}"


def is_within(value: ConstantValue | None, lo: float, hi: float) -> bool:
    """True if all lanes of a value are in a range."""
    if isinstance(value, tuple):
        return all(is_within(lane, lo, hi) for lane in value)
    return value is not None and lo <= value <= hi


def _unit(ctx: Context, value: ConstantValue, written: ast.Expression) -> ConstantValue | None:
    """A direction is kept at length one whatever was written."""
    assert isinstance(value, tuple)
    lanes = [float(lane) for lane in value if not isinstance(lane, tuple)]
    length = hypot(*lanes)
    if length < 1e-12:
        ctx.report.add(rules.ZERO_DIRECTION, written.span)
        return None
    return tuple(lane / length for lane in lanes)


def _of_attribute(ctx: Context, definition: Definition, name: str, _owner: str) -> Leaves:
    """A vertex input; for a matrix one for each column, as no API has more than vectors."""
    member = definition.member
    assert isinstance(member, ast.Attribute)
    declared = declared_type(ctx, member.type, definition.owner.module)
    if declared is None:
        return ()
    type_, doc, span = declared.type, member.doc, member.name.span
    if member.rate is not None and member.rate.text not in STEPS:
        unknown_word(ctx, "step", member.rate, STEPS)
    step = INSTANCES if member.rate and member.rate.text == INSTANCES else VERTICES
    if isinstance(type_, Matrix):
        column = type_.column
        return tuple(
            AttributeInfo(
                Attribute(f"{name}.{i}", column, step=step), str(column), doc, span, name, i
            )
            for i in range(type_.columns)
        )
    if not isinstance(type_, Scalar | Vector) or scalar_kind(type_) == "bool":
        ctx.report.add(rules.CANNOT_CROSS, member.type.span, type=declared.text)
        return ()
    attribute = Attribute(name, type_, step=step, meaning=weakened(declared.meaning))
    return (AttributeInfo(attribute, declared.text, doc, span),)


_LEAVES_OF: Mapping[type, Callable[[Context, Definition, str, str], Leaves]] = {
    ast.Param: _of_param,
    ast.Texture: _of_texture,
    ast.Buffer: _of_buffer,
    ast.Attribute: _of_attribute,
}
"""The function that makes the leaves of a member, by the name and the owner's, for its class.

There is one row for each kind whose contribution is a leaf.
"""


def as_array(ctx: Context, name: str, light: str, infos: tuple[ParameterInfo, ...], count: int,
             group: str) -> ParameterInfo:  # fmt: skip
    """The parameters of ``count`` lights of one type as one array of structs."""
    members = tuple((info.leaf.short_name, info) for info in infos)
    struct = named_struct(ctx, light, tuple((short, i.leaf.type) for short, i in members))
    facts = tuple((short, info.leaf.fact) for short, info in members)
    meanings = tuple((short, info.leaf.meaning) for short, info in members)
    meaning = Meaning("struct", members=meanings)
    parameter = Parameter(name, Array(struct, count), group, member_facts=facts, meaning=meaning)
    rows = tuple(
        changed(info, leaf=changed(info.leaf, name=short, owner="")) for short, info in members
    )
    first = infos[0]
    return ParameterInfo(parameter, f"{light}[{count}]", "", first.span, members=rows)


def count_parameter(name: str, bound: int, group: str, of: ParameterInfo) -> ParameterInfo:
    """The parameter for the number of lights that shine, of at most ``bound``."""
    parameter = Parameter(f"{name}.count", INT, group, name, Fact(0.0, float(bound), kind="int"))
    doc = f"The number of `{name}` that shine"
    return ParameterInfo(parameter, "int", doc, of.span, (0, bound), 0, light=of.light)
