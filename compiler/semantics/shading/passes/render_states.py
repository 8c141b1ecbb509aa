"""The state that a pass asks of the pipeline: rasterisation, depth test and stencil test.

``elaborate.py`` checks it for every pass, and gives it to the shader. Each setting is inherited by
itself: the nearest record that has it counts.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, get_args

from .....support.frozen import frozen
from ....diagnostics import rules
from ....diagnostics.source import Span
from ....ir.render_state import (
    MOST_BIAS,
    SAMPLES,
    STENCIL_MOST,
    Compare,
    Cull,
    DepthState,
    Fill,
    RenderState,
    StencilOperation,
    StencilSide,
    StencilState,
    Winding,
)
from ....ir.types import FLOAT, INT
from ....syntax import ast
from ...checking.step_needs import OF_STEPS
from ...declarations.fitting import typed
from ...declarations.textures import unknown_word
from ...inheritance.records import Record
from ...names.duplicates import check_once
from ...state.context import Context
from ...state.scope import Scope
from .clears import clears_of

Stated = type[ast.Raster] | type[ast.Depth] | type[ast.Stencil]
Said = Mapping[str, Any]
"""The settings of one kind of member, by the names of their fields."""


@frozen
class Words:
    """A setting that is one of some words."""

    words: tuple[str, ...]


@frozen
class Whole:
    """A setting that is a whole number."""

    least: int
    most: int

    def allows(self, number: int) -> bool:
        """True if the setting can have this value."""
        return self.least <= number <= self.most

    def __str__(self) -> str:
        return f"{self.least} to {self.most}"


@frozen
class OneOf:
    """A setting that is one of some whole numbers."""

    numbers: tuple[int, ...]

    def allows(self, number: int) -> bool:
        """True if the setting can have this value."""
        return number in self.numbers

    def __str__(self) -> str:
        return " and ".join(map(str, self.numbers))


@frozen
class Real:
    """A setting that is any number."""


@frozen
class Computed:
    """A setting that is no state: each fragment computes it."""


@frozen
class StateSetting:
    """A setting: the fields of the state that it sets, and its values."""

    fields: tuple[str, ...]
    """The fields of the state: several where one setting sets both sides."""
    values: Meant


Meant = Words | Whole | OneOf | Real | Computed
DEPTH_VALUE = "value"
"""The setting of depths that each fragment computes; ``elaborate.py`` makes a result of it."""
SWITCH = Words(("true", "false"))
BYTE = Whole(0, STENCIL_MOST)
SIDES = ("front", "back")


def _plain(**values: Meant) -> Mapping[str, StateSetting]:
    """Settings with the names of the fields."""
    return {name: StateSetting((name,), each) for name, each in values.items()}


def _sided(**values: Words) -> Mapping[str, StateSetting]:
    """Settings of both sides, and of each: ``pass`` and ``front.pass``.

    Those of one side stand last, as they count more.
    """
    fields = {name.removesuffix("_op"): name for name in values}
    both = {
        name: StateSetting(tuple(f"{side}.{field}" for side in SIDES), values[field])
        for name, field in fields.items()
    }
    one = {
        f"{side}.{name}": StateSetting((f"{side}.{field}",), values[field])
        for side in SIDES
        for name, field in fields.items()
    }
    return {**both, **one}


COMPARISONS = Words(get_args(Compare))
OPERATIONS = Words(get_args(StencilOperation))

SETTINGS: Mapping[Stated, Mapping[str, StateSetting]] = {
    ast.Raster: _plain(
        cull=Words(get_args(Cull)), front=Words(get_args(Winding)), fill=Words(get_args(Fill)),
        invariant=SWITCH,
        samples=OneOf(SAMPLES),
        alpha_to_coverage=SWITCH,
    ),
    ast.Depth: _plain(
        compare=COMPARISONS, write=SWITCH, bias=Whole(-MOST_BIAS, MOST_BIAS), slope_bias=Real(),
        bias_clamp=Real(), value=Computed(),
    ),
    ast.Stencil: {
        **_plain(reference=BYTE, read_mask=BYTE, write_mask=BYTE),
        **_sided(compare=COMPARISONS, fail_op=OPERATIONS, depth_fail_op=OPERATIONS,
                 pass_op=OPERATIONS),
    },
}  # fmt: skip
"""The settings in members of each kind."""


def render_state_of(ctx: Context, drawn: Record) -> RenderState:
    """The state that a pass asks for.

    Settings that stand twice in one place, and values that mean nothing there, are reported; for
    them, and where the pass says nothing, the defaults hold.
    """
    return RenderState(
        **_said(ctx, drawn, ast.Raster),
        depth=DepthState(**_said(ctx, drawn, ast.Depth), **_cleared(ctx, drawn)),
        stencil=_stencil_of(_said(ctx, drawn, ast.Stencil)),
    )


def _cleared(ctx: Context, drawn: Record) -> Said:
    depth = clears_of(ctx, drawn).depth
    return {} if depth is None else {"clear": depth}


def _stencil_of(said: Said) -> StencilState:
    plain = {name: value for name, value in said.items() if "." not in name}
    front, back = (StencilSide(**_of_side(side, said)) for side in SIDES)
    return StencilState(front, back, **plain)


def _of_side(side: str, said: Said) -> Said:
    prefix = f"{side}."
    return {
        name.removeprefix(prefix): value for name, value in said.items() if name.startswith(prefix)
    }


def of_a_pass(name: str) -> str:
    """A hint where a setting of passes belongs, for who sets it elsewhere; empty for others."""
    for node, settings in SETTINGS.items():
        if name in settings:
            word = next(word for word, kind in ast.MEMBERS.items() if kind.node is node)
            return f"the pass says that: `{word} {{ {name} = … }}`"
    return ""


def _said(ctx: Context, drawn: Record, kind: Stated) -> Said:
    """The settings in the members of one kind that mean something.

    The nearest record's count, and in one record those of one side before those of both.
    """
    known, found = SETTINGS[kind], dict[str, Any]()
    order = {name: number for number, name in enumerate(known)}
    for member, owner, _ in drawn.every(kind):
        check_once(ctx.report, (name for name, _ in member.settings))
        scope = Scope(owner.module)
        for name, value in sorted(member.settings, key=lambda row: order.get(row[0].text, 0)):
            setting = known.get(name.text)
            if setting is None:
                _report_unknown(ctx, ast.kind_of(member).word, name, known)
                continue
            if isinstance(setting.values, Computed):
                continue
            meant = _value(ctx, name, value, setting.values, scope)
            if meant is not None:
                found |= dict.fromkeys(setting.fields, meant)
    return found


def _report_unknown(
    ctx: Context, word: str, name: ast.Name, known: Mapping[str, StateSetting]
) -> None:
    """Report a name that is no setting there; steps of frames, or other members, may have it."""
    kind, hint = f"{word} setting", of_a_pass(name.text)
    if name.text in OF_STEPS:
        hint = f"a step of a frame sets it: `Pass(models) with {{ {name.text} = … }}`"
    if hint:
        ctx.report.add(rules.UNKNOWN_NAME, name.span, kind=kind, name=name.text, hint=hint)
    else:
        unknown_word(ctx, kind, name, known)


def _value(
    ctx: Context, name: ast.Name, written: ast.Expression, wanted: Meant, scope: Scope
) -> Any:
    """The value of a setting; ``None`` after reporting that it cannot be."""
    span = written.span
    match wanted:
        case Words():
            word = _word(written)
            if word in wanted.words:
                return word == "true" if wanted is SWITCH else word
            unknown_word(ctx, f"value for `{name.text}`", ast.Name(word, span), wanted.words)
            return None
        case Whole() | OneOf():
            number = ctx.constants.integer(typed(ctx, written, scope, INT, "int"), span)
            if number is not None and not wanted.allows(number):
                ctx.report.add(
                    rules.IMPOSSIBLE_SETTING,
                    span,
                    name=name.text,
                    value=number,
                    possible=str(wanted),
                )
                return None
            return number
        case Computed():
            return None
        case Real():
            return ctx.constants.number(typed(ctx, written, scope, FLOAT, "float"), span)


def _word(written: ast.Expression) -> str:
    """A word as it stands there, or whatever stands in its place."""
    if isinstance(written, ast.Reference):
        return written.name
    return _text(written.span)


def _text(span: Span) -> str:
    return span.source.text[span.start : span.end]
