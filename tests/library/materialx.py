"""MaterialX's own GLSL of single nodes, drawn for many points at once by llvmpipe.

``std.mtlx`` is written from the specification; what the installed package ``MaterialX`` draws is
the truth about it. The nodes of a test module are in one shader, each of which fills some rows of
one picture, so one draw serves all of its tests. The numbers are kept, as they hardly ever change.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.drivers.pipeline import Code, Pipeline, VertexInput
from burnish.targets.runner.drivers.render_state import RenderTarget
from burnish.targets.runner.drivers.slots import Place, TextureSlot
from burnish.targets.runner.drivers.texels import Image
from burnish.targets.runner.store import Store, digest

from ..runner.jobs_kit import draw_job
from ..runner.textual_kit import CORNERS, asker, floats, indices, pixels
from .calls import Quad, called
from .kit import Floats

WIDTH, ROWS = 256, 4
"""The size of the part of a picture that belongs to a node."""
GIVEN = {"p": (-9.0, 9.0), "q": (0.0, 1.0), "r": (-2.0, 2.0)}
"""The vectors of four numbers that each call may read, by the ranges in which these lie. Calls that
compare neighbouring pixels may read ``s``, which is a plane within each quad of 2 by 2 pixels."""
RESULTS = {1: "one", 2: "two", 3: "three", 4: "four"}
"""The variables of GLSL that take a result, by its lanes."""


@dataclass(frozen=True, slots=True)
class Node:
    """A node of MaterialX, called in GLSL and in Burnish with the same numbers."""

    glsl: str
    """A statement that sets one of ``RESULTS``; ``whole`` and ``single`` may take others."""
    ours: str
    """The expression of Burnish."""
    lanes: int = 1
    near: float = 1e-5
    """How far both may be from each other, beside 1 or, if that is more, the value."""
    files: Sequence[str] = ()
    """Where the GLSL is defined, within the folder of MaterialX's libraries, or ``file:function``;
    if nothing is said, it is the file of the function's name."""
    rare: float = 0.0
    """The share of points that may be elsewhere: those beside a step, by rounding to float32."""

    @property
    def defined_in(self) -> Sequence[str]:
        """The files or functions to include."""
        return self.files or [f"stdlib/genglsl/{self.glsl.partition('(')[0]}.glsl"]


Nodes = Mapping[str, Node]


def assert_alike(nodes: Nodes, name: str, imports: str) -> None:
    """Burnish's expression of one of the nodes gives what MaterialX's GLSL of it draws."""
    node = nodes[name]
    ours, theirs = by_burnish(node, imports), drawn(nodes)[name]
    apart = (np.abs(ours - theirs) / np.maximum(1, np.abs(theirs))).max(axis=-1)
    assert (apart > node.near).mean() <= node.rare, f"{name}: {apart.max()} at {apart.argmax()}"


@cache
def points() -> Mapping[str, Floats]:
    """The numbers that calls may read, in float32: arrays of (rows, columns, lanes)."""
    chance = np.random.default_rng(11)
    made = {}
    for name, (low, high) in GIVEN.items():
        some = chance.uniform(low, high, (ROWS, WIDTH, 4))
        some[0, :8] = np.round(some[0, :8])
        some[0, 8:16] = np.floor(some[0, 8:16]) + 0.5
        made[name] = some.astype(np.float32).astype(np.float64)
    return made


@cache
def by_burnish(node: Node, imports: str) -> Floats:
    """The lanes of the expression, by the reference, one row for each point."""
    given = {**points(), "s": planes()}
    read = {name: value for name, value in given.items() if re.search(rf"\b{name}\b", node.ours)}
    maps = {"picture": Analytic()} if "picture" in node.ours else {}
    if "s" in read:
        quads = {name: Quad(_in_quads(value)) for name, value in read.items()}
        found = called(imports, node.ours, node.lanes, **quads, **maps)
        return _from_quads(found.reshape(*found.shape[:3], node.lanes))
    flat = {name: value.reshape(-1, 4) for name, value in read.items()}
    return called(imports, node.ours, node.lanes, **flat).reshape(-1, node.lanes)


def planes() -> Floats:
    """The numbers ``s``: those of ``p`` at a corner of each quad, and slopes by ``q`` and ``r``."""
    base, across, up = (
        points()[name][::2, ::2].repeat(2, axis=0).repeat(2, axis=1) for name in "pqr"
    )
    row, column = np.mgrid[:ROWS, :WIDTH] % 2
    return np.asarray(base + 0.0625 * (column[..., None] * across + row[..., None] * up))


