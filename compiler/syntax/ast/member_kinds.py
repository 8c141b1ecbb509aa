"""The table of the kinds of members: one row for each class of ``members.py``.

``KINDS`` is the only place that lists the kinds. The builder makes nodes by it, the parser
recognises members by it where a text is broken, messages say by it how a member is written and
where it belongs, and ``semantics`` flattens inheritance by it. What a kind contributes to a shader
is said by the module of ``semantics`` that lowers it. ``docs/architecture.md`` tells how to add a
kind.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Literal, TypeGuard

from ....support.frozen import frozen
from ...diagnostics.source import Span
from . import members
from .expressions import Expression, Name, TypeName
from .members import RECORD_KINDS, Member, NamedMember, ReadMember, RecordKind

Inheritance = Literal["overridden", "replaced", "gathered"]
"""The way in which a record inherits a member of a base or a mixin.

- ``overridden``: its name means a value. The nearest definition counts, and ``inherited.name``
  reads the next one further up. Kinds may override each other.
- ``replaced``: nothing reads it. Of one name, or of the kind if it has no names, the nearest one
  counts.
- ``gathered``: it has no name, and those of the whole chain count together.
"""

Contribution = Literal["leaf", "value", "result", "drawn"]
"""The contribution of a member to a shader.

It is a leaf (a value that the host sets, a texture or a buffer that it binds, or an input of the
vertices), a value that others read, a result of the shader, or something that is drawn.
"""


@frozen
class MemberKind:
    """One kind of member: everything that the compiler knows about it before it is lowered."""

    word: str
    """The word that it begins with; empty for an equation, which begins with its name."""
    node: type[Member]
    productions: Mapping[str, Callable[..., Member]]
    """The productions of ``burnish.lark`` that read it, each with the function that makes the node.

    They are called with the span, with the doc comment if the node has a field ``doc``, and with
    the parts of the production.
    """
    opening: tuple[str, ...]
    """Symbols that follow the word in every such member, up to one that tells it from an equation.

    By them a member is recognised on a line of its own, whatever is unfinished above it.
    """
    records: tuple[RecordKind, ...]
    """The kinds of records, and of mixins for them, in which it may stand."""
    inheritance: Inheritance
    contribution: Contribution
    form: str
    """The form of a member, as messages and the manual show it."""
    doc: str
    """The purpose of such members, as the manual tells it."""
    has_default: bool = False
    """True if ``= …`` may follow its type."""

    @property
    def places(self) -> str:
        """The records in which it may stand, as messages list them:

        ``a material, a light or a pass``.
        """
        *others, last = (f"a {record}" for record in self.records)
        return f"{', '.join(others)} or {last}" if others else last

    @property
    def is_named(self) -> bool:
        """True if it has a name."""
        return "name" in self.node.__match_args__


def _texture(
    span: Span, doc: str, name: Name, type_: TypeName, content: Name | None, group: Name | None,
    default: Name | None, result: Name | None, *state: tuple[Name, Name],
) -> members.Texture:  # fmt: skip
    return members.Texture(span, doc, name, type_, content, group, default, result, state)


def _untyped_slot(span: Span, doc: str, name: Name, value: Expression) -> members.Slot:
    return members.Slot(span, doc, name, None, value)


def _expand(span: Span, doc: str, primitive: Name, *strips: members.Strips) -> members.Expand:
    return members.Expand(span, doc, primitive, strips)


def _clear(span: Span, *values: members.Slot) -> members.Clear:
    return members.Clear(span, values)


def _raster(span: Span, *settings: tuple[Name, Expression]) -> members.Raster:
    return members.Raster(span, settings)


def _depth(span: Span, *settings: tuple[Name, Expression]) -> members.Depth:
    return members.Depth(span, settings)


def _stencil(span: Span, *settings: tuple[Name, Expression]) -> members.Stencil:
    return members.Stencil(span, settings)


def _work_group(span: Span, *sides: Expression) -> members.WorkGroup:
    return members.WorkGroup(span, sides)


def _tessellate(
    span: Span, doc: str, patch: Name, points: Expression | None,
    ends: tuple[Expression, ...] | None, spacing: Name | None, level: Expression,
    inside: Expression | None, lines: Expression | None, coordinate: Name | None,
    *equations: members.Slot,
) -> members.Tessellate:  # fmt: skip
    return members.Tessellate(
        span, doc, patch, points, ends, spacing, level, inside, lines, coordinate, equations
    )


KINDS: tuple[MemberKind, ...] = (
    MemberKind(
        word="param",
        node=members.Param,
        productions={"param": members.Param},
        opening=("NAME", ":"),
        records=RECORD_KINDS,
        inheritance="overridden",
        contribution="leaf",
        form="a parameter is `param name : type in low..high per group = default`, where "
        "everything after the type is optional",
        doc="a value that the host sets",
        has_default=True,
    ),
    MemberKind(
        word="map",
        node=members.Texture,
        productions={"map": _texture},
        opening=("NAME", ":"),
        records=RECORD_KINDS,
        inheritance="overridden",
        contribution="leaf",
        form="a texture is `map name : texture2d of rgb per group = white with { filter = "
        "nearest }`, where everything after the type is optional",
        doc="a texture that the host binds, with its sampler",
        has_default=True,
    ),
    MemberKind(
        word="buffer",
        node=members.Buffer,
        productions={"buffer": members.Buffer},
        opening=("NAME", ":"),
        records=RECORD_KINDS,
        inheritance="overridden",
        contribution="leaf",
        form="a storage buffer is `buffer name : type[]` or `buffer name : type[] per group`",
        doc="any number of elements, which the host binds",
    ),
    MemberKind(
        word="attribute",
        node=members.Attribute,
        productions={"attribute": members.Attribute},
        opening=("NAME", ":"),
        records=("material", "pass"),
        inheritance="overridden",
        contribution="leaf",
        form="a vertex input is `attribute name : type` or "
        "`attribute name : type per instance`; it has no default",
        doc="an input of the vertices, from the mesh",
    ),
    MemberKind(
        word="",
        node=members.Slot,
        productions={"slot": _untyped_slot, "typed_slot": members.Slot},
        opening=(),
        records=RECORD_KINDS,
        inheritance="overridden",
        contribution="value",
        form="an equation is `name = expression` or `name : type = expression`; without a value, "
        "`name : type`, a derived record has to give one",
        doc="a value that is computed",
        has_default=True,
    ),
    MemberKind(
        word="target",
        node=members.Target,
        productions={"target": members.Target},
        opening=("NAME", ":"),
        records=("pass",),
        inheritance="replaced",
        contribution="result",
        form="a target is `target name : format = expression blend mode { setting = word }`, where "
        "the blending, its mode and its settings are optional",
        doc="what a pass writes to one render target",
        has_default=True,
    ),
    MemberKind(
        word="discard",
        node=members.Discard,
        productions={"discard": members.Discard},
        opening=("when",),
        records=("pass",),
        inheritance="gathered",
        contribution="result",
        form="a pass discards pixels by `discard when condition`",
        doc="where a pass writes nothing",
    ),
    MemberKind(
        word="clear",
        node=members.Clear,
        productions={"clear": _clear},
        opening=("{",),
        records=("pass",),
        inheritance="gathered",
        contribution="result",
        form="a pass says what is there before it draws by `clear { color = #112233, depth = 1 }`",
        doc="what is in the targets of a pass before it draws",
    ),
    MemberKind(
        word="layers",
        node=members.Layers,
        productions={"layers": members.Layers},
        opening=("of",),
        records=("pass",),
        inheritance="replaced",
        contribution="result",
        form="the number of layers is `layers of 6`",
        doc="how many layers each render target of a pass has",
    ),
    MemberKind(
        word="views",
        node=members.Views,
        productions={"views": members.Views},
        opening=("of",),
        records=("pass",),
        inheritance="replaced",
        contribution="result",
        form="the number of views is `views of 2`",
        doc="how many views of the scene a pass draws",
    ),
    MemberKind(
        word="raster",
        node=members.Raster,
        productions={"raster": _raster},
        opening=("{",),
        records=("pass",),
        inheritance="gathered",
        contribution="result",
        form="a pass says how it draws faces by `raster { cull = back, front = clockwise }`, where "
        "each setting is optional",
        doc="how a pass draws faces",
    ),
    MemberKind(
        word="depth",
        node=members.Depth,
        productions={"depth": _depth},
        opening=("{",),
        records=("pass",),
        inheritance="gathered",
        contribution="result",
        form="a pass says what it does with depths by `depth { compare = less, write = false }`, "
        "where each setting is optional",
        doc="what a pass does with depths",
    ),
    MemberKind(
        word="stencil",
        node=members.Stencil,
        productions={"stencil": _stencil},
        opening=("{",),
        records=("pass",),
        inheritance="gathered",
        contribution="result",
        form="a pass says what it does with stencil values by `stencil { compare = equal, "
        "reference = 1, pass = replace }`, where each setting is optional",
        doc="what a pass does with stencil values",
    ),
    MemberKind(
        word="capture",
        node=members.Capture,
        productions={"capture": members.Capture},
        opening=("NAME", ":"),
        records=("pass",),
        inheritance="replaced",
        contribution="result",
        form="a pass captures vertices by `capture name : type = expression`",
        doc="what a pass writes of each vertex to a buffer, instead of drawing",
        has_default=True,
    ),
    MemberKind(
        word="expand",
        node=members.Expand,
        productions={"expand": _expand},
        opening=("NAME", "{"),
        records=("material", "pass"),
        inheritance="gathered",
        contribution="result",
        form="an expansion is `expand triangle { strip of 3 as i for s in 0..4 where condition "
        "like corner[i] { slot = expression } }`, where everything between the number of vertices "
        "and the brace is optional, but stands in this order",
        doc="what each primitive of the mesh turns into",
    ),
    MemberKind(
        word="tessellate",
        node=members.Tessellate,
        productions={"tessellate": _tessellate},
        opening=("NAME",),
        records=("material",),
        inheritance="gathered",
        contribution="result",
        form="a tessellation is `tessellate quad of 16 ends [0, 3, 15, 12] spacing "
        "fractional_odd by level inside level as at { slot = expression }`, in this order, where "
        "only the kind of patch, a level and the braces are needed",
        doc="what each patch of the mesh is divided into",
    ),
    MemberKind(
        word="result",
        node=members.Result,
        productions={"result": members.Result},
        opening=("NAME", ":"),
        records=("kernel",),
        inheritance="replaced",
        contribution="result",
        form="a result is `result name : type[count] = expression`, or "
        "`result name : type[] per group = expression`",
        doc="what a kernel writes to each element of a buffer, or to each texel of an image",
        has_default=True,
    ),
    MemberKind(
        word="scatter",
        node=members.Scatter,
        productions={"scatter": members.Scatter},
        opening=("NAME", ":"),
        records=("kernel",),
        inheritance="replaced",
        contribution="result",
        form="a kernel scatters by `scatter name : uint[count] add value at place where "
        "condition`: by add, min, max, and, or or; the condition is optional",
        doc="what all invocations of a kernel together make of the elements of a storage buffer",
    ),
    MemberKind(
        word="runs",
        node=members.Extent,
        productions={"extent": members.Extent},
        opening=("over",),
        records=("kernel",),
        inheritance="replaced",
        contribution="result",
        form="a kernel says for how many elements it runs by `runs over count`",
        doc="for how many elements a kernel runs that has no result",
    ),
    MemberKind(
        word="work_group",
        node=members.WorkGroup,
        productions={"work_group": _work_group},
        opening=("of",),
        records=("kernel",),
        inheritance="replaced",
        contribution="result",
        form="the size of the work groups is `work_group of 128`, or `work_group of 16 by 16` "
        "where the results have two dimensions",
        doc="how many invocations of a kernel run together",
    ),
    MemberKind(
        word="models",
        node=members.Models,
        productions={"models": members.Models},
        opening=("NAME",),
        records=("frame",),
        inheritance="replaced",
        contribution="drawn",
        form="models of the host's scene are `models name`, or `models name : Material` where "
        "all of them are made of this material or of one that extends it",
        doc="models of the host's scene, which passes draw",
    ),
    MemberKind(
        word="output",
        node=members.Output,
        productions={"output": members.Output},
        opening=("NAME", "="),
        records=("frame",),
        inheritance="replaced",
        contribution="result",
        form="an output is `output name = result`",
        doc="a result that the host gets",
    ),
)

MEMBERS: Mapping[str, MemberKind] = MappingProxyType(
    {kind.word: kind for kind in KINDS if kind.word}
)
"""The kinds of members that begin with a word, by this word."""

_BY_NODE: Mapping[type, MemberKind] = {kind.node: kind for kind in KINDS}


def kind_of(member: Member | NamedMember) -> MemberKind:
    """The kind of a member."""
    return _BY_NODE[type(member)]


def is_named(member: Member) -> TypeGuard[NamedMember]:
    """True if a member has a name."""
    return kind_of(member).is_named


def only_one(member: Member) -> Name | None:
    """The key of which a record may have one member only: its name or, without one, its kind."""
    if is_named(member):
        return member.name
    kind = kind_of(member)
    return Name(kind.word, member.span) if kind.inheritance == "replaced" else None


def is_read(member: Member) -> TypeGuard[ReadMember]:
    """True if the name of a member means a value in expressions."""
    return kind_of(member).inheritance == "overridden"
