"""Programs made by hand, as the middle end would hand them to a backend."""

from __future__ import annotations

from burnish.compiler.diagnostics.source import Source, Span
from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Attribute, Parameter, Texture
from burnish.compiler.ir.node import Formal, Graph, Node, reachable
from burnish.compiler.ir.program import (
    Block,
    Field,
    Function,
    Interface,
    Output,
    Program,
    Stage,
    StoredMember,
    Varying,
    native_uses,
    texture_reads,
)
from burnish.compiler.ir.shader import Notes, Shader, TextureInfo
from burnish.compiler.ir.stages import (
    CLIP_POSITION,
    DISCARD,
    FRAGMENT,
    FRAGMENTS,
    STAGES,
    TARGET,
    VARYING,
    VERTEX,
    VERTICES,
    Crossing,
    InterpolationMode,
    StageRow,
    inputs_of,
)
from burnish.compiler.ir.statements import Branch, Let, Loop, Region
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    INT,
    UINT,
    VEC2,
    VEC3,
    VEC4,
    Array,
    Matrix,
    Struct,
    TextureType,
    Type,
    square,
)
from burnish.support.frozen import changed

SIZES = {FLOAT: 4, INT: 4, UINT: 4, VEC2: 8, VEC3: 12, VEC4: 16, Matrix(3, 4): 48, square(4): 64}


class Maker:
    """Short spellings for the nodes of one program."""

    def __init__(self) -> None:
        self.graph = Graph()

    def native(self, name: str, type_: Type, *operands: Node) -> Node:
        return self.graph.node("native", type_, operands, name)

    def number(self, value: float) -> Node:
        return build.floating(self.graph, value)

    def parameter(self, parameter: Parameter) -> Node:
        return self.graph.node("parameter", parameter.type, (), parameter)

    def attribute(self, name: str, type_: Type) -> Node:
        return self.graph.node("attribute", type_, (), Attribute(name, type_))

    def crossing(self, value: Node, mode: InterpolationMode = "perspective") -> Node:
        return build.cross(self.graph, value, Crossing(VERTICES, FRAGMENTS, mode))

    def input(self, name: str, type_: Type) -> Node:
        return self.graph.node("input", type_, (), inputs_of(STAGES.values())[name])

    def formal(self, formal: Formal, type_: Type) -> Node:
        return self.graph.node("formal", type_, (), formal)


def shader_called(
    name: str, graph: Graph, doc: str = "", textures: tuple[Texture, ...] = ()
) -> Shader:
    """A shader of which only the name, the graph, the comment and the textures are known."""
    span = Span(Source("<text>", ""), 0, 0)
    infos = tuple(TextureInfo(texture, str(texture.type), "", span) for texture in textures)
    return Shader(name, doc, "Forward", "Rig", graph, Notes(), (), infos, (), ())


