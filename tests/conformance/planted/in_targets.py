"""Planted errors in the languages: spellings, forms, templates and pipeline inputs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import pytest

from burnish.compiler.ir.node import Node
from burnish.compiler.ir.operations import SWIZZLE
from burnish.compiler.ir.program import Varying
from burnish.support.frozen import changed
from burnish.targets.description.spellings import Spelling
from burnish.targets.emit import context, leaves, precedence
from burnish.targets.emit.context import Dialect
from burnish.targets.emit.expressions import Expressions
from burnish.targets.emit.precedence import POSTFIX, Printed, within

from .planting import (
    QUICKEST,
    Plant,
    Planted,
    agreeing,
    form,
    framebuffer,
    replaced,
    skeleton,
    spelling,
    supplied,
    target,
)

SPELLINGS: dict[str, list[tuple[str, str, str | Spelling]]] = {
    "operations: Arithmetic": [
        ("glsl", "add", "-"),
        ("hlsl", "sub", "({1:p} - {0:p})"),
        ("wgsl", "mul", Spelling(floats="+")),
        ("wgsl", "div", "({1:p} / {0:p})"),
        ("hlsl", "neg", "abs({0})"),
        ("glsl", "mix", "mix({1}, {0}, {2})"),
        ("hlsl", "mix", "lerp({1}, {0}, {2})"),
        ("wgsl", "mix", "mix({1}, {0}, {2})"),
        ("glsl", "abs", "({0})"),
        ("hlsl", "sign", "{type}(-sign({0}))"),
        ("glsl", "sign", "{type}({0:p} < 0.0 ? -1.0 : 1.0)"),
    ],
    "operations: Limits": [
        ("wgsl", "min", "max"),
        ("glsl", "max", "min"),
        ("hlsl", "max", "min"),
        ("hlsl", "clamp", "clamp({0}, {2}, {1})"),
        ("wgsl", "clamp", "max({0}, {1})"),
        ("glsl", "saturate", "({0})"),
        ("hlsl", "saturate", "max({0}, 0.0)"),
        ("wgsl", "saturate", "abs({0})"),
        ("glsl", "step", "step({1}, {0})"),
        ("hlsl", "step", "{type}({0:p} < {1:p})"),
        ("wgsl", "smoothstep", "saturate(({2:p} - {0:p}) / ({1:p} - {0:p}))"),
        ("hlsl", "smoothstep", "saturate(({2:p} - {0:p}) / ({1:p} - {0:p}))"),
    ],
    "operations: Rounding": [
        ("wgsl", "floor", "trunc"),
        ("glsl", "ceil", "floor"),
        ("hlsl", "trunc", "floor"),
        ("glsl", "fract", "({0:p} - trunc({0}))"),
        ("hlsl", "round", "(sign({0}) * floor(abs({0}) + 0.5))"),
        ("glsl", "round", "floor({0:p} + 0.5)"),
        ("wgsl", "round", "trunc"),
    ],
    "operations: Powers": [
        ("glsl", "pow", "exp2({0:p} * {1:p})"),
        ("hlsl", "pow", "pow({1}, {0})"),
        ("wgsl", "pow", "pow({0}, {1} + 0.01)"),
        ("glsl", "exp", "exp2"),
        ("wgsl", "exp2", "exp"),
        ("hlsl", "log", "log2"),
        ("glsl", "log2", "log"),
        ("wgsl", "sqrt", "({0})"),
        ("hlsl", "inversesqrt", "sqrt"),
    ],
    "operations: Angles": [
        ("glsl", "sin", "cos"),
        ("hlsl", "cos", "sin"),
        ("wgsl", "tan", "atan"),
        ("glsl", "asin", "acos"),
        ("hlsl", "acos", "asin"),
        ("wgsl", "atan", "({0})"),
        ("glsl", "atan2", "atan({1}, {0})"),
        ("hlsl", "atan2", "atan2({1}, {0})"),
        ("wgsl", "atan2", "atan({0:p} / {1:p})"),
        ("hlsl", "radians", "degrees"),
        ("glsl", "degrees", "radians"),
    ],
    "operations: Geometry": [
        ("hlsl", "dot", "length({0} * {1})"),
        ("glsl", "cross", "cross({1}, {0})"),
        ("wgsl", "length", "dot({0}, {0})"),
        ("wgsl", "distance", "length({0:p} + {1:p})"),
        ("glsl", "reflect", "(-reflect({0}, {1}))"),
        ("hlsl", "reflect", "reflect({1}, {0})"),
        ("wgsl", "reflect", "({0:p} - dot({0}, {1}) * {1:p})"),
    ],
    "operations: Bending": [
        ("glsl", "refract", "refract({0}, {1}, 1.0 / {2:p})"),
        ("hlsl", "refract", "refract({0}, -{1:p}, {2})"),
        ("hlsl", "faceforward", "(-faceforward({0}, {1}, {2}))"),
        ("wgsl", "faceforward", "faceForward({1}, {0}, {2})"),
    ],
    "integers: Signed": [
        ("glsl", "add", "-"),
        ("glsl", "min", "max"),
        ("wgsl", "abs", "({0})"),
        ("hlsl", "sign", "{type}({0:p} < 0)"),
    ],
    "integers: Unsigned": [
        ("hlsl", "mod", "({0:p} / {1:p})"),
        ("hlsl", "to_float", "{type}(asint({0}))"),
    ],
    "integers: Converted": [
        ("hlsl", "to_int", "{type}(floor({0}))"),
        ("glsl", "to_uint", "{type}(int({0}))"),
        ("wgsl", "to_int", "{type}({0:p} + {0:p})"),
    ],
    "integers: Compared": [
        ("glsl", "lt", "<="),
        ("hlsl", "le", "<"),
        ("wgsl", "gt", "<"),
        ("glsl", "ge", ">"),
        ("hlsl", "eq", "!="),
        ("wgsl", "ne", "=="),
        ("glsl", "and", "||"),
        ("wgsl", "or", "&&"),
        ("hlsl", "not", "({0} || true)"),
        ("glsl", "any", "all"),
        ("wgsl", "all", "any"),
    ],
    "pipeline: Products": [
        ("hlsl", "mul", Spelling(matrix="mul({1}, {0})")),
        ("glsl", "transpose", "({0})"),
        ("wgsl", "determinant", "(-determinant({0}))"),
    ],
}
"""Wrong spellings for each material: the language, the builtin, and the wrong text."""


def _spellings() -> Iterator[Planted]:
    for material, rows in SPELLINGS.items():
        for language, builtin, text in rows:
            shown = text.matrix or text.floats if isinstance(text, Spelling) else text
            name = f"{builtin} as {shown}"
            yield Planted(name, material, QUICKEST[language], spelling(language, builtin, text))


FLAT = "{% if field.flat %}flat {% endif %}"
NOINTERPOLATION = "{% if field.flat %}nointerpolation {% endif %}"
INTERPOLATE = "{% if field.flat %}@interpolate(flat) {% endif %}"
BETWEEN = "{{% if field.flat %}}{} {{% elif field.crosses %}}{} {{% endif %}}"
"""Replaces the interpolation qualifiers of everything that is passed between the stages."""
GLSL, HLSL, WGSL = QUICKEST["glsl"], QUICKEST["hlsl"], QUICKEST["wgsl"]
OPENGL, OPENGL_4, BROWSER = "llvmpipe:gl330", "llvmpipe:gl450", "chromium:webgl2"
DISCARD = "{% for line in entry.discard %}\n    {{ line }}"
NEGATED = "line.replace('if (', 'if (!(').replace(') {', ')) {') }}"
REWRITTEN_Z = "gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;"


def _reversed(expressions: Expressions, node: Node) -> Printed:
    """Print a swizzle with its lanes in reverse order."""
    operand = within(expressions.operand(node.operands[0]), POSTFIX)
    lanes = reversed(SWIZZLE.data(node))
    return f"{operand}.{''.join('xyzw'[lane] for lane in lanes)}", POSTFIX


crossings = leaves._crossings


def _shifted(varyings: Iterable[Varying]) -> Iterator[Any]:
    """Shift the lanes of varyings by one, if there is room."""
    for key, (slot, first, total) in crossings(varyings):
        yield key, (slot, max(first - 1, 0), total)


LOOSE = precedence.Infix(precedence.Binding.PREFIX, precedence.Binding.SUM)
"""An operator of which the operands get no parentheses."""


def _unbound(operator: str) -> Plant:
    """Print an operator without parentheses. Dialects remember how they print operators."""

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        patch.setattr(context, "dialect", Dialect)
        patch.setattr(precedence, "INFIX", {**precedence.INFIX, operator: LOOSE})

    return plant


FORMS = [
    Planted("?: the wrong way round", "integers: Compared", GLSL,
            form("glsl", select="({condition} ? {otherwise} : {then})")),
    Planted("select with its operands swapped", "integers: Compared", WGSL,
            form("wgsl", select="select({then}, {otherwise}, {condition})")),
    Planted("a loop that ends one turn early", "lights: Both", GLSL,
            form("glsl", loop="for ({index_typed} = {zero}; {index} + 1 < {count}; {index}++) {{")),
    Planted("a loop that begins one turn late", "lights: Both", HLSL,
            form("hlsl", loop="for ({index_typed} = 1; {index} < {count}; {index}++) {{")),
    Planted("a loop of one turn more", "lights: Both", WGSL,
            form("wgsl",
                 loop="for (var {index_typed} = {zero}; {index} <= {count}; {index}++) {{")),
    Planted("matrices of rows", "pipeline: Products", HLSL,
            form("hlsl", matrix="{type}({columns})")),
    Planted("rows for columns", "pipeline: Products", HLSL,
            form("hlsl", column="{matrix}[{position}]")),
    Planted("row-major blocks", "storage: Products", HLSL,
            target("hlsl", lambda whole: changed(
                whole, types=changed(whole.types, stored_matrix="row_major {type}"))), "failed"),
    Planted("no parentheses in divisors", "rules: Nested", GLSL,
            _unbound("/")),
    Planted("no parentheses in subtracted sums", "rules: Nested", HLSL,
            _unbound("-")),
    Planted("swizzles backwards", "storage: Plain", GLSL,
            replaced(Expressions, "PRINTERS", {**Expressions.PRINTERS, "swizzle": _reversed})),
    Planted("lanes of a shared varying shifted", "pipeline: Crossing", WGSL,
            replaced(leaves, "_crossings", _shifted)),
]  # fmt: skip

PIPELINE = [
    Planted("first_leading_bit of an int as DXC has it", "bits: Counted", HLSL,
            agreeing("hlsl", "sm6")),
    Planted("frag_coord from below", "pipeline: Crossing", OPENGL,
            framebuffer("glsl", "gl330", inputs={})),
    Planted("frag_coord from below", "pipeline: Crossing", BROWSER,
            framebuffer("glsl", "es300", inputs={})),
    Planted("frag_coord from below", "pipeline: Crossing", GLSL,
            supplied("glsl", "frag_coord",
                     "vec4(gl_FragCoord.x, 56.0 - gl_FragCoord.y, gl_FragCoord.zw)")),
    Planted("w instead of 1 / w", "pipeline: Crossing", HLSL,
            supplied("hlsl", "frag_coord", "input.{name}")),
    Planted("frag_coord at corners", "pipeline: Crossing", WGSL,
            supplied("wgsl", "frag_coord", "floor(input.{name})")),
    Planted("front_facing inverted", "pipeline: Crossing", GLSL,
            supplied("glsl", "front_facing", "(!gl_FrontFacing)")),
    Planted("front_facing always", "pipeline: Crossing", WGSL,
            supplied("wgsl", "front_facing", "(input.{name} || true)")),
    Planted("ddy upwards", "pipeline: Slopes", OPENGL,
            framebuffer("glsl", "gl330", natives={})),
    Planted("ddy upwards", "pipeline: Slopes", BROWSER,
            framebuffer("glsl", "es300", natives={})),
    Planted("ddy upwards", "pipeline: Slopes", GLSL, spelling("glsl", "ddy", "(-dFdy({0}))")),
    Planted("ddx for ddy", "pipeline: Slopes", HLSL, spelling("hlsl", "ddy", "ddx")),
    Planted("half of ddx", "pipeline: Slopes", WGSL,
            spelling("wgsl", "ddx", "(0.5 * dpdx({0}))")),
    Planted("z left between 0 and w", "operations: Limits", OPENGL,
            skeleton("glsl", (REWRITTEN_Z, ""))),
    Planted("z left between 0 and w", "pipeline: Crossing", BROWSER,
            skeleton("glsl", (REWRITTEN_Z, ""))),
    Planted("OpenGL's own clip space", "pipeline: Crossing", OPENGL_4,
            framebuffer("glsl", "gl450", clip_control=())),
    Planted("blocks where others are", "storage: Plain", OPENGL_4,
            skeleton("glsl", ("binding = {{ block.slot.binding }}",
                              "binding = {{ 12 - block.slot.binding }}"))),
    Planted("textures where others are", "textures: Wraps", OPENGL_4,
            skeleton("glsl", ("binding = {{ texture.slot.binding }}",
                              "binding = {{ 7 - texture.slot.binding }}"))),
    Planted("z rewritten for Vulkan", "operations: Limits", GLSL,
            framebuffer("glsl", "vulkan", clip_depth="-1..1")),
    Planted("y negated", "operations: Limits", WGSL,
            skeleton("wgsl", ("{% if flip_y %}", "{% if not flip_y %}"))),
    Planted("no perspective", "operations: Limits", GLSL,
            skeleton("glsl", (FLAT, BETWEEN.format("flat", "noperspective")))),
    Planted("no perspective", "operations: Limits", HLSL,
            skeleton("hlsl", (NOINTERPOLATION,
                              BETWEEN.format("nointerpolation", "noperspective")))),
    Planted("no perspective", "operations: Limits", WGSL,
            skeleton("wgsl", (INTERPOLATE,
                              BETWEEN.format("@interpolate(flat)", "@interpolate(linear)")))),
    Planted("not flat", "pipeline: Crossing", GLSL,
            skeleton("glsl", (FLAT, "")), "failed"),
    Planted("discard where it must not", "pipeline: Holes", GLSL,
            skeleton("glsl", (DISCARD, DISCARD.replace("line }}", NEGATED)))),
    Planted("no discard", "pipeline: Holes", WGSL,
            form("wgsl", discard="return output;")),
    Planted("a comma too many", "pipeline: Holes", HLSL,
            skeleton("hlsl", ("return output;", "return output,;")), "failed"),
]  # fmt: skip

TEXTURES = [
    Planted("v upwards", "textures: Wraps", GLSL,
            spelling("glsl", "sample", "texture({0}, vec2({1:p}.x, 1.0 - {1:p}.y))")),
    Planted("u and v exchanged", "textures: Wraps", HLSL,
            spelling("hlsl", "sample", "{0}.Sample({sampler}, {1:p}.yx)")),
    Planted("level 0 only", "textures: Levels", WGSL,
            spelling("wgsl", "sample", "textureSampleLevel({0}, {sampler}, {1}, 0.0)")),
    Planted("a level too small", "textures: Levels", GLSL,
            spelling("glsl", "sample", "texture({0}, {1}, 1.0)")),
    Planted("half a level too small", "textures: Levels", HLSL,
            spelling("hlsl", "sample", "{0}.SampleBias({sampler}, {1}, 0.5)")),
]  # fmt: skip

PLANTED = [*_spellings(), *FORMS, *PIPELINE, *TEXTURES]
