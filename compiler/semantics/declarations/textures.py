"""Declared textures, each with the state of the sampler that reads it."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import get_args

from ....support.frozen import EMPTY, changed, frozen
from ...diagnostics import rules
from ...diagnostics.nearest import respelling, respelt
from ...ir import default_textures
from ...ir.leaves import Texture
from ...ir.meaning import COLORS as COLOR_MEANINGS
from ...ir.meaning import RGBA
from ...ir.shader import TextureInfo
from ...ir.types import AXES, Array, Border, Intent, TextureType, Wrap
from ...syntax import ast
from ..inheritance.records import Definition
from ..names.duplicates import check_once
from ..state.context import Context
from .written_types import declared_type

Settings = Mapping[str, tuple[str, ...]]
"""The settings of a sampler, each with its words; the first one is the default."""

COLOR_DEFAULTS = tuple(default_textures.COLORS)
WRAP: tuple[Wrap, ...] = get_args(Wrap)
BORDERS: Mapping[str, Border] = {word: word for word in get_args(Border)}
DEPTH_BORDERS: Mapping[str, Border] = {"far": "white", "near": "black"}
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
    axes: tuple[str, ...] = ()
    """The axes that may wrap each in its own way."""
    borders: Mapping[str, Border] = EMPTY
    """The words for the texel of a border, if there may be one; the first is the default."""
    anisotropies: tuple[int, ...] = ()
    """How many times as long as wide a filtered footprint may be; the first is the default."""

    @property
    def sampling(self) -> Settings:
        """All settings of the sampler that a declaration may have, with their words."""
        by_axis = {wrap_of(axis): self.settings["wrap"] for axis in self.axes}
        borders = {"border": tuple(self.borders)} if self.borders else {}
        longest = {"anisotropy": tuple(map(str, self.anisotropies))} if self.anisotropies else {}
        return {**self.settings, **by_axis, **borders, **longest}

    @property
    def words(self) -> Settings:
        """All settings that a declaration may have, with their words."""
        return {**self.sampling, "intent": self.intents} if self.intents else self.sampling


def wrap_of(axis: str) -> str:
    """The name of the setting that says how a texture continues along one axis."""
    return f"wrap_{axis}"


INTENTS: tuple[Intent, ...] = get_args(Intent)
ANISOTROPIES = (1, 2, 4, 8, 16)
COLORS = Kind(
    COLOR_DEFAULTS, {**FILTERED, "wrap": WRAP}, intents=INTENTS, axes=AXES[:2], borders=BORDERS,
    anisotropies=ANISOTROPIES,
)  # fmt: skip
VOLUMES = changed(COLORS, axes=AXES)
CUBES = Kind(
    COLOR_DEFAULTS, FILTERED, {"wrap": "clamp"}, intents=INTENTS, anisotropies=ANISOTROPIES
)
COMPARED: Settings = {
    "filter": ("linear", "nearest"),
    "compare": ("less_equal", "less", "greater_equal", "greater"),
}
_DEPTH_DEFAULTS = tuple(default_textures.DEPTHS)
DEPTHS = Kind(
    _DEPTH_DEFAULTS, {**COMPARED, "wrap": ("clamp", "repeat", "mirror", "border")},
    {"mip": "none"}, axes=AXES[:2], borders=DEPTH_BORDERS,
)  # fmt: skip
DEPTH_CUBES = Kind(_DEPTH_DEFAULTS, COMPARED, {"mip": "none", "wrap": "clamp"})
INTEGERS = Kind(tuple(default_textures.INTEGERS))
"""Textures of integers: nothing filters them, so they have no sampler."""

DEFAULTS = frozenset((*COLOR_DEFAULTS, *DEPTHS.defaults, *INTEGERS.defaults))
"""All words for the texture that stands in until a host binds one."""


def kind_of(texture: TextureType) -> Kind:
    """The kind of textures of this type."""
    match texture.sample:
        case "float" if texture.is_cube:
            return CUBES
        case "float":
            return VOLUMES if texture.dimension == "3d" else COLORS
        case "depth":
            return DEPTH_CUBES if texture.is_cube else DEPTHS
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
        words, text = kind.sampling, f"{text} of {member.content.text}"
    said = _settings(ctx, member, words, text)
    written = "color" if holds_colors else said.pop("intent", None)
    intent = next((each for each in kind.intents if each == written), None)
    state = _state(ctx, member, kind, said, text)
    found = Texture(
        name, declared.type, group, owner, default, tuple(sorted(state.items())),
        RGBA if holds_colors else None,
    )  # fmt: skip
    is_brought = member.brought is not None
    return TextureInfo(
        found, declared.text, member.doc, member.name.span, is_brought=is_brought, intent=intent
    )


def _state(
    ctx: Context, member: ast.Texture, kind: Kind, said: Mapping[str, str], type_: str
) -> dict[str, str]:
    """The state of the sampler, with what is left out, and without what goes without saying.

    An axis is only in it if it wraps in another way than ``wrap`` says, a border if there is one,
    and an anisotropy if it is more than 1. Reports a border that none of the axes has, and an
    anisotropy without linear filters, which no API takes.
    """
    state = {**kind.fixed, **{key: words[0] for key, words in kind.settings.items()}, **said}
    wrapped = {state.get(wrap_of(axis), state["wrap"]) for axis in kind.axes}
    for axis in kind.axes:
        if state.get(wrap_of(axis)) == state["wrap"]:
            del state[wrap_of(axis)]
    if "border" in wrapped:
        state["border"] = kind.borders[said.get("border", next(iter(kind.borders)))]
    elif state.pop("border", None) is not None:
        _report_useless(ctx, member, "border", f"{type_} with {{ wrap = {state['wrap']} }}")
    if state.get("anisotropy") == "1":
        del state["anisotropy"]
    elif "anisotropy" in state:
        unlike = next((key for key in ("filter", "mip") if state[key] != "linear"), None)
        if unlike is not None:
            text = f"{type_} with {{ {unlike} = {state[unlike]} }}"
            _report_useless(ctx, member, "anisotropy", text)
    return state


def _report_useless(ctx: Context, member: ast.Texture, name: str, type_: str) -> None:
    """Report a setting that has no effect beside the others."""
    (span,) = (key.span for key, _ in member.state if key.text == name)
    ctx.report.add(rules.SETTING_WITHOUT_USE, span, name=name, type=type_)


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
    known = {**VOLUMES.words, **DEPTHS.words}
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