def block(
    name: str, group: str, members: list[tuple[Parameter, str]], derived: bool = False
) -> Block:
    """A block whose members need no packing; docs beside the parameters."""
    stored: list[StoredMember] = []
    offset = 0
    for parameter, doc in members:
        size = size_of(parameter.type)
        align = 4 if size == 4 else 8 if size == 8 else 16
        while offset % align:
            pad = sum(member.parameter is None for member in stored)
            stored.append(StoredMember(f"pad_{pad}", FLOAT, offset, 4, None))
            offset += 4
        name_ = parameter.name.replace(".", "_")
        stored.append(StoredMember(name_, parameter.type, offset, size, parameter, doc))
        offset += size
    structs = [
        parameter.type.element
        for parameter, _doc in members
        if isinstance(parameter.type, Array) and isinstance(parameter.type.element, Struct)
    ]
    return Block(name, group, derived, tuple(stored), -(-offset // 16) * 16, tuple(structs))


def size_of(type_: Type) -> int:
    match type_:
        case Array(element=Struct(members=members), count=count):
            return count * sum(size_of(member) for _name, member in members)
        case Array(element=element, count=count):
            return count * size_of(element)
        case _:
            return SIZES[type_]


def stage(row: StageRow, *results: Output, **parts: object) -> Stage:
    """A stage with nothing in it but its results and ``parts``."""
    empty: dict[str, object] = {
        "inputs": (), "blocks": (), "textures": (), "functions": (), "region": Region(()),
    }  # fmt: skip
    made = Stage(row=row, results=results, **{**empty, **parts})  # type: ignore[arg-type]
    lets = [item.node for item in made.region.statements if isinstance(item, Let)]
    bodies = [function.value for function in made.functions]
    nodes = reachable((*made.roots, *lets, *bodies))
    return changed(made, reads=texture_reads(nodes), natives=native_uses(nodes))


def written(name: str, value: Node, location: int = 0, doc: str = "") -> Output:
    """A result that goes to a render target."""
    return Output(TARGET, value, Field(name, value.type, location, doc=doc))


def between(*varyings: Varying) -> tuple[Interface, ...]:
    """The interfaces between the stages: the varyings from the vertices to the fragments."""
    return (Interface(VERTEX.domain, FRAGMENT.domain, varyings),)


def tiny(color: Node, make: Maker, blocks: tuple[Block, ...] = (), **fragment: object) -> Program:
    """A program whose fragment stage yields ``color``; its vertex stage does next to nothing."""
    zero = build.constant(make.graph, VEC4, (0.0, 0.0, 0.0, 1.0))
    parts = {"blocks": blocks, **fragment}
    textures: tuple[Texture, ...] = fragment.get("textures", ())  # type: ignore[assignment]
    return Program(
        shader=shader_called("Tiny", make.graph, textures=textures),
        stages=(
            stage(VERTEX, Output(CLIP_POSITION, zero)),
            stage(FRAGMENT, written("color", color), **parts),
        ),
        blocks=blocks,
        textures=textures,
        interfaces=between(),
    )


def placing(
    make: Maker, world: Node, to_clip: Node, blocks: tuple[Block, ...]
) -> tuple[Stage, tuple[Varying, ...]]:
    """The usual vertex stage, and what crosses from it."""
    position = make.attribute("position", VEC3)
    normal = make.attribute("normal", VEC3)
    uv = make.attribute("uv", VEC2)
    one = make.number(1.0)
    zero = make.number(0.0)
    placed = make.native("mul", VEC4, world, build.vector(make.graph, (position, one)))
    turned = make.native("mul", VEC4, world, build.vector(make.graph, (normal, zero)))
    position_world = build.swizzle(make.graph, placed, (0, 1, 2))
    normal_world = build.swizzle(make.graph, turned, (0, 1, 2))
    packed = build.vector(make.graph, (normal_world, make.number(0.5)))
    clip = make.native("mul", VEC4, to_clip, placed)
    fields = (
        Field("position", VEC3, 0),
        Field("normal", VEC4, 1),
        Field("uv", VEC2, 2),
    )
    varyings = (
        Varying(fields[0], (position_world,)),
        Varying(fields[1], (normal_world, make.number(0.5))),
        Varying(fields[2], (uv,)),
    )
    values = (position_world, packed, uv)
    made = stage(
        VERTEX,
        Output(CLIP_POSITION, clip),
        *(Output(VARYING, value, field) for value, field in zip(values, fields, strict=True)),
        inputs=(Field("position", VEC3, 0), Field("normal", VEC3, 1), Field("uv", VEC2, 2)),
        blocks=blocks,
        region=Region((Let("position", placed, "In world space, homogeneous"),)),
    )
    return made, varyings


def shading(make: Maker, power: Parameter) -> Function:
    """The function that computes the contribution of one light."""
    to_light = Formal("to_light")
    light = make.formal(to_light, VEC3)
    passed = tuple(Formal(name) for name in ("normal", "to_eye", "tint"))
    n, to_eye, tint = (make.formal(formal, VEC3) for formal in passed)
    zero = make.number(0.0)
    cosine = make.native("dot", FLOAT, n, light)
    mirrored = make.native("reflect", VEC3, make.native("neg", VEC3, light), n)
    shine = make.native(
        "pow",
        FLOAT,
        make.native("saturate", FLOAT, make.native("dot", FLOAT, mirrored, to_eye)),
        make.parameter(power),
    )
    highlight = make.graph.node(
        "select", FLOAT, (make.native("gt", BOOL, cosine, zero), shine, zero)
    )
    shaded = make.native(
        "add",
        VEC3,
        make.native("mul", VEC3, tint, make.native("saturate", FLOAT, cosine)),
        build.splat(make.graph, highlight, 3),
    )
    return Function(
        name="shade",
        doc="What one light contributes.",
        parameters=tuple((formal, VEC3) for formal in (to_light, *passed)),
        body=shaded,
        region=Region(
            (
                Let("n_dot_l", cosine),
                Branch("highlight", highlight, Region((Let("mirrored", mirrored),)), Region(())),
            )
        ),
        value=shaded,
    )


def plastic() -> Program:
    """A textured surface under a directional light and a loop of point lights."""
    make = Maker()
    base, power = Parameter("base", VEC3, "material"), Parameter("power", FLOAT, "material")
    world = Parameter("object_to_world", square(4), "draw")
    to_clip = Parameter("world_to_clip", square(4), "view")
    eye = Parameter("eye", VEC3, "view")
    sun = Parameter("sun.direction", VEC3, "rig")
    lamp = Struct("Lamp", (("place", VEC3), ("pad_0", FLOAT), ("diffuse", VEC3), ("pad_1", FLOAT)))
    lamps = Parameter("lamps", Array(lamp, 8), "rig")
    lamp_count = Parameter("lamps.count", INT, "rig")
    sun_cos = Parameter("sun.cos_outer", FLOAT, "rig", derived=True)
    albedo = Texture("albedo", TextureType(), "material")
    view = block("View", "view", [(to_clip, ""), (eye, "Where the camera stands, in world space")])
    rig = block("Rig", "rig", [(sun, ""), (lamp_count, ""), (lamps, "")])
    derived = block("DerivedFromRig", "rig", [(sun_cos, "cos(outer)")], derived=True)
    material = block("Material", "material", [(base, "Base colour"), (power, "Specular exponent")])
    draw = block("Draw", "draw", [(world, "")])

    vertex, varyings = placing(make, make.parameter(world), make.parameter(to_clip), (view, draw))
    position_world, normal_world, uv = (varying.values[0] for varying in varyings)
    fields = tuple(varying.field for varying in varyings)
    one = make.number(1.0)
    n = make.native("normalize", VEC3, make.crossing(normal_world))
    p = make.crossing(position_world)
    to_eye = make.native("normalize", VEC3, make.native("sub", VEC3, make.parameter(eye), p))
    texel = make.native(
        "sample", VEC4, make.graph.node("texture", TextureType(), (), albedo), make.crossing(uv)
    )
    tint = make.native(
        "mul", VEC3, make.parameter(base), build.swizzle(make.graph, texel, (0, 1, 2))
    )
    ambient = make.native("mul", VEC3, tint, make.number(0.1))

    shade = shading(make, power)
    body = shade.body

    def call(direction: Node) -> Node:
        return build.apply(make.graph, body, (direction, n, to_eye, tint))

    from_sun = call(make.native("neg", VEC3, make.parameter(sun)))
    index = Formal("i")
    one_lamp = build.index(make.graph, make.parameter(lamps), make.formal(index, INT))
    place = build.member(make.graph, one_lamp, "place")
    diffuse = build.member(make.graph, one_lamp, "diffuse")
    towards = make.native("normalize", VEC3, make.native("sub", VEC3, place, p))
    term = make.native("mul", VEC3, call(towards), diffuse)
    count = make.parameter(lamp_count)
    start = build.constant(make.graph, VEC3, (0.0, 0.0, 0.0))
    total = make.graph.node("native", VEC3, (count, start, term), "from_lamps")
    color = make.native("add", VEC3, make.native("add", VEC3, ambient, from_sun), total)
    faded = make.native("mul", VEC3, color, make.parameter(sun_cos))
    fragment = stage(
        FRAGMENT,
        written("color", build.vector(make.graph, (faded, one)), doc="Linear colour"),
        inputs=fields,
        blocks=(view, rig, derived, material),
        textures=(albedo,),
        functions=(shade,),
        region=Region(
            (
                Let("normal", n),
                Let("to_eye", to_eye),
                Let("tint", tint, "Base colour times the map"),
                Loop(
                    "from_lamps",
                    total,
                    count,
                    8,
                    start,
                    index,
                    "add",
                    Region((Let("to_light", towards),)),
                    term,
                ),
                Let("color", faded),
            )
        ),
    )
    return Program(
        shader=shader_called(
            "Plastic",
            make.graph,
            "Plastic after the classic three-term model.\nSecond line \\",
            (albedo,),
        ),
        stages=(vertex, fragment),
        blocks=(view, rig, derived, material, draw),
        textures=(albedo,),
        interfaces=between(*varyings),
    )


def odd() -> Program:
    """Everything that targets do differently: inputs, branches, discard, matrices, many targets."""
    make = Maker()
    graph = make.graph
    threshold = Parameter("threshold", FLOAT, "material")
    flags = Parameter("texture", UINT, "material")
    columns = Parameter("turn", Array(VEC4, 3), "material")
    material = block("Material", "material", [(threshold, ""), (flags, ""), (columns, "")])
    vertex_index = make.input("vertex_index", UINT)
    instance = make.input("instance_index", UINT)
    lifted = make.native("to_float", FLOAT, vertex_index)
    id_ = make.native("add", UINT, instance, build.constant(graph, UINT, 7))
    position = build.vector(graph, (lifted, make.number(-0.5), make.number(1e-7), make.number(1.0)))
    field = Field("id", UINT, 0, "flat")
    vertex = stage(
        VERTEX, Output(CLIP_POSITION, position), Output(VARYING, id_, field),
        builtin_inputs=("vertex_index", "instance_index"),
    )  # fmt: skip
    seen = make.crossing(id_, "flat")
    coord = make.input("frag_coord", VEC4)
    front = make.input("front_facing", BOOL)
    turn = make.parameter(columns)
    matrix = build.matrix(
        graph,
        tuple(
            build.swizzle(graph, build.index(graph, turn, build.constant(graph, INT, i)), (0, 1, 2))
            for i in range(3)
        ),
    )
    turned = make.native("mul", VEC3, matrix, build.swizzle(graph, coord, (0, 1, 2)))
    column = build.index(graph, matrix, build.constant(graph, INT, 1))
    bits = make.native("eq", BOOL, make.parameter(flags), build.constant(graph, UINT, 4294967295))
    both = make.native("and", BOOL, bits, make.native("or", BOOL, front, bits))
    lowest = make.native("to_float", FLOAT, build.constant(graph, INT, -(2**31)))
    lane = build.swizzle(graph, turned, (0,))
    inner = graph.node(
        "select", FLOAT, (both, lane, make.native("mul", FLOAT, lowest, make.number(0.1)))
    )
    outer = graph.node("select", VEC3, (front, build.splat(graph, inner, 3), column))
    clamped = make.native("clamp", VEC3, outer, make.number(0.0), make.parameter(threshold))
    powered = make.native("pow", VEC3, clamped, make.number(2.0))
    negated = make.native("mul", VEC3, make.native("neg", square(3), matrix), powered)
    first = build.vector(graph, (negated, make.native("to_float", FLOAT, seen)))
    second = build.constant(graph, VEC2, (0.25, 0.25))
    below = make.native("lt", BOOL, lane, make.parameter(threshold))
    fragment = stage(
        FRAGMENT,
        written("color", first),
        written("motion", second, 1),
        Output(DISCARD, below),
        inputs=(field,),
        blocks=(material,),
        region=Region(
            (
                Let("turn", matrix),
                Let("turned", turned),
                Branch(
                    "result",
                    outer,
                    Region((Branch("inner", inner, Region(()), Region(())),)),
                    Region((Let("column", column),)),
                ),
                Let("final", powered),
            )
        ),
        builtin_inputs=("frag_coord", "front_facing"),
    )
    return Program(
        shader=shader_called("Odd", graph),
        stages=(vertex, fragment),
        blocks=(material,),
        textures=(),
        interfaces=between(Varying(field, (id_,))),
    )
