"""Shaders of a frame with equal texts share one file, which the reflection of each names."""

from __future__ import annotations

from functools import cache

import pytest

import burnish
from burnish.api.compiled import CompiledFrame

PROFILES = ("wgsl:webgpu", "glsl:es300", "hlsl:sm6")
TEXT = """
import std.shadows.{DepthOnly}

/// What pots are made of.
material Clay {
    param base : rgb = #c8763c      /// Fired
    color = base * uv.x
}
material Slate {
    param base : rgb = #6f8ba4      /// Split
    color = base * uv.x
}
material Ivy {
    param wind : float = 0.1        /// What moves it
    color    = #2c6e3a * uv.x
    position = inherited.position + wind * inherited.normal
}

frame Garden {
    models scene
    shadow = DepthOnly(scene, 256)
    lit    = Forward(scene)
    output picture = lit.color
    output depths  = shadow.depth
}
"""


@cache
def garden() -> CompiledFrame:
    (frame,) = burnish.compile(TEXT, PROFILES).frames
    return frame


def names(profile: str) -> dict[str, list[str]]:
    return {
        shader.name: [row.file for row in shader.reflection.backends[profile].files]
        for shader in garden().shaders
    }


def test_shaders_name_the_file_that_they_share() -> None:
    """Ivy moves, so its vertices are its own; the pass has no name for the others alone."""
    assert names("wgsl:webgpu") == {
        "Garden.DepthOnly.Clay": ["Garden.DepthOnly.Clay.vert.wgsl"],
        "Garden.DepthOnly.Slate": ["Garden.DepthOnly.Clay.vert.wgsl"],
        "Garden.DepthOnly.Ivy": ["Garden.DepthOnly.Ivy.vert.wgsl"],
        "Garden.Forward.Clay": ["Garden.Forward.Clay.vert.wgsl", "Garden.Forward.Clay.frag.wgsl"],
        "Garden.Forward.Slate": ["Garden.Forward.Clay.vert.wgsl", "Garden.Forward.Slate.frag.wgsl"],
        "Garden.Forward.Ivy": ["Garden.Forward.Ivy.vert.wgsl", "Garden.Forward.Ivy.frag.wgsl"],
    }


def test_a_text_of_all_shaders_of_a_pass_has_the_name_of_the_pass() -> None:
    """GLSL ES has fragments that do nothing, for all alike."""
    fragments = {files[1] for name, files in names("glsl:es300").items() if "DepthOnly" in name}
    assert fragments == {"Garden.DepthOnly.es300.frag.glsl"}


@pytest.mark.parametrize("profile", PROFILES)
def test_a_name_stands_for_one_text(profile: str) -> None:
    texts: dict[str, set[str]] = {}
    for shader in garden().shaders:
        for file in shader.files:
            texts.setdefault(file.name, set()).add(file.text)
    assert {name for name, found in texts.items() if len(found) > 1} == set()
    found = [
        next(iter(one)).partition("by Burnish.")[2].partition("\n\n")[2]
        for name, one in texts.items()
        if name.endswith({"wgsl": "wgsl", "glsl": "glsl", "hlsl": "hlsl"}[profile[:4]])
    ]
    assert len(set(found)) == len(found)


def test_the_text_says_whose_it_is() -> None:
    texts = {shader.name: shader.text("wgsl", "vertex") for shader in garden().shaders}
    clay, slate = (texts[f"Garden.DepthOnly.{name}"] for name in ("Clay", "Slate"))
    assert clay == slate
    assert clay.split("\n")[:3] == [
        "// Garden.DepthOnly.Clay: vertex shader, by Burnish.",
        "// It is that of Garden.DepthOnly.Clay and Garden.DepthOnly.Slate.",
        "",
    ]
    alone = texts["Garden.DepthOnly.Ivy"]
    assert alone.startswith("// Garden.DepthOnly.Ivy: vertex shader, by Burnish.\n\n")


def test_source_maps_count_the_lines_of_the_text_that_is_there() -> None:
    """The headers of the shared text and of each one's own have different lengths."""
    for shader in garden().shaders:
        for file in shader.files:
            lines = file.text.split("\n")
            assert file.spans or "DepthOnly" in file.name
            for number in file.spans:
                line = lines[number - 1].strip()
                assert line
                assert not line.startswith(("//", "struct", "@", "layout", "}"))


def test_materials_that_are_compiled_alone_keep_their_own_files() -> None:
    text = TEXT.partition("frame Garden")[0]
    found = [file.name for material in burnish.compile(text, "wgsl") for file in material.files]
    assert found == [
        f"{name}.{stage}.wgsl" for name in ("Clay", "Slate", "Ivy") for stage in ("vert", "frag")
    ]


def test_line_directives_say_whose_each_line_is() -> None:
    (frame,) = burnish.compile(TEXT, "glsl", line_directives=True).frames
    files = [file.name for shader in frame.shaders for file in shader.files]
    assert len(files) == len(set(files)) == 9
