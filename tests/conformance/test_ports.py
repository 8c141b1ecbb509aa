"""Ports of well-known shaders, written from the published formulas: what users bring along.

The examples have shaped the compiler and the bounds; these have not. So they show whether a verdict
holds for materials that nobody has tuned anything for. Here each port is drawn by one route, a
different language from port to port; ``burnish conform tests/conformance/ports/*.burnish`` draws
all of them by all routes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import pytest

import burnish
from burnish.api import entry_points as api
from burnish.api.entry_points import CompiledMaterial
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES, Route
from burnish.targets.toolchain import Job

from ..suite.verdicts import refused
from ..targets.standings import PROFILES as ALL_PROFILES
from .kit import FOLDER, Studio

PORTS = {path.stem: path for path in sorted((FOLDER / "ports").glob("*.burnish"))}
STAGES = {"vertex": "vert", "fragment": "frag"}

FAST = tuple(
    ROUTES[name] for name in ("lavapipe:glsl", "lavapipe:hlsl-glslang", "lavapipe:wgsl-naga")
)
"""A route for each language, on the driver that starts most quickly."""

MAY_PROVE_LITTLE: Mapping[str, str] = {
    "hologram": "fract(sin(x) * 43758.5) keeps the last bits of a sine: noise, on purpose",
    "parallax_occlusion": "a white relief is as high as the ray is at first: x > x",
}
"""Ports of which some material has too many pixels whose bounds say nothing, and why.

On SwiftShader, whose sine is off by 2e-4, there are four more: `gtao`, which turns its slices by
noise, `procedural`, whose wood has rings at a sine, and `ocean` and `terrain`, which move vertices.
"""


def subjects(name: str, *profiles: str) -> Iterator[tuple[str, CompiledMaterial]]:
    """Every material of a port, with each of its rigs and passes."""
    for rig, pass_ in api.variants(PORTS[name]):
        result = burnish.compile(PORTS[name], profiles, rig=rig, pass_=pass_)
        assert not result.diagnostics
        for material in result.materials:
            yield f"{name} {material.name} {rig} {pass_}", material


def jobs(name: str) -> Iterator[Job]:
    """A job for each text of a port and each of its checkers."""
    for _, material in subjects(name, *ALL_PROFILES):
        for file in material.files:
            for stage, entry in file.entry_points.items():
                for checker in file.checkers:
                    yield Job(checker, STAGES[stage], file.text, entry, file.name)


@pytest.mark.parametrize("name", PORTS)
def test_every_compiler_accepts_it(name: str, studio: Studio) -> None:
    asked = list(jobs(name))
    found = refused(asked, studio.toolchain)
    assert not found, "\n".join(verdict.report() for verdict in found)
    assert len(asked) >= len(ALL_PROFILES) * len(STAGES)


def route_of(name: str) -> Route:
    """The route by which a port is drawn here."""
    return FAST[list(PORTS).index(name) % len(FAST)]


@pytest.mark.parametrize("name", PORTS)
def test_no_false_alarm(name: str, studio: Studio) -> None:
    route = route_of(name)
    drawn = list(subjects(name, route.profile))
    rows = conform(drawn, [route], studio.runner, studio.toolchain)
    allowed = {"agrees", "proves little"} if name in MAY_PROVE_LITTLE else {"agrees"}
    for row in rows:
        assert row.status in allowed, f"{row.material}: {row.status}\n" + "\n".join(details(row))


def test_the_list_names_ports() -> None:
    assert set(MAY_PROVE_LITTLE) <= set(PORTS)