def _in_quads(value: Floats) -> Floats:
    """The numbers of a part of a picture, with a first axis for its quads."""
    quads = value.reshape(ROWS // 2, 2, WIDTH // 2, 2, -1).transpose(0, 2, 1, 3, 4)
    return np.asarray(quads.reshape(-1, 2, 2, value.shape[-1]))


def _from_quads(found: Floats) -> Floats:
    """One row for each point, in their order, of what was found by quads."""
    lanes = found.shape[-1]
    parts = found.reshape(ROWS // 2, WIDTH // 2, 2, 2, lanes).transpose(0, 2, 1, 3, 4)
    return np.asarray(parts.reshape(-1, lanes))


class Analytic:
    """A texture that is a smooth function of where it is read, as ``picture`` of the shader is."""

    kind = "texture2d"

    def read(self, name: str, operands: tuple[Any, ...]) -> tuple[Any, ...]:
        """The value of a read with derivatives."""
        assert name == "sample_grad", name
        (u, v), (dx, dy), (ex, ey) = operands
        return (
            0.5 + 0.3 * np.sin(2 * u + v), 0.5 + 0.3 * np.cos(u - 2 * v),
            0.6 + 0.2 * np.sin(u + v) + dx - 2 * ey, 0.5 + 0.3 * np.sin(2 * u) + 2 * dy + ex,
        )  # fmt: skip


@cache
def _drawn(text: str, count: int) -> Floats:
    """The parts of the picture that a shader draws, one for each node."""
    store = Store("library", limit=1 << 26)
    name = digest(text, *(lanes.astype("<f4").tobytes() for lanes in points().values()))
    data = store.read(name)
    if data is None:
        data = _picture(text, count).astype("<f4").tobytes()
        store.write(name, data)
    return np.frombuffer(data, "<f4").reshape(count, ROWS * WIDTH, 4).astype(np.float64)


def drawn(nodes: Nodes) -> Mapping[str, Floats]:
    """The lanes that MaterialX's GLSL gives for each of the nodes, one row for each point."""
    parts = _drawn(_shader_of(list(nodes.values())), len(nodes))
    return {
        name: part[:, : node.lanes] for part, (name, node) in zip(parts, nodes.items(), strict=True)
    }


def _picture(text: str, count: int) -> Floats:
    """The picture of a fragment shader, by llvmpipe, with its bottom row first."""
    slots = [
        TextureSlot(Place(f"{name}_given", None, None), None, "nearest", "none", "clamp")
        for name in GIVEN
    ]
    pipeline = Pipeline(
        {"vertex": Code("main", _VERTEX), "fragment": Code("main", text)},
        (VertexInput("place", 0, "float32x3"),), (), tuple(slots), (RenderTarget("rgba32float"),),
        first_row="bottom",
    )  # fmt: skip
    images = tuple(
        Image("rgba32float", WIDTH, ROWS, (lanes.astype("<f4").tobytes(),))
        for lanes in points().values()
    )
    corners = floats([(*corner, 0.5) for corner in CORNERS])
    draw = Draw(WIDTH, ROWS * count, 3, (corners,), indices(0, 1, 2), (), images)
    (picture,) = asker("opengl").draw(draw_job(pipeline, (draw,)))
    return np.asarray(pixels(picture)[::-1], np.float64)


_VERTEX = """#version 330 core
in vec3 place;
void main() { gl_Position = vec4(place, 1.0); }
"""
_CALL = """
void call_{number}(vec4 p, vec4 q, vec4 r, vec4 s)
{{
    int whole; float single;
    float one; vec2 two; vec3 three; vec4 four;
    {glsl};
    found.{lanes} = {result};
}}
"""
_HEAD = """#define DIRECTIONAL_ALBEDO_METHOD 0
#define AIRY_FRESNEL_ITERATIONS 2
struct BSDF { vec3 response; vec3 throughput; };
#define VDF BSDF
#define EDF vec3
vec3 even_light = vec3(0.0);
"""
"""What MaterialX's generator writes before the texts of closures."""
_FRAGMENT = """#version 330 core
uniform sampler2D p_given, q_given, r_given;
layout(location = 0) out vec4 found;
{head}
vec4 picture(vec2 at, vec2 dx, vec2 dy)
{{
    return vec4(
        0.5 + 0.3 * sin(2.0 * at.x + at.y), 0.5 + 0.3 * cos(at.x - 2.0 * at.y),
        0.6 + 0.2 * sin(at.x + at.y) + dx.x - 2.0 * dy.y,
        0.5 + 0.3 * sin(2.0 * at.x) + 2.0 * dx.y + dy.x
    );
}}
#define textureGrad(sampler, at, dx, dy) picture(at, dx, dy)
{definitions}
{calls}
void main()
{{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 at = ivec2(pixel.x, pixel.y % {rows});
    vec4 p = texelFetch(p_given, at, 0);
    vec4 q = texelFetch(q_given, at, 0);
    vec4 r = texelFetch(r_given, at, 0);
    ivec2 corner = at / 2 * 2;
    vec2 step = 0.0625 * vec2(at - corner);
    vec4 s = texelFetch(p_given, corner, 0) + step.x * texelFetch(q_given, corner, 0)
        + step.y * texelFetch(r_given, corner, 0);
    found = vec4(0.0);
    switch (pixel.y / {rows}) {{
{cases}
    }}
}}
"""


def _shader_of(nodes: Sequence[Node]) -> str:
    """A fragment shader whose picture has some rows of each node, from the bottom on."""
    seen: set[Path] = set()
    files = dict.fromkeys(file for node in nodes for file in node.defined_in)
    return _FRAGMENT.format(
        rows=ROWS,
        head=_HEAD,
        definitions="\n".join(_defined(file, seen) for file in (*MATH, *files)),
        calls="".join(
            _CALL.format(
                number=number,
                glsl=node.glsl,
                lanes="xyzw"[: node.lanes],
                result=RESULTS[node.lanes],
            )
            for number, node in enumerate(nodes)
        ),
        cases="\n".join(f"    case {n}: call_{n}(p, q, r, s); break;" for n in range(len(nodes))),
    )


MATH = ("stdlib/genglsl/lib/mx_math.glsl",)
TOKENS = {
    "$closureDataConstructor": "ClosureData(closureType, L, V, N, P, occlusion)",
    "$refractionTwoSided": "false",
    "textureLod($texSamplerSampler2D, uv, lod).rgb": "even_light",
    "$texSamplerSignature": "sampler2D given",
    "$texSamplerSampler2D": "given",
    "$fileTransformUv": "mx_transform_uv_vflip.glsl",
    "$envRadianceMips": "1",
    "$envRadiance": "p_given",
    "$envIrradiance": "p_given",
    "$envLightIntensity": "1.0",
    "$envMatrix": "mat4(1.0)",
}
"""What MaterialX's generator fills in for these words: ``even_light`` is the same light from
everywhere. Words that others begin with come after these."""


def libraries() -> Path:
    """The folder of the installed package in which the libraries of MaterialX are."""
    return Path(import_module("MaterialX").getDefaultDataSearchPath().asString()) / "libraries"


def inlined(name: str, **inputs: str) -> str:
    """The expression that MaterialX's generator writes for a node without a function."""
    text = (libraries() / "stdlib/genglsl/stdlib_genglsl_impl.mtlx").read_text("utf-8")
    (source,) = re.findall(rf'"IM_{name}_genglsl".* sourcecode="(.*?);?"', text)
    return re.sub(r"{{(\w+)}}", lambda found: inputs[found[1]], source)


def _defined(file: str, seen: set[Path]) -> str:
    """A file of MaterialX with all that it includes, or one function of it."""
    name, _, function = file.partition(":")
    if not function:
        return _included(libraries() / name, seen)
    text = (libraries() / name).read_text("utf-8")
    (whole,) = re.findall(rf"^\w+ {function}\(.*?^}}", text, re.MULTILINE | re.DOTALL)
    return str(whole)


def _included(path: Path, seen: set[Path]) -> str:
    path = path.resolve()
    if path in seen:
        return ""
    seen.add(path)
    lines = []
    text = path.read_text("utf-8")
    for token, filled in TOKENS.items():
        text = text.replace(token, filled)
    for line in text.splitlines():
        wanted = re.match(r'#include "(.+)"', line)
        lines.append(_included(path.parent / wanted[1], seen) if wanted else line)
    return "\n".join(lines)
