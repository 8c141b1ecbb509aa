"""GLSL ES 1.00 is drawn as the reference draws it, with uniforms in place of blocks.

Mesa's OpenGL takes these texts. The route has to be named, so the other tests do not draw with it.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import burnish
from burnish.api import entry_points as api
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import EVERY_ROUTE, ROUTES, select
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain

from .kit import FOLDER

ROUTE = EVERY_ROUTE["llvmpipe:es100"]
EXAMPLES = FOLDER.parents[1] / "examples"
ROUGH = FOLDER / "webgl1.burnish"
DRAWN = [
    *((ROUGH, None, pass_) for _, pass_ in api.variants(ROUGH) if pass_),
    # Rigs with arrays of lamps, textures, derivatives, and what is given up.
    *(
        (EXAMPLES / f"{name}.burnish", rig, pass_)
        for name in ("plastic", "matcap", "normal_map", "cutout", "triplanar", "host_block")
        for rig, pass_ in api.variants(EXAMPLES / f"{name}.burnish")
    ),
]


@pytest.fixture(scope="module")
def runner() -> Iterator[Runner]:
    with Runner([ROUTE]) as made:
        yield made


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


@pytest.mark.xdist_group("webgl1")
@pytest.mark.parametrize(
    ("path", "rig", "pass_"),
    DRAWN,
    ids=["-".join(filter(None, (path.stem, rig, pass_))) for path, rig, pass_ in DRAWN],
)
def test_it_agrees_with_the_reference(
    runner: Runner, toolchain: Toolchain, path: Path, rig: str | None, pass_: str | None
) -> None:
    for material in burnish.compile(path, ROUTE.profile, rig=rig, pass_=pass_):
        (row,) = conform([(material.name, material)], [ROUTE], runner, toolchain)
        assert row.status == "agrees", "\n".join(details(row))


def test_the_texts_use_what_they_are_drawn_for() -> None:
    texts = {
        pass_: burnish.compile(ROUGH, ROUTE.profile, pass_=pass_)["Rough"].text(
            ROUTE.profile, "fragment"
        )
        for _, pass_ in api.variants(ROUGH)
        if pass_
    }
    for pass_, written in {
        "Rounded": "float to_nearest(float x) {",
        "Whole": "int magnitude(int x) {",
        "Least": "i - 3 * (i / 3)",
        "Lanes": "bvec3(vec3(",
        "Turned": "(turn3 * vec4(",
        "Flipped": "mat4 transpose_(mat4 m) {",
        "Summed": "if (k >= count) { break; }",
        "Chosen": "peaks[k].high",
        "Walked": "if (!(",
    }.items():
        assert written in texts[pass_], f"{pass_}:\n{texts[pass_]}"


def test_the_route_is_drawn_only_if_it_is_named() -> None:
    assert ROUTE not in select(["all"]) and ROUTE not in select(["llvmpipe"])
    assert select(["es100"]) == select(["llvmpipe:es100"]) == (ROUTE,)
    assert ROUTE.name not in ROUTES
