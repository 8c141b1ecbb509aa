"""Draws materials of Burnish with moderngl: `python draw.py plastic plastic.png`.

`shaders.py` is written by `burnish bind`; README.md has the command. It has the texts of the
shaders, too, so that both always fit together.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping, Sequence
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
INTERNAL_FORMATS = {"rgba8unorm-srgb": SRGB8_ALPHA8}
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
    rig = shaders.StudioRig(
        sun_direction=lights["sun"]["direction"],
        lamps=[shaders.Point(**lamp) for lamp in lights["lamps"]],
        torch_place=lights["torch"]["place"],
        torch_axis=lights["torch"]["axis"],
    )
    draw = shaders.Draw(object_to_world=matrix(model["object_to_world"]))
    blocks = shaders.PlasticBlocks(view=view(), rig=rig, draw=draw)
    albedo = picture(context, SCENE["pictures"]["tiles"], SRGB8_ALPHA8)
    draw_material(context, shaders.PLASTIC, blocks, {"albedo": albedo}, model["mesh"])


def banner(context: moderngl.Context) -> None:
    """A cloth that bones bend, with a normal map."""
    scene = SCENE["scenes"]["banner"]
    (model,) = scene["models"]
    rig = shaders.DaylightRig(sun_direction=scene["lights"]["sun"]["direction"])
    draw = shaders.BannerDraw(
        object_to_world=matrix(model["object_to_world"]), bones=list(map(matrix, SCENE["bones"]))
    )
    blocks = shaders.BannerBlocks(view=view(), rig=rig, draw=draw)
    threads = picture(context, SCENE["pictures"]["threads"], None)
    draw_material(context, shaders.BANNER, blocks, {"normal_map": threads}, model["mesh"])


def shadows(context: moderngl.Context) -> bytes:
    """Two balls on a floor, and a lamp with a shadow map."""
    lamp = SCENE["scenes"]["shadows"]["lights"]["lamp"]
    host = Frames(context)
    shaders.draw_shadows(
        host,
        shaders.ShadowsParameters(
            size=SIZE, lamp_place=lamp["place"], lamp_axis=lamp["axis"], spread=1.0
        ),
    )
    output = shaders.SHADOWS_FRAME.outputs["picture"]
    return context.framebuffer([host.textures[output.number]]).read()


# -- glue ------------------------------------------------------------------------------------------


def draw_material(
    context: moderngl.Context, material: shaders.Material, blocks: shaders.Blocks,
    textures: Mapping[str, moderngl.Texture], mesh: str,
) -> None:  # fmt: skip
    """Draw a mesh: the tables of the binding say what is bound by which name of the text."""
    profile = material.profiles[PROFILE]
    texts = {text.stage: text.text or "" for text in profile.texts}
    program = context.program(vertex_shader=texts["vertex"], fragment_shader=texts.get("fragment"))
    given = {type(block): bytes(block) for block in blocks.all()}
    for number, bound in enumerate(profile.bound):
        program[bound.identifier] = number
        if bound.block is not None:
            context.buffer(given[bound.block]).bind_to_uniform_block(number)
        else:
            textures[bound.name].use(number)
    context.vertex_array(program, *geometry(context, mesh, material)).render(moderngl.TRIANGLES)


# -- end of glue -----------------------------------------------------------------------------------


# -- an engine for frames --------------------------------------------------------------------------


class Frames(shaders.FrameHost):
    """Does what a frame asks for, as far as the frame of this program needs it."""

    def __init__(self, context: moderngl.Context) -> None:
        self.context = context
        self.textures: list[moderngl.Texture] = []

    def begin(
        self, frame: shaders.Frame, sizes: Sequence[Sequence[int]], counts: Sequence[int]
    ) -> bool:
        rows = zip(frame.textures, sizes, strict=True)
        self.textures = [self.texture(row, (size[0], size[1])) for row, size in rows]
        return False

    def texture(self, row: shaders.FrameTexture, size: tuple[int, int]) -> moderngl.Texture:
        if (row.dimension, row.levels, row.samples) != ("2d", 1, 1):
            raise NotImplementedError(f"`{row.name}` is no plain texture of two dimensions")
        if row.format.startswith("depth"):
            texture = self.context.depth_texture(size)
            texture.repeat_x = texture.repeat_y = False
            return texture
        return self.context.texture(size, 4, internal_format=INTERNAL_FORMATS[row.format])

    def begin_pass(self, pass_: shaders.Pass) -> None:
        colors = [self.textures[each.texture] for each in pass_.targets]
        depth = None if pass_.depth is None else self.textures[pass_.depth.texture]
        framebuffer = self.context.framebuffer(colors, depth)
        framebuffer.use()
        for each in (*pass_.targets, *((pass_.depth,) if pass_.depth else ())):
            if each.load != "clear":
                raise NotImplementedError(f"`{pass_.name}` draws over what is there")
        framebuffer.clear(depth=1.0)

    def draw_models(self, tag: str, uses: Sequence[shaders.Use]) -> None:
        by_material = {use.material: use for use in uses}
        camera = SCENE["camera"]
        roles = {"world_to_clip": matrix(camera["view_projection"]), "eye": camera["eye"]}
        for model in SCENE["scenes"]["shadows"]["models"]:
            use = by_material[model["material"]]
            blocks = use.shader.blocks()
            blocks.set_roles({**roles, "object_to_world": matrix(model["object_to_world"])})
            use.give(blocks)
            read = {name: self.textures[source.number] for name, source in use.reads.items()}
            draw_material(self.context, use.shader, blocks, read, model["mesh"])

    def fill(self, use: shaders.Use, vertices: int) -> None:
        raise NotImplementedError("this engine draws models only")

    def end_pass(self) -> None:
        """Nothing is left to do."""

    def dispatch(
        self, use: shaders.Use, groups: Sequence[int], images: Mapping[str, int],
        buffers: Mapping[str, int],
    ) -> None:  # fmt: skip
        raise NotImplementedError("OpenGL 3.3 runs no kernels")

    def copy(self, source: int, target: int) -> None:
        raise NotImplementedError("this engine copies no textures")

    def end(self, frame: shaders.Frame) -> None:
        """This engine keeps nothing for the next frame."""


# -- meshes and pictures ---------------------------------------------------------------------------


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


def draw_alone(context: moderngl.Context, draw: Callable[[moderngl.Context], None]) -> bytes:
    """Draw a material in a pass of its own; returns the rows of the picture from the top."""
    colors = context.texture(SIZE, 4, internal_format=SRGB8_ALPHA8)
    framebuffer = context.framebuffer([colors], context.depth_renderbuffer(SIZE))
    framebuffer.use()
    framebuffer.clear(depth=1.0)
    draw(context)
    rows = np.frombuffer(framebuffer.read(), np.uint8).reshape(SIZE[1], -1)
    return rows[::-1].tobytes()


DRAWN: Mapping[str, Callable[[moderngl.Context], bytes]] = {
    "plastic": lambda context: draw_alone(context, plastic),
    "banner": lambda context: draw_alone(context, banner),
    "shadows": shadows,
}


def main(arguments: Sequence[str]) -> None:
    """Draw what the first argument names to the file that the second one names."""
    if len(arguments) != 2:
        sys.exit(f"usage: python draw.py {'|'.join(DRAWN)} OUTPUT.png")
    name, output = arguments
    if name not in DRAWN:
        sys.exit(f"there is no scene `{name}`: there are {', '.join(DRAWN)}")
    # On Linux, "egl" needs no window; elsewhere, leave the backend out.
    backend: dict[str, Any] = {"backend": "egl"} if sys.platform == "linux" else {}
    context = moderngl.create_context(standalone=True, require=330, **backend)
    context.enable(moderngl.DEPTH_TEST)
    context.enable_direct(FRAMEBUFFER_SRGB)
    Image.frombytes("RGB", SIZE, DRAWN[name](context)).save(output)


if __name__ == "__main__":
    main(sys.argv[1:])
