"""A material with more textures than all devices have, drawn where there are so many."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

import burnish
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain.toolchain import Toolchain

COUNT = 24
STATES = ("", " with { filter = nearest }", " with { wrap = clamp }")
"""The samplers, which textures take by turns: if they were mixed up, the picture would differ."""
MAPS = "\n".join(f"map t{i} : texture2d{STATES[i % 3]}" for i in range(COUNT))
SUM = " + ".join(f"t{i}({1 + i / 8} * uv - 0.25)" for i in range(COUNT))
TEXT = f"""
material Many {{
    {MAPS}
    map shade : depth2d
}}
pass Sum {{
    target color : rgba32f = ({SUM}) * (0.25 + shade(uv, 0.5))
}}
"""
DRAWN = ("lavapipe:glsl", "lavapipe:hlsl-dxc", "swiftshader:hlsl-glslang", "swiftshader:wgsl-naga")

pytestmark = pytest.mark.xdist_group("many textures")


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


def row_of(name: str, toolchain: Toolchain) -> Row:
    route = ROUTES[name]
    (material,) = burnish.compile(TEXT, (route.profile,), pass_="Sum").materials
    with Runner([route]) as runner:
        (found,) = conform([(material.name, material)], [route], runner, toolchain)
    return found


@pytest.mark.parametrize("name", DRAWN)
def test_textures_that_share_samplers_show_what_they_hold(name: str, toolchain: Toolchain) -> None:
    assert row_of(name, toolchain).status == "agrees"


def test_a_device_that_has_fewer_says_so(toolchain: Toolchain) -> None:
    """Chromium offers no more than 16 of SwiftShader's textures."""
    found = row_of("chromium:webgpu", toolchain)
    assert found.status == "failed"
    assert "The number of sampled textures (25)" in found.problem
    assert "exceeds the maximum per-stage limit (16)" in found.problem
