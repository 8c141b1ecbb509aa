"""A small lit material as every part before the reflection would leave it."""

from __future__ import annotations

from burnish.compiler.diagnostics.source import Source, Span
from burnish.compiler.documents.backends import (
    BackendRow,
    BindingRow,
    BlockBindingRow,
    FileRow,
    VertexInputNameRow,
)
from burnish.compiler.ir.build import constant
from burnish.compiler.ir.leaves import Attribute, Parameter, Texture
from burnish.compiler.ir.node import Graph, Node
from burnish.compiler.ir.program import (
    Field,
    Interface,
    Output,
    Program,
    Stage,
    TextureRead,
    Varying,
)
from burnish.compiler.ir.shader import (
    AttributeInfo,
    ConstantValue,
    LightInfo,
    Notes,
    ParameterInfo,
    RenderTarget,
    Result,
    Shader,
    TextureInfo,
)
from burnish.compiler.ir.stages import CLIP_POSITION, FRAGMENT, TARGET, VARYING, VERTEX
from burnish.compiler.ir.statements import Region
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    UINT,
    VEC2,
    VEC3,
    VEC4,
    Array,
    Struct,
    TextureType,
)
from burnish.compiler.layout import layout_blocks
from burnish.support.frozen import changed

HERE = Span(Source("lit.burnish", ""), 0, 0)

POINT = Struct("Point", (("place", VEC3), ("reach", FLOAT), ("on", BOOL)))

POWER = Parameter("power", FLOAT, "material")
SHINE = Parameter("shine", VEC3, "material")
AXIS = Parameter("torch.axis", VEC3, "rig")
OUTER = Parameter("torch.outer", FLOAT, "rig")
LAMPS = Parameter("lamps", Array(POINT, 8), "rig")
COUNT = Parameter("lamps.count", UINT, "rig")
COS_OUTER = Parameter("torch.cos_outer", FLOAT, "rig", derived=True)
TIME = Parameter("time", FLOAT, "frame")
"""Declared, but nothing reads its block."""

ALBEDO = Texture(
    "albedo",
    TextureType(),
    "material",
    state=(("filter", "linear"), ("mip", "linear"), ("wrap", "repeat")),
)
UV = Attribute("uv", VEC2)


def _info(
    parameter: Parameter,
    declared: str,
    doc: str = "",
    *,
    default: ConstantValue | None = None,
    range_: tuple[float, float] | None = None,
    members: tuple[ParameterInfo, ...] = (),
    light: LightInfo | None = None,
) -> ParameterInfo:
    return ParameterInfo(parameter, declared, doc, HERE, range_, default, members, light)


_TORCH = LightInfo("torch", "torch", "Spot", "std.lights.Spot", "Over the table.")
_LAMPS = LightInfo("lamps", "lamps", "Lamp", "", "")

PARAMETERS = (
    _info(TIME, "float", "Seconds since the start."),
    _info(AXIS, "direction<world>", default=(0.0, -1.0, 0.0), light=_TORCH),
    _info(OUTER, "angle", default=0.5, light=_TORCH),
    _info(
        LAMPS,
        "Point[8]",
        "Lamps on the ceiling.",
        light=_LAMPS,
        members=(
            _info(Parameter("place", VEC3, "rig"), "point<world>", "Where it hangs."),
            _info(Parameter("reach", FLOAT, "rig"), "float", range_=(0.0, 50.0), default=10.0),
            _info(Parameter("on", BOOL, "rig"), "bool", default=True),
        ),
    ),
    _info(COUNT, "uint", default=0, light=_LAMPS),
    _info(POWER, "float", "Specular exponent", default=48.0, range_=(1.0, 512.0)),
    _info(SHINE, "rgb", "Highlight colour", default=(1.0, 1.0, 1.0)),
)

_GRAPH = Graph()
_BLOCKS = tuple(
    block
    for block in layout_blocks(
        [*(info.leaf for info in PARAMETERS), COS_OUTER], docs={"power": "Specular exponent"}
    )
    if block.name != "Frame"
)
_ORIGIN = constant(_GRAPH, VEC4, (0.0, 0.0, 0.0, 1.0))
_UV_NODE = _GRAPH.node("attribute", VEC2, (), UV)

