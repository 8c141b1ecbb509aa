"""Draws materials of Burnish with moderngl: `python draw.py plastic plastic.png`.

`shaders.py` is written by `burnish bind`; README.md has the command. It has the texts of the
shaders, too, so that both always fit together.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import moderngl
import numpy as np
import shaders
from PIL import Image

SCENE = json.loads((Path(__file__).parent / "scene.json").read_text(encoding="utf-8"))
SIZE = tuple(SCENE["size"])
PROFILE = "glsl:gl330"
SRGB8_ALPHA8 = 0x8C43
"""The format of colours that are encoded as sRGB, as OpenGL calls it."""
FRAMEBUFFER_SRGB = 0x8DB9
FORMATS = {
    "float32x2": (np.float32, "2f"),
    "float32x3": (np.float32, "3f"),
    "float32x4": (np.float32, "4f"),
    "uint32x4": (np.uint32, "4u"),
}
"""The types of numbers and the words of moderngl for formats of vertex inputs."""


def matrix(numbers: Sequence[float]) -> list[Sequence[float]]:
    """The columns of a matrix."""
    return [numbers[at : at + 4] for at in range(0, 16, 4)]


# -- what is drawn ---------------------------------------------------------------------------------


def view() -> shaders.View:
    """The camera."""
    camera = SCENE["camera"]
    return shaders.View(view_projection=matrix(camera["view_projection"]), eye=camera["eye"])


def plastic(context: moderngl.Context) -> None:
    """A ball with lights of all kinds and a texture."""
    scene = SCENE["scenes"]["plastic"]
    lights, (model,) = scene["lights"], scene["models"]
    rig = shaders.Rig(
        sun_direction=lights["sun"]["direction"],
        lamps=[shaders.Point(**lamp) for lamp in lights["lamps"]],
        torch_place=lights["torch"]["place"],
        torch_axis=lights["torch"]["axis"],
    )
    draw = shaders.Draw(object_to_world=matrix(model["object_to_world"]))
    blocks = (
        view(),
        rig,
        shaders.derive_rig(rig),
        shaders.PlasticMaterial(),
        draw,
        shaders.derive_draw(draw),
    )
    albedo = picture(context, SCENE["pictures"]["tiles"], SRGB8_ALPHA8)
    draw_material(context, shaders.PLASTIC, blocks, {"albedo": albedo}, model["mesh"])


def banner(context: moderngl.Context) -> None:
    """A cloth that bones bend, with a normal map."""
    scene = SCENE["scenes"]["banner"]
    (model,) = scene["models"]
    rig = shaders.BannerRig(sun_direction=scene["lights"]["sun"]["direction"])
    draw = shaders.BannerDraw(
        object_to_world=matrix(model["object_to_world"]), bones=list(map(matrix, SCENE["bones"]))
    )
    blocks = (view(), rig, shaders.BannerMaterial(), draw, shaders.derive_banner_draw(draw))
    threads = picture(context, SCENE["pictures"]["threads"], None)
    draw_material(context, shaders.BANNER, blocks, {"normal_map": threads}, model["mesh"])


# -- glue ------------------------------------------------------------------------------------------


def draw_material(
    context: moderngl.Context, material: shaders.Material, blocks: Sequence[shaders.Block],
    textures: Mapping[str, moderngl.Texture], mesh: str,
) -> None:  # fmt: skip
    """Draw a mesh: the tables of the binding say what is bound by which name of the text."""
    profile = material.profiles[PROFILE]
    texts = {text.stage: text.text or "" for text in profile.texts}
    program = context.program(vertex_shader=texts["vertex"], fragment_shader=texts["fragment"])
    given = {type(block): bytes(block) for block in blocks}
    for number, bound in enumerate(profile.bound):
        program[bound.identifier] = number
        if bound.block is not None:
            context.buffer(given[bound.block]).bind_to_uniform_block(number)
        else:
            textures[bound.name].use(number)
    context.vertex_array(program, *geometry(context, mesh, material)).render()


# -- end of glue -----------------------------------------------------------------------------------


def geometry(
    context: moderngl.Context, mesh: str, material: shaders.Material
) -> tuple[list[tuple[moderngl.Buffer, str, str]], moderngl.Buffer]:
    """The buffer, format and name of each vertex input, and the buffer of the triangles.

    A mesh calls what the text has as `vertex_normal` its `normal`.
    """
    found = []
    for row in material.vertex_inputs:
        values = SCENE["meshes"][mesh][row.name.removeprefix("vertex_")]
        kind, format_ = FORMATS[row.format or ""]
        found.append((context.buffer(np.array(values, kind)), format_, row.name))
    return found, context.buffer(np.array(SCENE["meshes"][mesh]["indices"], np.uint32))


def picture(
    context: moderngl.Context, image: Mapping[str, Any], internal_format: int | None
) -> moderngl.Texture:
    """A texture with a picture, which is smooth and repeats."""
    data = np.array(image["rgba"], np.uint8)
    size = (image["width"], image["height"])
    texture = context.texture(size, 4, data, internal_format=internal_format)
    texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
    return texture


DRAWN = {"plastic": plastic, "banner": banner}


def main(arguments: Sequence[str]) -> None:
    """Draw what the first argument names to the file that the second one names."""
    if len(arguments) != 2:
        sys.exit("usage: python draw.py plastic|banner OUTPUT.png")
    name, output = arguments
    if name not in DRAWN:
        sys.exit(f"there is no scene `{name}`: there are {', '.join(DRAWN)}")
    # On Linux, "egl" needs no window; elsewhere, leave the backend out.
    backend: dict[str, Any] = {"backend": "egl"} if sys.platform == "linux" else {}
    context = moderngl.create_context(standalone=True, require=330, **backend)
    colors = context.texture(SIZE, 4, internal_format=SRGB8_ALPHA8)
    framebuffer = context.framebuffer([colors], context.depth_renderbuffer(SIZE))
    framebuffer.use()
    framebuffer.clear(0.0, 0.0, 0.0, 1.0)
    context.enable(moderngl.DEPTH_TEST)
    context.enable_direct(FRAMEBUFFER_SRGB)
    DRAWN[name](context)
    image = Image.frombytes("RGB", SIZE, framebuffer.read())
    image.transpose(Image.Transpose.FLIP_TOP_BOTTOM).save(output)


if __name__ == "__main__":
    main(sys.argv[1:])
