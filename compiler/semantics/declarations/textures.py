"""Declared textures, each with the state of the sampler that reads it."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import get_args

from ....support.frozen import EMPTY, frozen
from ...diagnostics import rules
from ...diagnostics.nearest import respelling, respelt
from ...ir import default_textures
from ...ir.leaves import Texture
from ...ir.meaning import COLORS as COLOR_MEANINGS
from ...ir.meaning import RGBA
from ...ir.shader import TextureInfo
from ...ir.types import Array, Intent, TextureType
from ...syntax import ast
from ..inheritance.records import Definition
from ..names.duplicates import check_once
from ..state.context import Context
from .written_types import declared_type

Settings = Mapping[str, tuple[str, ...]]
"""The settings of a sampler, each with its words; the first one is the default."""

COLOR_DEFAULTS = tuple(default_textures.COLORS)
WRAP = ("repeat", "clamp", "mirror")
FILTERED: Settings = {"filter": ("linear", "nearest"), "mip": ("linear", "nearest", "none")}


@frozen
class Kind:
    """The possible defaults and settings of one kind of texture."""

    defaults: tuple[str, ...]
    """The words for a texture that a host binds if it has no picture; the first is the default."""
    settings: Settings = EMPTY
    fixed: Mapping[str, str] = EMPTY
    """State that goes without saying."""
    intents: tuple[Intent, ...] = ()
    """The possible intents, if a declaration may say one."""

    @property
    def words(self) -> Settings:
        """All settings that a declaration may have, with their words."""
        return {**self.settings, "intent": self.intents} if self.intents else self.settings


INTENTS: tuple[Intent, ...] = get_args(Intent)
COLORS = Kind(COLOR_DEFAULTS, {**FILTERED, "wrap": WRAP}, intents=INTENTS)
CUBES = Kind(COLOR_DEFAULTS, FILTERED, {"wrap": "clamp"}, INTENTS)
COMPARED: Settings = {
    "filter": ("linear", "nearest"),
    "compare": ("less_equal", "less", "greater_equal", "greater"),
}
_DEPTH_DEFAULTS = tuple(default_textures.DEPTHS)
DEPTHS = Kind(_DEPTH_DEFAULTS, {**COMPARED, "wrap": ("clamp", "repeat", "mirror")}, {"mip": "none"})
DEPTH_CUBES = Kind(_DEPTH_DEFAULTS, COMPARED, {"mip": "none", "wrap": "clamp"})
INTEGERS = Kind(tuple(default_textures.INTEGERS))
"""Textures of integers: nothing filters them, so they have no sampler."""

DEFAULTS = frozenset((*COLOR_DEFAULTS, *DEPTHS.defaults, *INTEGERS.defaults))
"""All words for the texture that stands in until a host binds one."""


def kind_of(texture: TextureType) -> Kind:
    """The kind of textures of this type."""
    is_cube = texture.dimension == "cube"
    match texture.sample:
        case "float":
            return CUBES if is_cube else COLORS
        case "depth":
            return DEPTH_CUBES if is_cube else DEPTHS
        case _:
            return INTEGERS


def texture_of(
    ctx: Context, definition: Definition, name: str, group: str, owner: str
) -> TextureInfo | None:
    """The texture that a ``map`` declares; ``None`` after reporting why it is none."""
    member = definition.member
    assert isinstance(member, ast.Texture)
    declared = declared_type(ctx, member.type, definition.owner.module)
    if declared is None:
        return None
    if not isinstance(declared.type, TextureType):
        ctx.report.add(
            rules.WRONG_TYPE, member.type.span, expected="a texture type", found=declared.text,
            hint="layers of one texture are a `texture2d_array`"
            if isinstance(declared.type, Array)
            else "`texture2d` is one",
        )  # fmt: skip
        return None
    kind = kind_of(declared.type)
    default = kind.defaults[0]
    if member.brought is not None:
        _check_bringer(ctx, definition)
    elif member.default is not None:
        default = member.default.text
        if default not in kind.defaults:
            unknown_word(ctx, "texture default", member.default, kind.defaults)
    holds_colors = _says_colors(ctx, member, kind, declared.text)
    words, text = kind.words, declared.text
    if holds_colors:
        assert member.content is not None
        words, text = kind.settings, f"{text} of {member.content.text}"
    said = _settings(ctx, member, words, text)
    written = "color" if holds_colors else said.pop("intent", None)
    intent = next((each for each in kind.intents if each == written), None)
    state = {**kind.fixed, **{key: words[0] for key, words in kind.settings.items()}, **said}
    found = Texture(
        name, declared.type, group, owner, default, tuple(sorted(state.items())),
        RGBA if holds_colors else None,
    )  # fmt: skip
    is_brought = member.brought is not None
    return TextureInfo(
        found, declared.text, member.doc, member.name.span, is_brought=is_brought, intent=intent
    )


def _says_colors(ctx: Context, member: ast.Texture, kind: Kind, type_: str) -> bool:
    """True for a ``map`` that holds colours by its declaration: ``texture2d of rgb``.

    Reports anything else that is written behind ``of``.
    """
    if member.content is None:
        return False
    if not kind.intents:
        name = f"of {member.content.text}"
        ctx.report.add(rules.SETTING_WITHOUT_USE, member.content.span, name=name, type=type_)
    elif member.content.text not in COLOR_MEANINGS:
        ctx.report.add(
            rules.UNKNOWN_NAME, member.content.span, kind="content of a texture",
            name=member.content.text,
            hint="colours are `of rgb`; without `of`, texels are colours if they become some",
        )  # fmt: skip
    else:
        return True
    return False


def _check_bringer(ctx: Context, definition: Definition) -> None:
    """Report a texture that a step of its own record leaves, if that is no light's."""
    declaration = definition.owner.declaration
    assert isinstance(declaration, ast.Record | ast.Mixin)
    assert isinstance(definition.member, ast.Texture) and definition.member.default is not None
    if declaration.kind != "light":
        ctx.report.add(
            rules.NOT_BROUGHT, definition.member.default.span, name=definition.member.name.text,
            record=declaration.kind,
        )  # fmt: skip


def _settings(ctx: Context, member: ast.Texture, words: Settings, type_: str) -> dict[str, str]:
    """The settings that a declaration says, of those that textures of its type have, ``words``.

    Wrong ones have been reported, and are left out.
    """
    check_once(ctx.report, (key for key, _ in member.state))
    said: dict[str, str] = {}
    known = {**COLORS.words, **DEPTHS.words}
    for key, value in member.state:
        if key.text not in known and words:
            unknown_word(ctx, "texture setting", key, words)
        elif key.text not in words:
            ctx.report.add(rules.SETTING_WITHOUT_USE, key.span, name=key.text, type=type_)
        elif value.text not in words[key.text]:
            unknown_word(ctx, f"value for `{key.text}`", value, words[key.text])
        else:
            said[key.text] = value.text
    return said


def unknown_word(ctx: Context, kind: str, name: ast.Name, known: Collection[str]) -> None:
    """Report a word that is none of those which can stand in its place."""
    from ....stdlib.builtins.state_words import word_here

    listed = ", ".join(f"`{word}`" for word in known)
    meant = word_here(name.text)
    hint = (
        respelt(name.text, name.span, meant)
        if meant in known
        else respelling(name.text, name.span, known) or f"one of {listed}"
    )
    ctx.report.add(rules.UNKNOWN_NAME, name.span, kind=kind, name=name.text, hint=hint)
