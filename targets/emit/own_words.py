"""Finds the words that a language's own texts contain, and that therefore cannot be names.

``names.py`` asks for them once for each language. They are the text of the skeleton between its
tags, and the rows of the language and its profiles: types, forms, spellings of builtins, inputs and
so on. So a row with a new word makes it one that no name takes. ``reserved.txt`` adds words that
compilers refuse although no text of Burnish has them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from itertools import chain

from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.row import nowhere
from ..description.profile import Profile
from ..description.reserved import Reserved
from ..description.shading_language import Language
from .templates import skeleton_texts

_TAG = re.compile(r"\{%.*?%\}|\{#.*?#\}", re.DOTALL)
_SHOWN = re.compile(r"\{\{.*?\}\}")
_FIELD = re.compile(r"\{[^{}\n]*\}")
_PART = "\0"
"""Replaces fields that are filled in: a word that touches it is only a part of a word."""
_COUNTS = "234"
"""The possible numbers of lanes or columns."""
_OF_PARTS = frozenset(
    {"dimensions", "float_suffix", "lane_words", "lanes", "semantic", "type", "uint_suffix"}
)
"""The fields of rows that hold parts of words, marks of declarations, or no text at all."""

_ELSEWHERE = re.compile(
    r'"[^"\n]*"'  # A text in quotes.
    r"|//.*$"  # A comment.
    r"|^\#.*$"  # A directive.
    r"|\[\[.*?\]\]"  # An attribute in C++'s syntax,
    r"|@\w+(?:\([\w, ]*\))?"  # in WGSL's,
    r"|^\s*\[[A-Za-z_]\w*"  # and in that of HLSL.
    r"| : SV_\w+"  # A semantic.
    r"|(?:\.|::)[A-Za-z_]\w*",  # A member.
    re.MULTILINE,
)
"""A pattern of places where a word cannot be confused with a name, whatever has that name."""
_WORD = re.compile(rf"(?<![\w{_PART}])[A-Za-z_]\w*(?![\w{_PART}])")


@cache
def taken_words(language: Language) -> Reserved:
    """All words that are no names in the texts of a language."""
    reserved = language.reserved()
    text = f"{_of_skeleton(language)}\n{_of_rows(language)}"
    own = frozenset(chain(words_in(text), _builtins(language)))
    return Reserved(reserved.words | own, reserved.pattern)


def words_in(text: str) -> list[str]:
    """The words of a text that would mean something else there if they were names."""
    return _WORD.findall(_ELSEWHERE.sub(" ", text))


def _of_skeleton(language: Language) -> str:
    own = (profile.skeleton for profile in language.profiles)
    skeletons = dict.fromkeys((language.skeleton, *filter(None, own)))
    text = "\n".join(chain.from_iterable(map(skeleton_texts, skeletons)))
    return _SHOWN.sub(_PART, _TAG.sub(" ", text))


def _of_rows(language: Language) -> str:
    """The text of all rows, with every possible value of fields that are parts of words."""
    dimensions = tuple(language.textures.dimensions.values())
    rows = (_rows(language), *map(_profile_rows, language.profiles))
    forms = chain.from_iterable(_expanded(form, dimensions) for form in _texts(rows))
    return _FIELD.sub(_PART, "\n".join(forms).replace("{{", " ").replace("}}", " "))


def _expanded(form: str, dimensions: Sequence[str]) -> Iterator[str]:
    """A form with each number of lanes, and with each dimension, if it has fields for them."""
    if "{dimension}" in form:
        for dimension in dimensions:
            yield from _expanded(form.replace("{dimension}", dimension), dimensions)
    elif "{n}" in form or "{lanes}" in form:
        for count in _COUNTS:
            yield form.replace("{n}", count).replace("{lanes}", count)
    else:
        yield form


def _rows(language: Language) -> tuple[object, ...]:
    """All rows that say how the language writes something; formats are words of it, too.

    Names inside of its helper functions hide other names, so that these do no harm, and the types
    in them stand in other rows.
    """
    return (
        language.types, language.textures, tuple(language.images), language.images,
        language.literals, language.forms, language.natives, language.inputs,
        language.primitives, language.patches, language.spacings, language.emitted,
        language.atomics, language.host_names,
    )  # fmt: skip


def _profile_rows(profile: Profile) -> tuple[object, ...]:
    """All rows that say how a profile writes something."""
    framebuffer = profile.framebuffer
    return (
        profile.preamble, profile.requires, profile.defaults, profile.natives, profile.inputs,
        profile.samplers, framebuffer.inputs, framebuffer.natives, profile.patch_winding,
        profile.types, profile.literals, profile.forms,
    )  # fmt: skip


def _texts(row: object) -> Iterator[str]:
    """The texts in a row, at any depth. Keys are Burnish's own words."""
    if isinstance(row, str):
        yield row
    elif isinstance(row, Mapping):
        yield from chain.from_iterable(map(_texts, row.values()))
    elif isinstance(row, tuple):
        yield from chain.from_iterable(map(_texts, row))
    else:
        fields: tuple[str, ...] = getattr(type(row), "__match_args__", ())
        parts = (getattr(row, field) for field in fields if field not in _OF_PARTS)
        yield from chain.from_iterable(map(_texts, parts))


def _builtins(language: Language) -> Iterator[str]:
    """The builtins that the language calls by the names that they have in Burnish."""
    profiles = language.profiles
    spelled = language.natives.keys() | set(chain(*(profile.natives for profile in profiles)))
    lacked = frozenset.intersection(*(profile.lacks for profile in profiles))
    for name in BUILTINS.keys() - spelled - lacked:
        row = BUILTINS[name]
        if not row.operator and row.domain is not nowhere and row.of_group is None:
            yield name
