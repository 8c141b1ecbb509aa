"""Finds gaps in the description of a language, before anything is printed by it.

``registry.load`` asks when a language is loaded, so that its author learns at once what is missing,
and where to write it. Otherwise some material that needs it would end in an error far from the row.
This module has only checks that take no time; the tests in ``tests/targets`` have the others, such
as whether a compiler knows the word for each builtin.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from string import Formatter
from typing import TypeVar, get_args

from ...compiler.ir.kernel import ScatterOperator
from ...compiler.ir.stages import COMPUTE, CONTROL, GEOMETRY, inputs_of
from ...compiler.ir.tessellation import Patch, Spacing
from ...compiler.ir.types import ScalarKind
from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.row import nowhere
from .capabilities import OF_INPUTS
from .form_fields import FIELDS, MAY_BE_EMPTY, NEEDED
from .forms import Forms
from .profile import Profile
from .shading_language import Language

Name = TypeVar("Name", bound=str)

_DEFAULTS = Forms()
_WRITTEN = {
    name for name in Forms.__annotations__ if name not in MAY_BE_EMPTY and getattr(_DEFAULTS, name)
}
"""Forms that every language writes."""


class LanguageError(ValueError):
    """The description of a language has faults; the text has a line for each of them."""


def check(language: Language) -> None:
    """Raise ``LanguageError`` if a language cannot be printed as it is described."""
    if found := list(faults(language)):
        raise LanguageError("\n".join(found))


def faults(language: Language) -> Iterator[str]:
    """The faults of a language: sentences that say what to write, and in which row."""
    for profile in language.profiles:
        name, written = f"{language.name}:{profile.name}", language.under(profile)
        for asked in (_builtins, _inputs, _types, _textures, _stages, _uniforms):
            yield from (f"{name} {sentence}" for sentence in asked(written, profile))
        if profile.forms is not None:
            yield from (f"{name} {sentence}" for sentence in _forms(profile.forms))
    yield from (f"{language.name} {sentence}" for sentence in _forms(language.forms))


def _builtins(language: Language, profile: Profile) -> Iterator[str]:
    """Rows that name unknown builtins, and builtins that no row and no definition can write."""
    tables: Mapping[str, Iterable[str]] = {
        "Language.natives": language.natives,
        "Language.splats": language.splats,
        "Profile.natives": profile.natives,
        "Profile.lacks": profile.lacks,
        "Profile.agrees": profile.agrees,
        "Profile.mistakes": profile.mistakes,
        "Profile.cannot": profile.cannot,
        "Profile.requires": profile.requires,
    }
    for row, names in tables.items():
        for name in sorted(set(names) - BUILTINS.keys()):
            yield (
                f"names `{name}` in `{row}`, which is no builtin: write the name of a row of "
                "`stdlib/builtins`."
            )
    for name in sorted(profile.lacks & BUILTINS.keys()):
        if not BUILTINS[name].definition:
            yield (
                f"lacks `{name}`, which has no definition: give its row in `stdlib/builtins` a "
                "`definition`, or name it in `Profile.cannot` instead of `Profile.lacks`."
            )
    for name in sorted(profile.agrees.keys() & BUILTINS.keys()):
        if not BUILTINS[name].definition and BUILTINS[name].by_profile is nowhere:
            yield (
                f"says in `Profile.agrees` for which operands it has `{name}`, and nothing is "
                "used for the others: give the row in `stdlib/builtins` a `definition`."
            )


def _inputs(language: Language, profile: Profile) -> Iterator[str]:
    """Values of the pipeline that a stage may read, and that no row spells or refuses."""
    for name, row in inputs_of(profile.stages).items():
        if name in language.inputs or name in profile.inputs:
            continue
        if name not in profile.without_inputs:
            refused = ", or name it in `Profile.without_inputs`" if name in OF_INPUTS else ""
            yield (
                f"does not say how `{name}` is read, which varies over {row.domain}: write a "
                f"`PipelineInput` for it in `Language.inputs` or `Profile.inputs`{refused}."
            )
    for name in sorted(profile.without_inputs - OF_INPUTS.keys()):
        yield (
            f"refuses `{name}` in `Profile.without_inputs`, and no message says so: add its need "
            "to `OF_INPUTS` in `targets/description/capabilities.py`."
        )


def _types(language: Language, profile: Profile) -> Iterator[str]:
    types = language.types
    for kind in get_args(ScalarKind):
        for row, table in (("scalars", types.scalars), ("vectors", types.vectors)):
            if kind not in table:
                narrow = " Bools are stored as such, so a type of integers will do."
                yield (
                    f"has no {row} of kind `{kind}`: write their type in `TypeNames.{row}`."
                    f"{narrow if kind == 'uint' and not profile.wide_integers else ''}"
                )


def _textures(language: Language, profile: Profile) -> Iterator[str]:
    """Types of textures, and of their samplers, that have no word."""
    names, combined = language.textures, profile.samplers.combined
    for type_ in sorted(profile.textures, key=str):
        left_out = f"or leave `{type_}` out of `Profile.textures`"
        if type_.dimension not in names.dimensions:
            yield (
                f"has no word for the dimension `{type_.dimension}` of `{type_}`: write it in "
                f"`TextureNames.dimensions`, {left_out}."
            )
        row, table = ("combined", names.combined) if combined else ("textures", names.textures)
        if type_.sample not in table:
            yield (
                f"has no type for `{type_}`: write one for `{type_.sample}` in "
                f"`TextureNames.{row}`, {left_out}."
            )
        if type_.sample == "depth" and combined and not names.compared:
            yield (
                f"has no type for `{type_}` with a sampler that compares: write it in "
                f"`TextureNames.compared`, {left_out}."
            )
        use = "comparison" if type_.sample == "depth" else "filtering"
        if not combined and use not in names.samplers:
            yield (
                f"has no sampler for `{type_}`: write its type for `{use}` in "
                f"`TextureNames.samplers`, {left_out}."
            )


def _forms(forms: Forms) -> Iterator[str]:
    """Forms with unknown fields, forms that lack a field that they need, and empty ones."""
    for name in sorted(_WRITTEN):
        if not getattr(forms, name):
            yield (
                f"leaves `Forms.{name}` empty, and then nothing is written where it stands: "
                f"write it, such as `{getattr(_DEFAULTS, name)}`."
            )
    for name in FIELDS:
        row: str | Mapping[str, str] = getattr(forms, name)
        for text in (row,) if isinstance(row, str) else row.values():
            yield from _form(name, text, forms)


def _form(name: str, text: str, forms: Forms) -> Iterator[str]:
    try:
        fields = {field for _text, field, _spec, _way in Formatter().parse(text) if field}
    except ValueError as error:
        yield f"has the form `{text}` in `Forms.{name}`, which cannot be read: {error}."
        return
    for field in sorted(fields - FIELDS[name]):
        known = ", ".join(f"`{{{each}}}`" for each in sorted(FIELDS[name]))
        yield (
            f"has the field `{{{field}}}` in `Forms.{name}`, which nothing fills in: there are "
            f"{known}, and a brace that is meant as such is doubled."
        )
    for one_of in NEEDED.get(name, ()) if text else ():
        if not fields & one_of:
            wanted = " or ".join(f"`{{{each}}}`" for each in sorted(one_of))
            yield f"leaves {wanted} out of `Forms.{name}`: write where it belongs in `{text}`."
    if name == "loop" and "count" not in fields and not forms.enough:
        yield (
            "leaves `{count}` out of `Forms.loop`: write it there, or write in `Forms.enough` the "
            "line that leaves a loop of `{bound}` turns behind the `{count}`."
        )


def _stages(language: Language, profile: Profile) -> Iterator[str]:
    """Missing forms and words of the stages: for emitting, dividing, sharing and storing texels."""
    forms, stages = language.forms, profile.stages
    if GEOMETRY in stages:
        for field in ("emit_vertex", "end_strip", "deliver_position", "position"):
            yield from _needed_form(field, forms, "its geometry stage")
    if CONTROL in stages:
        for field in ("edge_level", "inner_level"):
            yield from _needed_form(field, forms, "its control stage")
        yield from _words("patches", language.patches, get_args(Patch), "its control stage")
        yield from _words("spacings", language.spacings, get_args(Spacing), "its control stage")
    if COMPUTE in stages:
        for field in ("shared", "barrier"):
            yield from _needed_form(field, forms, "its compute stage")
        operators = get_args(ScatterOperator)
        yield from _words("atomics", language.atomics, operators, "its compute stage")
    if profile.image_formats:
        yield from _needed_form("store_texel", forms, "`Profile.image_formats`")
        formats = sorted(profile.image_formats)
        yield from _words("images", language.images, formats, "`Profile.image_formats`")


def _needed_form(name: str, forms: Forms, reason: str) -> Iterator[str]:
    if not getattr(forms, name):
        yield f"needs the form `Forms.{name}` for {reason}: write it in `Language.forms`."


def _words(
    row: str, table: Mapping[Name, str], names: Iterable[Name], reason: str
) -> Iterator[str]:
    for name in names:
        if name not in table:
            yield f"needs a word for `{name}` for {reason}: write it in `Language.{row}`."


def _uniforms(_language: Language, profile: Profile) -> Iterator[str]:
    """Missing limits of loose uniforms, which have no defaults."""
    for name in ("vertex_uniforms", "fragment_uniforms") if profile.loose_uniforms else ():
        if getattr(profile.limits, name) is None:
            yield (
                f"has loose uniforms, and does not say how many: write in `Limits.{name}` how many "
                "vectors of them every device has."
            )
