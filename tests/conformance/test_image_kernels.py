"""Every route makes the images that the reference computes."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES

from ..targets.standings import routes
from .kit import Studio, all_of
from .planted import in_image_kernels
from .planted.planting import Planted

FILE = Path(__file__).with_name("image_kernels.burnish")
NAMES = ("Bytes", "Few", "Floats", "Stored", "Alone", "Branches")
WRITTEN = {"Stored", "Alone", "Branches"}
"""The kernels whose formats a compute shader can write."""
WITHOUT_BUFFERS = routes("absent", "storage buffers at fragments")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("route", ROUTES)
def test_it_agrees(studio: Studio, route: str, name: str) -> None:
    row = studio.judged(route, name, all_of(FILE)[name])
    if name == "Floats" and route in WITHOUT_BUFFERS:
        assert row.status == "not run"
        assert "storage buffers" in row.problem
        return
    assert row.status == "agrees", "\n".join(details(row)) or row.problem
    assert row.covered > 1000


@pytest.mark.parametrize("planted", in_image_kernels.PLANTED, ids=str)
def test_a_planted_error_is_found(
    studio: Studio, planted: Planted, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    route = ROUTES[planted.route]
    with monkeypatch.context() as patch:
        planted.plant(patch, tmp_path)
        (kernel,) = burnish.compile(FILE, route.profile, material=planted.material)
        (row,) = conform([(planted.name, kernel)], [route], studio.runner, studio.toolchain)
    assert row.status == planted.status, row.problem or "\n".join(details(row))


@pytest.mark.parametrize("name", NAMES)
def test_profiles_with_kernels_write_images_where_they_can(name: str) -> None:
    backends = all_of(FILE)[name].reflection.backends
    for profile in ("glsl:vulkan", "hlsl:sm6", "wgsl:webgpu"):
        stages = [row.stage for row in backends[profile].files]
        assert stages == (["compute"] if name in WRITTEN else ["vertex", "fragment"])
        assert bool(backends[profile].images) == (name in WRITTEN)
    drawn = backends.get("glsl:gl330")
    stages = [] if drawn is None else [row.stage for row in drawn.files]
    assert stages == ([] if name == "Floats" else ["vertex", "fragment"])


def test_all_kernels_are_run() -> None:
    assert {kernel.name for kernel in all_of(FILE)} == set(NAMES)
