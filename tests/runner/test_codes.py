"""Texts become what a route's driver takes, once; and what is refused is explained."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import pytest

import burnish
from burnish.support.frozen import changed
from burnish.targets.runner.codes import CodeError, Codes, Request, compile_all, compile_one
from burnish.targets.runner.routes import ROUTES, Route
from burnish.targets.toolchain import Job, Toolchain, Verdict, count_instructions, optimise
from burnish.targets.toolchain.spirv import entry_points, instructions

DIVISION = 136
"""OpFDiv."""
PROFILES = sorted({route.profile for route in ROUTES.values()})
DEPTH = "material Depth {\n    depth = frag_coord.w\n    color = vec3(exp(depth), depth, 0)\n}\n"


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


@pytest.fixture(autouse=True)
def empty_store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))


class Counting(Toolchain):
    """Counts what it is asked."""

    asked = 0

    def check(self, jobs: Sequence[Job], *, keep_modules: bool = False) -> list[Verdict]:
        self.asked += len(jobs)
        return super().check(jobs, keep_modules=keep_modules)


def files(text: str = DEPTH, *, single_file: bool = False) -> tuple[burnish.OutputFile, ...]:
    profiles = ["hlsl:sm6", "wgsl:webgpu"] if single_file else PROFILES
    (material,) = burnish.compile(text, profiles, single_file=single_file).materials
    return material.files


def test_every_route_gets_both_stages(toolchain: Toolchain) -> None:
    emitted = files()
    routes = list(ROUTES.values())
    results = compile_all([Request(route, emitted) for route in routes], toolchain)
    for route, codes in zip(routes, results, strict=True):
        assert isinstance(codes, Codes)
        assert list(codes.stages) == ["vertex", "fragment"]
        for stage, code in zip(("vert", "frag"), codes.stages.values(), strict=True):
            if route.compiler:
                assert code.text == ""
                assert (stage, code.entry) in entry_points(code.spirv)
                assert count_instructions(code.spirv) > 1
            else:
                assert code.spirv == b""
                assert code.entry in code.text
    texts = {file.text for file in emitted if (file.target, file.profile) == ("glsl", "es300")}
    webgl = results[routes.index(ROUTES["chromium:webgl2"])]
    assert isinstance(webgl, Codes)
    assert {code.text for code in webgl.stages.values()} == texts


def test_a_text_may_hold_both_stages(toolchain: Toolchain) -> None:
    emitted = files(single_file=True)
    codes = compile_one(ROUTES["lavapipe:wgsl-naga"], emitted, toolchain)
    assert [code.entry for code in codes.stages.values()] == ["vs_main", "fs_main"]
    assert entry_points(codes.stages["vertex"].spirv) >= {("vert", "vs_main")}
    text = compile_one(ROUTES["chromium:webgpu"], emitted, toolchain)
    assert text.stages["vertex"].text == text.stages["fragment"].text


def divisions(route: Route, toolchain: Toolchain) -> int:
    """The number of divisions in the emitted fragment shader after it is optimised."""
    module = optimise(compile_one(route, files(), toolchain).stages["fragment"].spirv)
    return sum(each.opcode == DIVISION for each in instructions(module))


@pytest.mark.parametrize("name", ["lavapipe:hlsl-glslang", "lavapipe:hlsl-dxc"])
def test_hlsl_reads_the_w_of_direct3d_from_vulkan(name: str, toolchain: Toolchain) -> None:
    """The text takes the reciprocal of Direct3D's w, which the flag makes of Vulkan's."""
    route = ROUTES[name]
    assert divisions(route, toolchain) == 0
    assert divisions(replace(route, flags=()), toolchain) == 1


def test_what_was_compiled_is_kept() -> None:
    emitted = files()
    requests = [Request(ROUTES[name], emitted) for name in ("lavapipe:glsl", "lavapipe:hlsl-dxc")]
    with Counting(parallel=1) as first:
        made = compile_all(requests, first)
        assert first.asked == 4
        other = compile_one(replace(requests[1].route, flags=()), emitted, first)
        assert first.asked == 6
        assert other != made[1]
    with Counting(parallel=1) as second:
        assert compile_all(requests, second) == made
        # Both drivers take the same modules.
        swiftshader = compile_one(ROUTES["swiftshader:glsl"], emitted, second)
        assert swiftshader == made[0]
        assert second.asked == 0


def test_a_module_is_kept_for_one_version_of_the_tools(monkeypatch: pytest.MonkeyPatch) -> None:
    route, emitted = ROUTES["lavapipe:glsl"], files()
    with Counting(parallel=1) as toolchain:
        compile_one(route, emitted, toolchain)
        monkeypatch.setattr(toolchain, "versions", lambda _checker: ("99",))
        compile_one(route, emitted, toolchain)
        assert toolchain.asked == 4


def broken(emitted: Sequence[burnish.OutputFile]) -> list[burnish.OutputFile]:
    """The texts with a mistake where the fragment shader reads ``frag_coord``."""
    return [
        changed(file, text=file.text.replace("gl_FragCoord", "gl_Nonsense")) for file in emitted
    ]


def test_a_refused_text_is_explained_and_stops_no_other(toolchain: Toolchain) -> None:
    route, emitted = ROUTES["lavapipe:glsl"], files()
    bad, good = compile_all([Request(route, broken(emitted)), Request(route, emitted)], toolchain)
    assert isinstance(good, Codes)
    assert isinstance(bad, CodeError)
    headline, place, source, *_ = str(bad).splitlines()
    assert headline == "lavapipe:glsl: glslang-vulkan rejects Depth.frag.glsl"
    assert place.startswith("  Depth.frag.glsl:")
    assert "gl_Nonsense" in place
    assert source == "    from <text>:3:13: color = vec3(exp(depth), depth, 0)"
    with pytest.raises(CodeError, match="gl_Nonsense"):
        compile_one(route, broken(emitted), toolchain)


@pytest.mark.usefixtures("no_tools")
@pytest.mark.parametrize("route", [r for r in ROUTES.values() if r.compiler], ids=lambda r: r.name)
def test_a_missing_compiler_is_an_error(route: Route) -> None:
    with Toolchain() as toolchain, pytest.raises(CodeError, match=r"missing.*to install it: "):
        compile_one(route, files(), toolchain)


def test_texts_of_another_profile_will_not_do(toolchain: Toolchain) -> None:
    emitted = [file for file in files() if file.target != "wgsl"]
    with pytest.raises(KeyError, match="no text for wgsl:webgpu"):
        compile_one(ROUTES["lavapipe:wgsl-naga"], emitted, toolchain)
