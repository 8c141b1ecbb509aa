"""The profile of GLSL ES 1.00, for OpenGL ES 2.0 and WebGL 1, which ``language.py`` lists.

The language is older than all others here: it has no blocks, no integers of a known width, and only
loops with a constant number of iterations. Appendix A of its specification
(https://registry.khronos.org/OpenGL/specs/es/2.0/GLSL_ES_Specification_1.00.pdf) lists the features
that it may leave out, as many devices do.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ...compiler.ir.types import TextureType
from ...stdlib.builtins.facts import Fact
from ...stdlib.builtins.row import Domain
from ..description.forms import Forms
from ..description.profile import Framebuffer, Limits, Profile, Samplers
from ..description.spellings import Literals, Read, Spelling, Spellings, TypeNames

TYPES = TypeNames(
    # Only bools are stored as uint, so only 0 and 1 are written.
    scalars={"float": "float", "int": "int", "uint": "int", "bool": "bool"},
    vectors={"float": "vec{n}", "int": "ivec{n}", "uint": "ivec{n}", "bool": "bvec{n}"},
    matrix="mat{n}",
    # All matrices are square. A host fills the columns that a stored matrix lacks with zeros.
    rectangular_matrix="mat4",
)

NATIVES: Spellings = {
    "mod": Spelling(floats="mod", integers="({0:factor} - {1:factor} * ({0:factor} / {1:factor}))"),
    "fma": "({0:factor} * {1:factor} + {2:factor})",
    # There are no operations on bits, and no `&&` of vectors.
    "and": Spelling(vectors="{type}(vec{lanes}({0}) * vec{lanes}({1}))"),
    "or": Spelling(vectors="{type}(vec{lanes}({0}) + vec{lanes}({1}))"),
    "sample": Read("texture2D({0}, {1})", types={"texture_cube": "textureCube({0}, {1})"}),
    "sample_bias": Read(
        "texture2D({0}, {1}, {2})", types={"texture_cube": "textureCube({0}, {1}, {2})"}
    ),
}

FORMS = Forms(
    loop="for ({index_typed} = {zero}; {index} < {bound}; {index}++) {{",
    enough="if ({index} >= {count}) {{ break; }}",
    loop_while="",
    at_most="{value}",
    array="",
    product_of_stored="({matrix:factor} * vec4({vector}, {zeros}))",
)


def is_float(facts: tuple[Fact, ...]) -> bool:
    """True if the operands are floats."""
    return facts[0].kind == "float"


AGREES: Mapping[str, Domain] = dict.fromkeys(
    ("abs", "clamp", "dot", "max", "min", "sign"), is_float
)

LACKS = frozenset({"cosh", "determinant", "round", "sinh", "tanh", "transpose", "trunc"})

DERIVATIVES = "#extension GL_OES_standard_derivatives : require"


def es100(framebuffer: Framebuffer) -> Profile:
    """The profile, whose clip space and rows are those of the other OpenGL profiles."""
    return Profile(
        name="es100",
        doc="GLSL ES 1.00 for OpenGL ES 2.0 and WebGL 1: loose uniforms, one render target, loops "
        "with constant bounds, integers up to 65 535. Of devices it asks more than these promise: "
        "`highp` and 64 vectors of uniforms at fragments, and `OES_standard_derivatives`.",
        on_request=True,
        preamble=("#version 100",),
        requires={
            "ddx": DERIVATIVES,
            "ddy": DERIVATIVES,
        },
        defaults=("precision highp float;", "precision highp int;"),
        types=TYPES,
        literals=Literals(uint_suffix=""),
        forms=FORMS,
        skeleton=Path(__file__).parent / "es100.glsl.j2",
        explicit_bindings=False,
        draws_edges=False,
        links_without_fragments=False,
        blending="alike",
        blends_floats=False,
        fragment_depths=False,
        borders=False,
        samplers=Samplers(combined=True, precision="precision highp {type};"),
        framebuffer=framebuffer,
        # Fragments are promised only 16 vectors of uniforms, which a few lamps fill.
        limits=Limits(
            varyings=8,
            attributes=8,
            textures=8,
            vertex_textures=0,
            vertex_uniforms=128,
            fragment_uniforms=64,
            render_targets=1,
            vertex_buffers=0,
            fragment_buffers=0,
            kernel_buffers=0,
        ),
        varyings_by_name=True,
        invariant_inputs=True,
        natives=NATIVES,
        without_inputs=frozenset({"vertex_index", "instance_index", "view_index"}),
        textures=frozenset({TextureType("2d"), TextureType("cube")}),
        wide_integers=False,
        integer_attributes=False,
        flat_varyings=False,
        rectangular_matrices=False,
        computed_indices=False,
        loose_uniforms=True,
        lacks=LACKS,
        agrees=AGREES,
        cannot=frozenset(
            {"gather", "load", "sample_grad", "sample_level", "texture_levels", "texture_size"}
        ),
        checkers=("glslang-es100",),
    )
