"""A program for each capability that needs it; the tests of the table's cells compile it.

Give a new row of ``CAPABILITIES`` its probe here. A probe needs nothing else that a profile may
lack, so that what is refused is refused for this reason.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.ir.stages import COMPUTE, CONTROL, GEOMETRY


@dataclass(frozen=True)
class Probe:
    """A program that needs one capability, and how to see which way it was carried out."""

    text: str
    options: Mapping[str, Any] = field(default_factory=dict)
    """The options of each ``compile``."""
    native: Mapping[str, Any] = field(default_factory=dict)
    """Further options, with which ``compile`` does not lower what the profile has natively."""
    is_native: Callable[[CompiledMaterial], bool] = lambda _: True
    """True if a material uses the profile's own means."""

    def compile(self, profile: str, *, native: bool = False) -> CompiledMaterial:
        """The program, compiled for a profile; raises ``CompileError`` where it is refused."""
        options = {**self.options, **(self.native if native else {})}
        (material,) = burnish.compile(self.text, profile, **options).materials
        return material


def has_geometry_stage(material: CompiledMaterial) -> bool:
    """True if a stage of its own emits the primitives."""
    return GEOMETRY in {stage.row for stage in material.staged.program.stages}


def draws_views_at_once(material: CompiledMaterial) -> bool:
    """True if one draw reaches all views."""
    return material.staged.program.shader.views > 0


def has_tessellation_stages(material: CompiledMaterial) -> bool:
    """True if stages of their own divide patches."""
    return CONTROL in {stage.row for stage in material.staged.program.stages}


def has_no_kernel(material: CompiledMaterial) -> bool:
    """True if the drawing pipeline does the work, and no kernel."""
    return COMPUTE not in {stage.row for stage in material.staged.program.stages}


def calls_no_definition(material: CompiledMaterial) -> bool:
    """True if the text has no function in place of a builtin."""
    ((legal, _),) = material._place.graphs().emissions
    return not legal.definitions


def writes_images(material: CompiledMaterial) -> bool:
    """True if a kernel writes images, and not render targets."""
    ((legal, _),) = material._place.graphs().emissions
    return bool(legal.program.images)


EXPANSION = """material M {{
    expand {} {{
        strip of 3 as i like corner[{step} * i] {{
            position = corner[{step} * i].position + 0.25 * corner[0].normal
        }}
    }}
    color = vec3(uv, 0)
}}"""

TESSELLATION = """material M {
    tessellate triangle by 3 as at {
        position = inherited.position + at.x * at.y * inherited.normal
    }
    color = vec3(uv, 0)
}"""

CAPTURE = " pass Moved { capture place : vec3 = position }"

CAPTURES = """
material M {{ color = vec3(uv, 0) }}
pass Moved {{ capture place : vec3 = position + {} * normal  capture tint : rgb = color }}
"""

