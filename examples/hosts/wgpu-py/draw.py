"""Draws materials of Burnish with wgpu: `python draw.py plastic plastic.png`.

`shaders.py` is written by `burnish bind`; README.md has the command. It has the texts of the
shaders, too, so that both always fit together.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import shaders
import wgpu
from PIL import Image

SCENE = json.loads((Path(__file__).parent / "scene.json").read_text(encoding="utf-8"))
SIZE = tuple(SCENE["size"])
DEPTHS = "depth32float"


def matrix(numbers: Sequence[float]) -> list[Sequence[float]]:
    """The columns of a matrix."""
    return [numbers[at : at + 4] for at in range(0, 16, 4)]


# -- what is drawn ---------------------------------------------------------------------------------


def view() -> shaders.View:
    """The camera."""
    camera = SCENE["camera"]
    return shaders.View(view_projection=matrix(camera["view_projection"]), eye=camera["eye"])


def plastic(device: Any, drawing: Any) -> None:
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
    albedo = picture(device, SCENE["pictures"]["tiles"], "rgba8unorm-srgb")
    draw_material(device, drawing, shaders.PLASTIC, blocks, {"albedo": albedo}, model["mesh"])


def banner(device: Any, drawing: Any) -> None:
    """A cloth that bones bend, with a normal map."""
    scene = SCENE["scenes"]["banner"]
    (model,) = scene["models"]
    rig = shaders.DaylightRig(sun_direction=scene["lights"]["sun"]["direction"])
    draw = shaders.BannerDraw(
        object_to_world=matrix(model["object_to_world"]), bones=list(map(matrix, SCENE["bones"]))
    )
    blocks = shaders.BannerBlocks(view=view(), rig=rig, draw=draw)
    threads = picture(device, SCENE["pictures"]["threads"], "rgba8unorm")
    draw_material(device, drawing, shaders.BANNER, blocks, {"normal_map": threads}, model["mesh"])


def shadows(device: Any) -> Any:
    """Two balls on a floor, and a lamp with a shadow map; returns the picture's texture."""
    lamp = SCENE["scenes"]["shadows"]["lights"]["lamp"]
    host = Frames(device)
    shaders.draw_shadows(
        host,
        shaders.ShadowsParameters(
            size=SIZE, lamp_place=lamp["place"], lamp_axis=lamp["axis"], spread=1.0
        ),
    )
    return host.output("picture")


# -- glue ------------------------------------------------------------------------------------------


def draw_material(
    device: Any, drawing: Any, material: shaders.Material, blocks: shaders.Blocks,
    textures: Mapping[str, Any], mesh: str,
) -> None:  # fmt: skip
    """Draw a mesh in a render pass: the binding makes the pipeline, and binds all by its tables."""
    drawing.set_pipeline(shaders.render_pipeline(device, material, depth_format=DEPTHS))
    uniforms = shaders.uniform_buffers(device, *blocks.all())
    for number, group in enumerate(shaders.bind_groups(device, material, uniforms, textures)):
        drawing.set_bind_group(number, group)
    draw_mesh(device, drawing, material, mesh)


def draw_mesh(device: Any, drawing: Any, material: shaders.Material, mesh: str) -> None:
    """Set the buffers of a mesh, one for each vertex input, and draw it."""
    for number, row in enumerate(material.vertex_inputs):
        drawing.set_vertex_buffer(number, vertices(device, mesh, row))
    drawing.set_index_buffer(indices(device, mesh), "uint32")
    drawing.draw_indexed(len(SCENE["meshes"][mesh]["indices"]))


# -- end of glue -----------------------------------------------------------------------------------
# -- glue for frames -------------------------------------------------------------------------------


