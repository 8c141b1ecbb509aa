"""Gaps in the description of a language are reported when it is loaded, a sentence for each."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from burnish.compiler.ir.stages import RASTERISED
from burnish.support.frozen import changed
from burnish.targets import registry
from burnish.targets.description.faults import LanguageError, check, faults
from burnish.targets.description.forms import Forms
from burnish.targets.description.profile import Limits, Profile
from burnish.targets.description.shading_language import Language
from burnish.targets.description.spellings import TextureNames

from .test_new_language import LANGUAGE, SKELETON, installed

GLSL = registry.load("glsl")
ES100 = GLSL.profile("es100")
VULKAN = GLSL.profile("vulkan")


def with_profile(profile: Profile, **changes: Any) -> Language:
    """GLSL with one profile only, in which some rows are others."""
    return changed(GLSL, profiles=(changed(profile, **changes),))


def with_rows(profile: Profile = VULKAN, **changes: Any) -> Language:
    """GLSL with one profile only, and other rows of its own."""
    return changed(GLSL, profiles=(profile,), **changes)


def with_form(**forms: Any) -> Language:
    return with_rows(forms=changed(GLSL.forms, **forms))


def without(table: Mapping[Any, Any], key: object) -> dict[Any, Any]:
    return {other: row for other, row in table.items() if other != key}


PLANTED: Mapping[str, tuple[Language, str]] = {
    "a builtin that there is not": (
        with_profile(ES100, cannot=frozenset({"rond"})),
        "glsl:es100 names `rond` in `Profile.cannot`, which is no builtin: write the name of a "
        "row of `stdlib/builtins`.",
    ),
    "a spelling of what is no builtin": (
        with_rows(natives={"lerp": "mix"}),
        "glsl:vulkan names `lerp` in `Language.natives`, which is no builtin: write the name of "
        "a row of `stdlib/builtins`.",
    ),
    "an empty form": (
        with_form(let=""),
        "glsl leaves `Forms.let` empty, and then nothing is written where it stands: write it, "
        "such as `{typed} = {value};`.",
    ),
    "lacked, and not defined": (
        with_profile(ES100, lacks=frozenset({"refract"})),
        "glsl:es100 lacks `refract`, which has no definition: give its row in `stdlib/builtins` "
        "a `definition`, or name it in `Profile.cannot` instead of `Profile.lacks`.",
    ),
    "agreed about in vain": (
        with_profile(ES100, agrees={"floor": lambda _facts: True}),
        "glsl:es100 says in `Profile.agrees` for which operands it has `floor`, and nothing is "
        "used for the others: give the row in `stdlib/builtins` a `definition`.",
    ),
    "an input that may be refused": (
        with_rows(ES100, inputs=without(GLSL.inputs, "vertex_index")),
        "",
    ),
    "an input that is neither spelled nor refused": (
        with_rows(
            changed(ES100, without_inputs=frozenset({"view_index"})),
            inputs=without(without(GLSL.inputs, "instance_index"), "vertex_index"),
        ),
        "glsl:es100 does not say how `vertex_index` is read, which varies over vertex: write a "
        "`PipelineInput` for it in `Language.inputs` or `Profile.inputs`, or name it in "
        "`Profile.without_inputs`.\n"
        "glsl:es100 does not say how `instance_index` is read, which varies over instance: write "
        "a `PipelineInput` for it in `Language.inputs` or `Profile.inputs`, or name it in "
        "`Profile.without_inputs`.",
    ),
    "an input that every profile has": (
        with_rows(changed(ES100, framebuffer=VULKAN.framebuffer),
                  inputs=without(GLSL.inputs, "frag_coord")),
        "glsl:es100 does not say how `frag_coord` is read, which varies over fragment: write a "
        "`PipelineInput` for it in `Language.inputs` or `Profile.inputs`.",
    ),
    "an input that no message refuses": (
        with_profile(ES100, without_inputs=frozenset({"front_facing", "view_index"})),
        "glsl:es100 refuses `front_facing` in `Profile.without_inputs`, and no message says so: "
        "add its need to `OF_INPUTS` in `targets/description/capabilities.py`.",
    ),
    "a kind of scalars": (
        with_rows(types=changed(GLSL.types, scalars=without(GLSL.types.scalars, "bool"))),
        "glsl:vulkan has no scalars of kind `bool`: write their type in `TypeNames.scalars`.",
    ),
    "a kind of vectors that bools are stored as": (
        with_profile(ES100, types=changed(ES100.types, vectors=without(
            ES100.types.vectors if ES100.types else {}, "uint"))),
        "glsl:es100 has no vectors of kind `uint`: write their type in `TypeNames.vectors`. "
        "Bools are stored as such, so a type of integers will do.",
    ),
    "a dimension": (
        with_rows(textures=changed(
            GLSL.textures, dimensions=without(GLSL.textures.dimensions, "cube"))),
        "glsl:vulkan has no word for the dimension `cube` of `depth_cube`: write it in "
        "`TextureNames.dimensions`, or leave `depth_cube` out of `Profile.textures`.\n"
        "glsl:vulkan has no word for the dimension `cube` of `texture_cube`: write it in "
        "`TextureNames.dimensions`, or leave `texture_cube` out of `Profile.textures`.",
    ),
    "what textures hold": (
        with_rows(ES100, textures=TextureNames({"2d": "2D", "cube": "Cube"}, {}, {})),
        "glsl:es100 has no type for `texture2d`: write one for `float` in "
        "`TextureNames.combined`, or leave `texture2d` out of `Profile.textures`.\n"
        "glsl:es100 has no type for `texture_cube`: write one for `float` in "
        "`TextureNames.combined`, or leave `texture_cube` out of `Profile.textures`.",
    ),
    "a form that cannot be read": (
        with_form(if_="if ({condition}) {"),
        "glsl has the form `if ({condition}) {` in `Forms.if_`, which cannot be read: Single "
        "'{' encountered in format string.",
    ),
    "a field that nothing fills in": (
        with_form(return_="return {value} as {type};"),
        "glsl has the field `{type}` in `Forms.return_`, which nothing fills in: there are "
        "`{value}`, and a brace that is meant as such is doubled.",
    ),
    "a field that is left out": (
        with_form(assign="{name} = 0;"),
        "glsl leaves `{value}` out of `Forms.assign`: write where it belongs in `{name} = 0;`.",
    ),
    "one of two fields": (
        with_form(let="auto = {value};"),
        "glsl leaves `{name}` or `{typed}` out of `Forms.let`: write where it belongs in "
        "`auto = {value};`.",
    ),
    "a loop that does not end where it should": (
        with_form(loop="for ({index_typed} = 0; {index} < {bound}; {index}++) {{"),
        "glsl leaves `{count}` out of `Forms.loop`: write it there, or write in `Forms.enough` "
        "the line that leaves a loop of `{bound}` turns behind the `{count}`.",
    ),
    "a loop that is left": (
        with_form(
            loop="for ({index_typed} = 0; {index} < {bound}; {index}++) {{",
            enough="if ({index} >= {count}) {{ break; }}",
        ),
        "",
    ),
    "the words of a stage": (
        with_form(emit_vertex=""),
        "glsl:vulkan needs the form `Forms.emit_vertex` for its geometry stage: write it in "
        "`Language.forms`.",
    ),
    "a word for patches": (
        with_rows(patches=without(GLSL.patches, "quad")),
        "glsl:vulkan needs a word for `quad` for its control stage: write it in "
        "`Language.patches`.",
    ),
    "an atomic function": (
        with_rows(atomics=without(GLSL.atomics, "max")),
        "glsl:vulkan needs a word for `max` for its compute stage: write it in "
        "`Language.atomics`.",
    ),
    "a format of images": (
        with_rows(images=without(GLSL.images, "r32f")),
        "glsl:vulkan needs a word for `r32f` for `Profile.image_formats`: write it in "
        "`Language.images`.",
    ),
    "forms of stages that the profile has not got": (
        with_rows(
            changed(VULKAN, stages=RASTERISED, image_formats=frozenset()),
            forms=Forms(), patches={}, spacings={}, atomics={}, images={},
        ),
        "",
    ),
    "a number of uniforms": (
        with_profile(ES100, limits=changed(ES100.limits, fragment_uniforms=Limits().groups)),
        "glsl:es100 has loose uniforms, and does not say how many: write in "
        "`Limits.fragment_uniforms` how many vectors of them every device has.",
    ),
}  # fmt: skip
"""Languages that leave something out, or do not, and all that is said of them."""


@pytest.mark.parametrize("planted", PLANTED)
def test_faults(planted: str) -> None:
    language, said = PLANTED[planted]
    assert "\n".join(faults(language)) == said


@pytest.mark.parametrize("name", registry.names())
def test_languages_have_none(name: str) -> None:
    check(registry.load(name))


def test_a_language_is_checked_when_it_is_loaded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    left_out = LANGUAGE.replace('"instance_index": PipelineInput(', '"copies": PipelineInput(')
    left_out = left_out.replace('"3d": "solid", ', "")
    name = installed(tmp_path, monkeypatch, left_out, SKELETON)
    with pytest.raises(LanguageError) as caught:
        registry.load(name)
    assert str(caught.value).splitlines() == [
        "ledger:only does not say how `instance_index` is read, which varies over instance: write "
        "a `PipelineInput` for it in `Language.inputs` or `Profile.inputs`, or name it in "
        "`Profile.without_inputs`.",
        *(
            f"ledger:only has no word for the dimension `3d` of `{type_}`: write it in "
            f"`TextureNames.dimensions`, or leave `{type_}` out of `Profile.textures`."
            for type_ in ("itexture3d", "texture3d", "utexture3d")
        ),
    ]