PROBES: Mapping[str, Probe] = {
    "drawing": Probe("material M { color = vec3(uv, 0) }"),
    "derivatives": Probe("""material M {
        map paint : texture2d
        color = paint(uv).rgb + vec3(ddx(uv.x), ddy(uv.y), 0)
    }"""),
    "depths of fragments": Probe(
        "material M { color = vec3(uv, 0) }"
        " pass Own : Forward { depth { value = frag_coord.z + 0.1 * material.uv.x } }",
        options={"pass_": "Own"},
    ),
    "alpha to coverage": Probe(
        "material M { color = vec3(uv, 0) }"
        " pass Thin : Forward { raster { samples = 4, alpha_to_coverage = true } }",
        options={"pass_": "Thin"},
    ),
    "expansions": Probe(
        EXPANSION.format("triangle", step=1),
        native={"native_stages": True},
        is_native=has_geometry_stage,
    ),
    "tessellation": Probe(
        TESSELLATION,
        native={"native_stages": True},
        is_native=has_tessellation_stages,
    ),
    "expansions with adjacency": Probe(
        EXPANSION.format("triangle_adjacency", step=2),
        native={"native_stages": True},
        is_native=has_geometry_stage,
    ),
    "layers": Probe(
        """material M { color = vec3(uv, 0) }
        pass P : Forward {
            layers of 3
            layer : int
            expand triangle { strip of 3 as i for s in 0..3 { layer = s } }
        }""",
        options={"pass_": "P"},
        native={"native_stages": True},
        is_native=has_geometry_stage,
    ),
    "views": Probe(
        "material M { color = vec3(uv, 0) } pass P : Forward { views of 2 "
        "clip_position = view_projection * position + vec4(0.1 * float(view_index), 0, 0, 0) }",
        options={"pass_": "P"},
        native={"native_stages": True},
        is_native=draws_views_at_once,
    ),
    "captures": Probe(
        CAPTURES.format("0.5"),
        options={"pass_": "Moved"},
        native={"native_stages": True},
        is_native=has_no_kernel,
    ),
    "captures of expansions": Probe(
        EXPANSION.format("triangle", step=1) + CAPTURE,
        options={"pass_": "Moved"},
        native={"native_stages": True},
        is_native=has_no_kernel,
    ),
    "captures of tessellations": Probe(
        TESSELLATION + CAPTURE,
        options={"pass_": "Moved"},
        native={"native_stages": True},
        is_native=has_no_kernel,
    ),
    "numbers of captured vertices": Probe(
        CAPTURES.format("float(vertex_index)"),
        options={"pass_": "Moved"},
        native={"native_stages": True},
        is_native=has_no_kernel,
    ),
    "kernels over buffers": Probe(
        "kernel K { param n : int in 0..300 = 200  result r : float[n] = float(index) * 0.5 }"
    ),
    "scatter": Probe("kernel K { runs over 300  scatter bins : uint[8] add 1u at index mod 8 }"),
    "joined work groups": Probe("kernel K { result r : int[300] = group_sum(index) }"),
    "kernels over images": Probe(
        "kernel K { result i : image2d<rgba8>[ivec2(8, 8)] = vec4(vec2(texel), 0, 1) / 8 }",
        is_native=writes_images,
    ),
    "edges": Probe(
        "material M { color = vec3(uv, 0) } pass P : Forward { raster { fill = lines } }",
        options={"pass_": "P"},
    ),
    "several targets": Probe(
        """material M { color = vec3(uv, 0) }
        pass P : Forward {
            target color : rgba8 = vec4(color, 1)
            target other : rgba8 = vec4(1 - color, 1)
        }""",
        options={"pass_": "P"},
    ),
    "blending by target": Probe(
        """material M { color = vec3(uv, 0) }
        pass P : Forward {
            target color : rgba16f = vec4(color, 1) blend add
            target other : rgba8   = vec4(color, 1)
        }""",
        options={"pass_": "P"},
    ),
    "equations by target": Probe(
        """material M { color = vec3(uv, 0) }
        pass P : Forward {
            target color : rgba16f = vec4(color, 1) blend add
            target other : rgba8   = vec4(color, 1) blend multiply
        }""",
        options={"pass_": "P"},
    ),
    "blending of floats": Probe(
        """material M { color = vec3(uv, 0) }
        pass P : Forward { target color : rgba32f = vec4(color, 1) blend add }""",
        options={"pass_": "P"},
    ),
    "storage buffers at fragments": Probe(
        "material M { buffer tints : rgb[]  color = tints[int(uv.x * 4)] }"
    ),
    "storage buffers at vertices": Probe("""material M {
        buffer tints : rgb[]
        color = @vertex tints[int(uv.x * 4)]
    }"""),
    "gathering texels": Probe("material M { map t : texture2d  color = t.gather(uv, 0).rgb }"),
    "textures of depths": Probe("material M { map d : depth2d  color = vec3(d(uv, 0.5), uv) }"),
    "gathering comparisons": Probe("material M { map d : depth2d  color = d.gather(uv, 0.5).rgb }"),
    "number of levels": Probe(
        "material M { map t : texture2d  color = vec3(uv * float(t.levels()), 0) }"
    ),
    "levels of textures": Probe("material M { map t : texture2d  color = t.level(uv, 2).rgb }"),
    "biased levels": Probe("material M { map t : texture2d  color = t.bias(uv, 1).rgb }"),
    "loading texels": Probe("material M { map t : texture2d  color = t.load(ivec2(0)).rgb }"),
    "sizes of textures": Probe(
        "material M { map t : texture2d  color = vec3(vec2(t.size()), uv.x) / 64 }"
    ),
    "textures with layers": Probe("material M { map t : texture2d_array  color = t(uv, 1).rgb }"),
    "arrays of cubes": Probe("material M { map t : texture_cube_array  color = t(normal, 1).rgb }"),
    "textures of three dimensions": Probe(
        "material M { map t : texture3d  color = t(vec3(uv, 0.5)).rgb }"
    ),
    "textures of integers": Probe(
        "material M { map t : itexture2d  color = vec3(t.load(ivec2(0)).rgb) / 255 }"
    ),
    "comparing and loading": Probe(
        "material M { map d : depth2d  color = vec3(d(uv, 0.5), d.load(ivec2(0)), uv.x) }"
    ),
    "borders": Probe(
        "material M { map t : texture2d with { wrap = border }  color = t(3 * uv - 1).rgb }"
    ),
    "integers of 32 bits": Probe("material M { color = vec3(uv, float(int(9 * uv.x) & 3)) }"),
    "vertex inputs of integers": Probe(
        "material M { attribute bone : int  color = @vertex vec3(uv, float(bone)) }"
    ),
    "values of a single vertex": Probe(
        "material M { color = if @vertex (position.x > 0) then vec3(uv, 0) else vec3(0, uv) }"
    ),
    "matrices that are not square": Probe(
        "material M { m = mat3x2(uv, uv.yx, vec2(1))  color = vec3(m * vec3(uv, 1), m[0].x) }"
    ),
    "computed places": Probe(
        "material M { param w : float[9]  color = vec3(uv, w[int(8 * uv.x)]) }"
    ),
    "numbers of vertices": Probe(
        "material M { color = @vertex vec3(uv, float(vertex_index)) / 100 }"
    ),
    "instances": Probe("material M { color = @vertex vec3(uv, float(instance_index)) / 100 }"),
    "counting bits": Probe(
        """material M {
            n     = uint(uv.x * 1000)
            high  = vec2(float(count_bits(n)), float(first_leading_bit(n)))
            low   = vec2(float(first_trailing_bit(n)), float(reverse_bits(n) mod 64u))
            color = vec3(high + low, 0) / 64
        }""",
        is_native=calls_no_definition,
    ),
    "single file": Probe("material M { color = vec3(uv, 0) }", options={"single_file": True}),
}