class Frames(shaders.WgpuFrameHost):
    """What the binding's host of frames does not know: models, their values and meshes."""

    def models(self, tag: str) -> Sequence[Any]:
        scene: dict[str, list[Any]] = {"scene": SCENE["scenes"]["shadows"]["models"]}
        return scene[tag]

    def material(self, model: Any) -> str:
        return str(model["material"])

    def set_blocks(self, blocks: shaders.Blocks, model: Any) -> None:
        camera, place = SCENE["camera"], model["object_to_world"]
        roles = {"world_to_clip": matrix(camera["view_projection"]), "eye": camera["eye"]}
        blocks.set_roles({**roles, "object_to_world": matrix(place)})

    def draw_mesh(self, drawing: Any, shader: shaders.Material, model: Any) -> None:
        draw_mesh(self.device, drawing, shader, model["mesh"])


# -- end of glue -----------------------------------------------------------------------------------


def vertices(device: Any, mesh: str, row: shaders.VertexInput) -> Any:
    """The buffer of a vertex input: `vertex_normal` is the mesh's `normal`."""
    values = SCENE["meshes"][mesh][row.name.removeprefix("vertex_")]
    kind = np.uint32 if (row.format or "").startswith("uint") else np.float32
    return device.create_buffer_with_data(data=np.array(values, kind), usage="VERTEX")


def indices(device: Any, mesh: str) -> Any:
    """The buffer of the triangles of a mesh."""
    values = np.array(SCENE["meshes"][mesh]["indices"], np.uint32)
    return device.create_buffer_with_data(data=values, usage="INDEX")


def picture(device: Any, image: Mapping[str, Any], format_: str) -> Any:
    """The view of a texture with a picture."""
    size = (image["width"], image["height"], 1)
    usage = wgpu.TextureUsage.TEXTURE_BINDING | wgpu.TextureUsage.COPY_DST
    texture = device.create_texture(size=size, format=format_, usage=usage)
    data = np.array(image["rgba"], np.uint8)
    layout = {"bytes_per_row": 4 * image["width"], "rows_per_image": image["height"]}
    device.queue.write_texture({"texture": texture}, data, layout, size)
    return texture.create_view()


def attachments(device: Any, target: Any) -> dict[str, Any]:
    """The colours and the depths to which a pass draws, cleared."""
    usage = wgpu.TextureUsage.RENDER_ATTACHMENT
    depths = device.create_texture(size=target.size, format=DEPTHS, usage=usage)
    once = {"load_op": "clear", "store_op": "store"}
    return {
        "color_attachments": [{"view": target.create_view(), "clear_value": (0, 0, 0, 1), **once}],
        "depth_stencil_attachment": {
            "view": depths.create_view(),
            "depth_load_op": "clear",
            "depth_clear_value": 1.0,
            "depth_store_op": "discard",
        },
    }


def draw_alone(device: Any, draw: Callable[[Any, Any], None]) -> Any:
    """Draw a material in a pass of its own; returns the picture's texture."""
    usage = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.COPY_SRC
    target = device.create_texture(size=(*SIZE, 1), format="rgba8unorm-srgb", usage=usage)
    encoder = device.create_command_encoder()
    drawing = encoder.begin_render_pass(**attachments(device, target))
    draw(device, drawing)
    drawing.end()
    device.queue.submit([encoder.finish()])
    return target


DRAWN: Mapping[str, Callable[[Any], Any]] = {
    "plastic": lambda device: draw_alone(device, plastic),
    "banner": lambda device: draw_alone(device, banner),
    "shadows": shadows,
}


def main(arguments: Sequence[str]) -> None:
    """Draw what the first argument names to the file that the second one names."""
    if len(arguments) != 2:
        sys.exit(f"usage: python draw.py {'|'.join(DRAWN)} OUTPUT.png")
    name, output = arguments
    if name not in DRAWN:
        sys.exit(f"there is no scene `{name}`: there are {', '.join(DRAWN)}")
    device = wgpu.gpu.request_adapter_sync().request_device_sync()
    picture_of = DRAWN[name](device)
    layout = {"bytes_per_row": 4 * SIZE[0], "rows_per_image": SIZE[1]}
    data = device.queue.read_texture({"texture": picture_of}, layout, (*SIZE, 1))
    pixels = np.frombuffer(data, np.uint8).reshape(SIZE[1], SIZE[0], 4)
    Image.fromarray(pixels[..., :3].copy()).save(output)


if __name__ == "__main__":
    main(sys.argv[1:])
