"""The blending of a pass's targets, and the masks of their lanes.

``elaborate.py`` asks for it for every target. A word says all of a target's blending; a setting
says only what it names: so `blend add { mask = rgb }` adds, and leaves alpha alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, cast, get_args

from .....support.frozen import changed
from ....diagnostics import rules
from ....ir.blending import (
    NAMED,
    OF_ALPHA,
    REPLACES,
    WITHOUT_FACTORS,
    Blend,
    BlendEquation,
    Factor,
    Mask,
    Operation,
)
from ....ir.types import VEC4, width
from ....syntax import ast
from ...checking.unknown_names import unknown
from ...declarations.textures import unknown_word
from ...inheritance.records import Record
from ...names.duplicates import check_once
from ...state.context import Context
from .formats import FORMATS

_BY_ALPHA = ("alpha", "premultiplied")
"""The words that mix by the fourth lane of the value that is written."""

ALPHA = "alpha_"
"""The prefix of settings that are about alpha alone."""
EQUATION: Mapping[str, tuple[str, ...]] = {
    "source": get_args(Factor),
    "destination": get_args(Factor),
    "operation": get_args(Operation),
}
SETTINGS: Mapping[str, tuple[str, ...]] = {
    **EQUATION,
    **{f"{ALPHA}{name}": words for name, words in EQUATION.items()},
    "mask": get_args(Mask),
}
"""The settings of a target's blending, each with its words.

Those that begin with ``alpha_`` are about alpha, and the others about all lanes without a setting
of their own.
"""

LANES = "rgba"


def blending_of(ctx: Context, drawn: Record, target: ast.Target) -> tuple[Blend, Mask]:
    """A target's own blending, or that which the nearest header of its pass names; and its mask.

    Errors are reported, and left out.
    """
    headers = (symbol.declaration for symbol in drawn.chain)
    written = target.blend
    mode = None if written is None else written.mode
    named = [mode, *(h.blend for h in headers if isinstance(h, ast.Record))]
    chosen = next((name for name in named if name is not None), None)
    blend = REPLACES if chosen is None else _named(ctx, chosen)
    lanes = width(FORMATS.get(target.format.text, VEC4))
    said = {} if written is None else dict(_settings(ctx, written))
    blend = _changed(ctx, blend, said)
    if lanes < len(LANES):
        _check_alpha(ctx, target, blend, (chosen, *said.values()))
    return blend, _mask(said["mask"].text if "mask" in said else LANES, lanes)


def _named(ctx: Context, chosen: ast.Name) -> Blend:
    if chosen.text not in NAMED:
        unknown(ctx, "blending", chosen.text, chosen.span, NAMED)
    return NAMED.get(chosen.text, REPLACES)


def _settings(ctx: Context, written: ast.Blending) -> Iterator[tuple[str, ast.Name]]:
    """The settings that mean something, by name; others are reported."""
    check_once(ctx.report, (name for name, _ in written.settings))
    for name, value in written.settings:
        if name.text not in SETTINGS:
            unknown_word(ctx, "blend setting", name, SETTINGS)
        elif value.text not in SETTINGS[name.text]:
            unknown_word(ctx, f"value for `{name.text}`", value, SETTINGS[name.text])
        else:
            yield name.text, value


def _changed(ctx: Context, blend: Blend, said: Mapping[str, ast.Name]) -> Blend:
    """``blend`` with its equations changed by settings."""
    every = {name: said[name].text for name in EQUATION if name in said}
    of_alpha = {name: said[ALPHA + name].text for name in EQUATION if ALPHA + name in said}
    made = {"": _equation(blend.color, every), ALPHA: _equation(blend.alpha, {**every, **of_alpha})}
    for part, equation in made.items():
        factors = [said.get(f"{part}{name}") for name in ("source", "destination")]
        for factor in factors:
            if factor and factor.text != "one" and equation.operation in WITHOUT_FACTORS:
                ctx.report.add(rules.FACTOR_IGNORED, factor.span, operation=equation.operation)
    return Blend(made[""], made[ALPHA])


def _equation(equation: BlendEquation, said: Mapping[str, Any]) -> BlendEquation:
    """An equation with some of its words changed; the smaller or larger side has no factors."""
    made = changed(equation, **said)
    free = made.operation in WITHOUT_FACTORS
    return BlendEquation("one", "one", made.operation) if free else made


def _check_alpha(
    ctx: Context, target: ast.Target, blend: Blend, words: Iterable[ast.Name | None]
) -> None:
    """Reports words that take an alpha where a target has none; the hardware would invent one."""
    if OF_ALPHA.isdisjoint(blend.color.factors):
        return
    word = next(word for word in words if word and word.text in (*_BY_ALPHA, *OF_ALPHA))
    ctx.report.add(
        rules.NO_ALPHA, word.span, blend=word.text, format=target.format.text,
        hint=f"say how `{target.name.text}` is blended: `… blend add`, or `… blend none`",
    )  # fmt: skip


def _mask(word: str, lanes: int) -> Mask:
    """A mask; all lanes that a format has are ``rgba``."""
    return cast(Mask, LANES if set(LANES[:lanes]) <= set(word) else word)
