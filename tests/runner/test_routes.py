"""The table of routes, how people name them, and what each needs."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from burnish.targets import registry
from burnish.targets.runner import routes
from burnish.targets.runner.routes import (
    DRIVERS,
    NARROW_ROUTES,
    ROUTES,
    Route,
    UnknownRouteError,
    select,
)
from burnish.targets.toolchain import CHECKERS
from burnish.targets.toolchain.tools import tool_named


def names(found: tuple[Route, ...]) -> list[str]:
    return [route.name for route in found]


@pytest.mark.parametrize("route", ROUTES.values(), ids=lambda route: route.name)
def test_a_route_is_made_of_what_there_is(route: Route) -> None:
    language, profile = registry.select(route.profile)
    assert route.compiler is None or route.compiler in CHECKERS
    assert route.compiler is None or route.compiler in profile.checkers
    assert (route.compiler is not None) == (DRIVERS[route.driver].module == "vulkan")
    assert all(tool_named(tool).name == tool for tool in route.needs)
    inputs = {**language.inputs, **profile.inputs}
    unknown = {name for name, row in inputs.items() if route.compiler in row.unknown_to}
    assert unknown == route.unknown_inputs


def test_every_profile_that_is_proven_is_drawn_and_every_driver_used() -> None:
    profiles = {
        f"{name}:{profile.name}": profile.on_request
        for name in registry.defaults()
        for profile in registry.load(name).profiles
    }
    for table, on_request in ((ROUTES, False), (NARROW_ROUTES, True)):
        drawn = {route.profile for route in table.values()}
        assert drawn == {name for name, is_such in profiles.items() if is_such == on_request}
    assert {route.driver for route in ROUTES.values()} == DRIVERS.keys()


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        (["all"], list(ROUTES)),
        (["lavapipe:glsl"], ["lavapipe:glsl"]),
        (["chromium"], ["chromium:webgpu", "chromium:webgl2"]),
        (["hlsl-dxc"], ["lavapipe:hlsl-dxc", "swiftshader:hlsl-dxc"]),
        (["lavapipe:hlsl-*"], ["lavapipe:hlsl-glslang", "lavapipe:hlsl-dxc"]),
        (["webgl2, lavapipe:glsl", "lavapipe:glsl"], ["lavapipe:glsl", "chromium:webgl2"]),
        (["wgpu"], ["wgpu:wgsl"]),
        (["vulkan:hlsl-*"], ["vulkan:hlsl-glslang", "vulkan:hlsl-dxc"]),
        ([], []),
    ],
)
def test_routes_are_named_as_people_would(typed: list[str], meant: list[str]) -> None:
    assert names(select(typed)) == meant


@pytest.mark.parametrize(
    ("typed", "hint"),
    [
        ("lavapip:glsl", "did you mean `lavapipe:glsl`?"),
        ("lavapipe,Chromium", "did you mean `chromium`?"),
        ("direct3d12", "there are lavapipe:glsl, "),
        ("*3d*", "there are lavapipe:glsl, "),
    ],
)
def test_an_unknown_route_is_an_error_with_a_way_out(typed: str, hint: str) -> None:
    with pytest.raises(UnknownRouteError, match="there is no route") as error:
        select([typed])
    assert hint in str(error.value)


@pytest.mark.parametrize("route", ROUTES.values(), ids=lambda route: route.name)
def test_which_rows_come_first_is_what_the_profile_says(route: Route) -> None:
    _, profile = registry.select(route.profile)
    assert route.bottom_up == profile.framebuffer.rows_up


def test_what_starts_a_worker() -> None:
    chosen = select(["all"])
    states = routes.inspect_tools(chosen)
    for route in chosen:
        assert routes.problem(route, states) is None
        python, _, _, _, module, *arguments = DRIVERS[route.driver].command(states)
        assert python == sys.executable
        assert find_spec(f"{module}.__main__") is not None
        assert not any("{" in argument for argument in arguments)
    (icd,) = DRIVERS["lavapipe"].command(states)[5:]
    assert Path(icd).name.startswith("lvp_icd")


def test_the_versions_are_those_of_the_tools() -> None:
    (route,) = select(["swiftshader:hlsl-dxc"])
    found = routes.versions(route, routes.inspect_tools([route]))
    assert found.keys() == set(route.needs)
    assert found["dxc"] == "3.7"


@pytest.mark.usefixtures("no_tools")
def test_a_route_without_its_tools_says_what_is_missing() -> None:
    (route,) = select(["lavapipe:wgsl-naga"])
    states = routes.inspect_tools([route])
    problem = routes.problem(route, states) or ""
    for name in ("naga", "spirv-tools", "lavapipe", "vulkan-validation"):
        assert f"{name} is missing" in problem
    assert "; vulkan, numpy, pillow are missing; " in problem
    assert "dxc" not in problem
    assert routes.versions(route, states) == {}


def test_what_a_tool_is_needed_for() -> None:
    assert routes.routes_needing("dxc") == tuple(
        f"{driver}:hlsl-dxc" for driver in ("lavapipe", "swiftshader", "vulkan")
    )
    assert routes.routes_needing("tint") == ()
