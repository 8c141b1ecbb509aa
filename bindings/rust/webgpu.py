"""The tables of a binding in the types of the crate ``wgpu``, for hosts that have it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ...compiler.documents.writing import to_json
from ..model import Bound, Material
from ..naming import pascal
from ..spelling import Spelling

PROFILE = "wgsl:webgpu"
_SAMPLES = {
    "float": "Float { filterable: true }",
    "unfilterable-float": "Float { filterable: false }",
    "depth": "Depth", "uint": "Uint", "sint": "Sint",
}  # fmt: skip
_DIMENSIONS = {
    "1d": "D1", "2d": "D2", "2d-array": "D2Array", "3d": "D3", "cube": "Cube",
    "cube-array": "CubeArray",
}  # fmt: skip


def groups(spelling: Spelling, material: Material) -> list[list[str]]:
    """The entries of each bind group of a material's WGSL; none without such texts."""
    bound = [row for each in material.profiles if each.name == PROFILE for row in each.bound]
    last = max((row.group or 0 for row in bound), default=-1)
    found: list[list[str]] = [[] for _ in range(last + 1)]
    for row in bound:
        stages = ".union(".join(f"ShaderStages::{stage.upper()}" for stage in row.stages)
        stages += ")" * (len(row.stages) - 1)
        found[row.group or 0].append(
            f"entry({row.binding}, {stages}, {_type(spelling, material, row)})"
        )
    return found


def _type(spelling: Spelling, material: Material, row: Bound) -> str:
    """The call of the skeleton's that makes the type of what is bound."""
    if row.kind == "uniform":
        size = "0" if row.is_shared else f"size_of::<{spelling.type(row.name)}>()"
        return f"uniform({size})"
    if row.kind in ("storage", "result"):
        return f"storage({str(row.type == 'read-only-storage').lower()})"
    if row.kind == "image":
        (target,) = [each for each in material.reflection.targets if each.name == row.name]
        return f"image(TextureFormat::{_format(to_json(target)['format'])})"
    if row.kind == "sampler":
        return f"BindingType::Sampler(SamplerBindingType::{_words(row.type)})"
    dimension = _DIMENSIONS[_layouts(material)[row.name]["viewDimension"]]
    sample = _SAMPLES[row.type]
    return f"texture(TextureSampleType::{sample}, TextureViewDimension::{dimension})"


def _layouts(material: Material) -> Mapping[str, Any]:
    return {each.name: to_json(each.layout) for each in material.reflection.textures}


def _format(name: str) -> str:
    """The name of a format: ``Rgba8UnormSrgb`` of ``rgba8unorm-srgb``."""
    head = name.rstrip("abcdefghijklmnopqrstuvwxyz-")
    return pascal([head, *name[len(head) :].split("-")])


def _words(name: str) -> str:
    return pascal(name.split("-"))


def vertex_buffers(material: Material) -> Iterator[str]:
    """The layouts of vertex buffers, with a buffer for each input."""
    for row in material.reflection.vertex_inputs:
        if row.format is not None and row.location is not None:
            lanes = int(row.format.partition("x")[2] or 1)
            yield (
                f"buffer({4 * lanes}, VertexStepMode::{row.step.capitalize()}, "
                f"&[attribute({row.location}, VertexFormat::{row.format.capitalize()})])"
            )
