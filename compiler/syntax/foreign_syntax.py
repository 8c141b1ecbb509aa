"""Declarations as other languages write them, type first, and how Burnish writes them.

``advice.py`` asks here for hints about names in a row, such as ``const vec3 tint``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from ..diagnostics.fixes import Hint, fix_it
from ..diagnostics.source import Span
from .ast import MEMBERS
from .forms import DECLARATIONS

_DECLARATORS = frozenset(("let", "var", "const", "auto", "local", "mut", "override", "set"))
QUALIFIERS = _DECLARATORS | frozenset(
    (
        "static", "inline", "precise", "highp", "mediump", "lowp", "invariant", "flat", "in", "out",
        "inout", "uniform", "varying", "public", "private", "pub", "export", "extern", "readonly",
    )
)  # fmt: skip
"""Words that other languages write before a type, or instead of one."""
_SAMPLERS = frozenset(("SamplerState", "SamplerComparisonState", "sampler_comparison"))
_WORDS_OF_MEMBERS = frozenset(word for word, kind in MEMBERS.items() if kind.is_named)
"""The words of members that have a name."""


def types() -> Mapping[str, str]:
    """The names of types here, by their names here and in other languages."""
    from ...stdlib.builtins.elsewhere import TYPES

    here = dict.fromkeys(("float", "int", "uint", "bool", "angle", *TYPES.values()))
    return {**{name: name for name in here}, **TYPES}


def elsewhere(word: str) -> str:
    """The hint for a statement of another language that begins with ``word``."""
    from ...stdlib.builtins.elsewhere import KEYWORDS

    return KEYWORDS.get(word, "")


class Row(NamedTuple):
    """Several names in a row, with the text behind them on the line."""

    words: Sequence[str]
    length: str
    """The number in brackets after them, which is the length of an array; may be empty."""
    value: str
    """The text behind ``=``, ``…`` if that is long; empty if there is no ``=``."""
    span: Span
    """The span of the names and the brackets."""


def rewritten(row: Row, *, in_body: bool) -> Hint:
    """The hint for ``const vec3 name = …`` and its like; empty where nothing comes to mind.

    ``in_body`` says that it stands among the members of a record, where a ``param`` or ``map`` may.
    """
    word = f"{row.words[0]} " if row.words[0] in _WORDS_OF_MEMBERS else ""
    words = list(row.words[1:] if word else row.words)
    qualifiers: list[str] = []
    while len(words) > 1 and words[0] in QUALIFIERS:
        qualifiers.append(words.pop(0))
    if len(words) == 1:
        declarator = next(filter(_DECLARATORS.__contains__, qualifiers), "")
        said = f"equations need no `{declarator}`: write `{words[0]} = {row.value or '…'}`"
        return fix_it(said, (row.span, words[0])) if declarator else ""
    if len(words) != 2:
        return ""
    hint, instead = _typed(word, words[0], words[1], row, is_uniform="uniform" in qualifiers)
    is_member = instead.startswith(("param ", "map "))
    return fix_it(hint, (row.span, instead)) if instead and in_body >= is_member else hint


def _typed(word: str, type_: str, name: str, row: Row, *, is_uniform: bool) -> tuple[str, str]:
    """The hint for a type and a name, and the text in place of the names."""
    known = types()
    if word and name in known and type_ not in known:
        instead = f"{word}{type_} : {known[name]}"
        return f"the type follows a colon: write `{instead}`", instead
    if type_ in _SAMPLERS:
        written = "map name : texture2d with { filter = nearest }"
        return f"a sampler belongs to its texture: `{written}`", ""
    if type_ not in known and not type_[0].isupper():
        if _begins_elsewhere(type_):
            return "", ""
        return f"a name is one word: `{type_}_{name}`", f"{word}{type_}_{name}"
    if _begins_elsewhere(type_):
        return "", ""
    here = known.get(type_, type_)
    if here.startswith(("texture", "itexture", "utexture", "depth")) and not word:
        instead = f"map {name} : {here}"
        return f"a texture is a member: `{instead}`", instead
    if row.length:
        here += f"[{row.length}]"
    if is_uniform:
        instead = f"param {name} : {here}"
        return f"a value that the host sets is a parameter of a material: `{instead}`", instead
    may_have_value = not word or MEMBERS[word.rstrip()].has_default
    value = f" = {row.value}" if row.value and may_have_value else ""
    instead = f"{word}{name} : {here}"
    return f"the type follows the name: write `{instead}{value}`", instead


def _begins_elsewhere(word: str) -> bool:
    """True if a word begins a declaration here or elsewhere, so that it is no type."""
    return word in DECLARATIONS or bool(elsewhere(word))
