"""The faults that conformance finds in a material: neither too many nor none."""

from __future__ import annotations

import pytest

import burnish
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.runner.routes import ROUTES

from .kit import Studio

SOUND = {
    "magnified functions": "material M { wave = sin(6 * uv.x)  color = vec3(100 * wave) }",
    "cancelled digits": (
        "material M { param far : float = 3000  color = vec3((uv.x + far) - far) }"
    ),
    "functions at the vertices": (
        "material M { wave = @vertex sin(9 * uv.x)  color = vec3(100 * wave * wave, wave, 0) }"
    ),
    "highlights at the vertices": (
        "import std.terms.{phong}\n"
        "material M { shine = @vertex phong(vec3(1), 400)  color = shine }"
    ),
    "high frequencies": "material M { alpha = length(fract(uv * 12) - 0.5) }",
    "blended halves": (
        "material M { param k : float = 300 }\n"
        "pass P { target t : rgba16f = vec4(k * uv, 3 * k * uv.x, 0.5) blend premultiplied }"
    ),
    "blended tens": (
        "material M {}\npass P { target t : rgb10a2 = vec4(material.uv * 3, 0.5, 0.5) blend alpha }"
    ),
    "blended by factors": (
        "material M {}\npass P { target t : rgba8 = vec4(material.uv, 0.5, 0.5) blend {"
        " source = one_minus_dst, destination = src_alpha, operation = reverse_subtract } }"
    ),
    "whole numbers where the mesh has floats": (
        "material M { attribute vertex_color : uvec4  color = vec3(float(vertex_color.x)) }"
    ),
    "nearest texels, far away": (
        "material M { map m : texture2d with { filter = nearest }  color = m(uv * 10).rgb }"
    ),
    "layers by number": "material M { color = vec3(float(int(floor(uv.x * 8)) mod 3)) }",
}
PROVING_NOTHING = {
    "a speck": "material M { position = 0.03 * vec3(normal)  color = vec3(fract(1e7 * uv.x)) }",
    "noise": "material M { color = vec3(fract(1e7 * uv.x)) }",
    "nothing": "material M {}\npass P : Forward { discard when true }",
}

HASH = "fract(sin(dot(uv, vec2(12.9898, 78.233))) * 43758.5453)"
NO_VIOLATION = {
    "something behind what may be discarded": (
        "material M { color = if front_facing then vec3(1) else vec3(0)\n"
        f"alpha = if front_facing then {HASH} else 1 }}\n"
        "pass P : Forward { discard when material.alpha < 0.5 }"
    ),
    "whole numbers over any whole number": (
        f"material M {{ color = vec3(float(100 / int(floor({HASH} * 2000 - 1000)))) }}"
    ),
    "depths of vertices that are inexact": (
        "material M { clip_position = @vertex (((position in clip as vec4)"
        " + vec4(0, 0, 0.05 * sin(3 * uv.x), 0)) as point<clip>)  color = vec3(frag_coord.z) }"
    ),
    "a broken promise": (
        "material M { color = abs(normalize(nonzero(max(vec3(0), vec3(uv, 0.5) - vec3(0.5))))) }"
    ),
}
"""Materials whose pictures devices may draw in many ways."""


def row(studio: Studio, text: str, route: str) -> Row:
    pass_ = "P" if "pass P" in text else None
    (material,) = burnish.compile(f"burnish 1\n{text}\n", [ROUTES[route].profile], pass_=pass_)
    (found,) = conform([("M", material)], [ROUTES[route]], studio.runner, studio.toolchain)
    return found


@pytest.mark.parametrize("route", ["lavapipe:glsl", "swiftshader:hlsl-dxc", "llvmpipe:gl330"])
@pytest.mark.parametrize("what", SOUND)
def test_rounding_is_nobodys_fault(studio: Studio, what: str, route: str) -> None:
    found = row(studio, SOUND[what], route)
    assert found.status == "agrees", (found.problem, [r.comparison for r in found.results])


@pytest.mark.parametrize("what", PROVING_NOTHING)
def test_what_proves_nothing_is_no_agreement(studio: Studio, what: str) -> None:
    assert row(studio, PROVING_NOTHING[what], "lavapipe:glsl").status == "proves little"


@pytest.mark.parametrize("route", ["lavapipe:wgsl-naga", "swiftshader:glsl"])
@pytest.mark.parametrize("what", NO_VIOLATION)
def test_what_is_open_is_no_violation(studio: Studio, what: str, route: str) -> None:
    found = row(studio, NO_VIOLATION[what], route)
    assert found.status in {"agrees", "proves little"}, found.problem or found.reasons