SHADER = Shader(
    name="Lit",
    doc="A little plastic.",
    pass_name="Forward",
    rig_name="Studio",
    graph=_GRAPH,
    notes=Notes(),
    parameters=PARAMETERS,
    textures=(TextureInfo(ALBEDO, "texture2d", "Multiplies the base colour", HERE),),
    attributes=(AttributeInfo(UV, "vec2", "Texture coordinates", HERE),),
    results=(
        Result(CLIP_POSITION, VERTEX, _ORIGIN),
        Result(TARGET, FRAGMENT, _ORIGIN, "color", state=RenderTarget("rgba8")),
    ),
)

_SLOT = Field("uv", VEC2, 0)

PROGRAM = Program(
    shader=SHADER,
    stages=(
        Stage(
            row=VERTEX,
            inputs=(Field("uv", VEC2, 0),),
            blocks=(),
            textures=(),
            functions=(),
            region=Region(()),
            results=(Output(CLIP_POSITION, _ORIGIN), Output(VARYING, _UV_NODE, _SLOT)),
        ),
        Stage(
            row=FRAGMENT,
            inputs=(_SLOT,),
            blocks=_BLOCKS,
            textures=(ALBEDO,),
            reads=(TextureRead("sample", ALBEDO, 0),),
            functions=(),
            region=Region(()),
            results=(Output(TARGET, _ORIGIN, Field("color", VEC4, 0)),),
        ),
    ),
    blocks=_BLOCKS,
    textures=(ALBEDO,),
    interfaces=(Interface("vertex", "fragment", (Varying(_SLOT, (_UV_NODE,)),)),),
)


def _bound(
    identifier: str,
    group: int | None = None,
    binding: int | None = None,
    register: str | None = None,
) -> BindingRow:
    return BindingRow(identifier=identifier, group=group, binding=binding, register=register)


def _files(ending: str) -> tuple[FileRow, ...]:
    return tuple(
        FileRow(stage=stage, file=f"lit.{stage[:4]}.{ending}", entry_point="main")
        for stage in ("vertex", "fragment")
    )


_PLAIN = BackendRow(
    source_maps={},
    language="glsl",
    clip_depth="-1..1",
    clip_control=(),
    flip_y=False,
    front_face="ccw",
    first_row="bottom",
    files=_files("glsl"),
    blocks={
        block.name: BlockBindingRow(
            identifier=block.name, group=None, binding=None, register=None, members={}
        )
        for block in _BLOCKS
    },
    images={},
    buffers={},
    textures={"albedo": _bound("albedo")},
    samplers={},
    layouts=(),
    vertex_inputs={"uv": VertexInputNameRow(identifier="a_uv", semantic=None)},
    stream_output=None,
    captures={},
    host_uniforms=("burnish_height",),
    required_limits={},
    binding_id="0",
)

BACKENDS = {
    "glsl:es300": _PLAIN,
    "hlsl:sm6": changed(
        _PLAIN,
        language="hlsl",
        clip_depth="0..1",
        first_row="top",
        files=_files("hlsl"),
        blocks={
            block.name: BlockBindingRow(
                identifier=block.name,
                group=1,
                binding=number,
                register=f"b{number}",
                members={m.name: m.name for m in block.members},
            )
            for number, block in enumerate(_BLOCKS)
        },
        textures={"albedo": _bound("albedo", 1, 3, "t3")},
        samplers={"albedo": _bound("albedo_sampler", 1, 4, "s4")},
        vertex_inputs={"uv": VertexInputNameRow(identifier="uv", semantic="TEXCOORD0")},
        host_uniforms=(),
        required_limits={},
    ),
}


def derived_values() -> dict[Parameter, Node]:
    """The cosine of the torch's outer angle."""
    outer = _GRAPH.node("parameter", FLOAT, (), OUTER)
    return {COS_OUTER: _GRAPH.node("call", FLOAT, (outer,), "cos")}
