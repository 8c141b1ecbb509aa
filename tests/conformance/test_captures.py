"""Every route captures what the reference computes, by a stream output or by a kernel.

Both forms are two ways to one list of vertices: where nothing is rounded, they are the same to the
last bit. And what is captured is a mesh again, which is drawn like any other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from pkgutil import resolve_name
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.ir import build
from burnish.compiler.ir.types import BOOL, UINT
from burnish.support.frozen import changed
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.runner.capturing import Vertices, capture
from burnish.targets.runner.drivers.frame_job import Captured
from burnish.targets.runner.frames.states import Outcome
from burnish.targets.runner.meshes import MeshError, cube, plane
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import SceneState, set_up

from .kit import Studio

FILE = Path(__file__).with_name("captures.burnish")
PLAIN = (
    "lavapipe:glsl", "lavapipe:hlsl-glslang", "lavapipe:hlsl-dxc", "llvmpipe:gl330",
    "llvmpipe:gl450", "llvmpipe:es310", "chromium:webgl2",
)  # fmt: skip
"""The routes with a stream output."""
EXPANDED = PLAIN[:4]
"""The routes with a stream output and a geometry stage."""
KERNELS = (
    "lavapipe:glsl", "lavapipe:hlsl-glslang", "lavapipe:hlsl-dxc", "lavapipe:wgsl-naga",
    "llvmpipe:gl450", "llvmpipe:es310", "chromium:webgpu",
)  # fmt: skip
"""The routes that run kernels."""
DIVIDED = (*PLAIN[:3], PLAIN[4])
"""The routes with a stream output that divide patches by stages."""
NAMES = ("Plain", "Tent", "Sparks", "Whiskers")
PATCHES = ("Blanket", "Strings", "Crumbs")
"""Materials that divide patches."""
WORK = [
    *(("Plain", route) for route in PLAIN),
    *((name, route) for name in NAMES[1:] for route in EXPANDED),
    *(("Blanket", route) for route in DIVIDED),
    *((name, "lavapipe:glsl") for name in PATCHES[1:]),
]


@lru_cache(maxsize=2)
def compiled(*, native: bool) -> burnish.CompileResult:
    profiles = sorted({ROUTES[route].profile for route in (PLAIN if native else KERNELS)})
    return burnish.compile(FILE, profiles, pass_="Captured", partial=True, native_stages=native)


@pytest.mark.parametrize(("name", "route"), WORK)
def test_stream_outputs_agree(studio: Studio, name: str, route: str) -> None:
    agrees(studio, compiled(native=True)[name], route)


@pytest.mark.parametrize(
    ("name", "route"),
    [
        *((name, route) for name in NAMES for route in KERNELS),
        *((name, "lavapipe:wgsl-naga") for name in PATCHES),
        ("Strings", "llvmpipe:es310"),
        ("Crumbs", "chromium:webgpu"),
    ],
)
def test_kernels_agree(studio: Studio, name: str, route: str) -> None:
    agrees(studio, compiled(native=False)[name], route)


def agrees(studio: Studio, material: CompiledMaterial, route: str) -> None:
    """Compares a capture with the vertices that the reference computes by the lowered kernel."""
    work = [(material.name, material)]
    meant = {material.name: compiled(native=False)[material.name]}
    (row,) = conform(work, [ROUTES[route]], studio.runner, studio.toolchain, meant=meant)
    assert row.status == "agrees", "\n".join(details(row)) or row.problem
    assert row.proven > 1000


def test_what_stages_divide_is_compared_with_another_form_only(studio: Studio) -> None:
    material = compiled(native=True)["Blanket"]
    route = ROUTES["lavapipe:glsl"]
    (row,) = conform([("Blanket", material)], [route], studio.runner, studio.toolchain)
    assert (row.status, row.problem) == (
        "failed",
        "Blanket has other stages than the reference captures: only routes capture it",
    )


def state_of(material: CompiledMaterial) -> SceneState:
    mesh = with_inputs(material.reflection, plane(2))
    return set_up(material.instance(), mesh, Scene(), (4, 4))


def captured(studio: Studio, text: str, route: str = "lavapipe:glsl", **options: Any) -> Vertices:
    profile = ROUTES[route].profile
    (material,) = burnish.compile(text, profile, pass_="Moved", **options).materials
    state = state_of(material)
    return capture(material, state, ROUTES[route], studio.runner, studio.toolchain)


EXACT = {
    "as they are": "",
    "a long strip": """expand point { strip of 6 as i where primitive_index mod 2u == 0u {
        position = corner[0].position + 0.0625 * vec3(float(i), float(i mod 2) * 2, float(i))
        mark     = i
    } }""",
    "groups": """expand triangle {
        strip of 3 as i { mark = 1 }
        list of 6 as i for s in 0..count where corner[s].uv.x > 0.4 like corner[i mod 3] {
            position = inherited.position + vec3(0.125, 0.25, 0.5) * float(s + i / 3)
            mark     = 10 * s + i
        }
    }""",
    "lines": """expand triangle {
        line of 4 as i for s in 0..count where corner[s].uv.x > 0.4 like corner[i mod 3] {
            position = inherited.position + vec3(0.125, 0.25, 0.5) * float(s + i)
            mark     = 10 * s + i
        }
    }""",
    "patches": """tessellate triangle by 4 as at {
        position = inherited.position + 0.25 * vec3(at.x, at.y, 0)
        mark     = int(64 * at.x + 8 * at.y)
    }""",
    "lines of patches": """tessellate isoline by 2 * (1 + end[0].uv.x + end[1].uv.x) lines 4 as at {
        position = inherited.position + vec3(0, 0, at.y)
        mark     = int(64 * at.x + 8 * at.y)
    }""",
    "parts of patches": """tessellate quad by 2 as at { mark = int(64 * at.x + 8 * at.y) }
    expand triangle {
        line of 3 as i for s in 0..count where corner[s].uv.x > 0.4 like corner[i] {
            position = inherited.position + vec3(0, 0, 0.5)
        }
    }""",
    "points": """expand line {
        points of 1 as i for s in 0..count like corner[1] { mark = s }
        points of 3 as i where corner[0].uv.y < 0.4 like corner[i mod 2] { mark = 100 + i }
    }""",
}
"""Expansions whose numbers are small multiples of powers of two."""
TEXT = """
material M {{
    param count : int in 0..2 = 2
    attribute bend : mat2 per instance
    mark : int = 0
    {}
    color = vec3(1)
}}
pass Moved {{
    capture mark     : int = mark
    capture position : vec3 = position
    capture number   : uvec2 = uvec2(vertex_index, instance_index)
    capture corner   : vec2 = bend * uv
}}
"""


@pytest.mark.parametrize("name", EXACT)
def test_both_forms_capture_the_same(studio: Studio, name: str) -> None:
    """This holds for a mesh that is drawn in several instances, too."""
    text = TEXT.format(EXACT[name])
    native = captured(studio, text, native_stages=True)
    lowered = captured(studio, text)
    assert native.count == lowered.count > 20
    for member, values in native.members.items():
        assert (values == lowered.members[member]).all(), member
    assert len(np.unique(native.members["number"][:, 1])) > 1


def test_points_come_in_the_order_of_the_mesh_and_only_where_they_are_emitted(
    studio: Studio,
) -> None:
    text = """
    material Dust { number : uint = 0u  expand point {
        points of 2 as i where primitive_index mod 3u == 1u {
            number = 10u * primitive_index + uint(i)
        }
    }  color = vec3(1) }
    pass Moved { capture number : uint = number }
    """
    forms = [*((route, True) for route in EXPANDED), ("lavapipe:wgsl-naga", False)]
    for route, is_native in forms:
        found = captured(studio, text, route, native_stages=is_native)
        assert found.primitive == "point"
        assert found.members["number"].tolist() == [[10], [11], [40], [41], [70], [71]], route


def test_of_lines_both_ends_of_each_segment_are_captured(studio: Studio) -> None:
    text = """
    material Dust { number : int = 0  expand point {
        line of 3 as i for n in 0..2 where primitive_index == 4u { number = 10 * n + i }
    }  color = vec3(1) }
    pass Moved { capture number : int = number }
    """
    forms = [*((route, True) for route in EXPANDED), ("lavapipe:wgsl-naga", False)]
    for route, is_native in forms:
        found = captured(studio, text, route, native_stages=is_native)
        assert found.primitive == "line"
        numbers = found.members["number"].reshape(-1, 2).tolist()
        assert numbers == [[0, 1], [1, 2], [10, 11], [11, 12]], route


def test_triangles_are_captured_corner_by_corner(studio: Studio) -> None:
    """A vertex that triangles share is there for each of them; the first one stays the first."""
    text = """
    material Dust { color = vec3(1) }
    pass Moved { capture number : int = int(vertex_index)  capture corner : vec2 = uv }
    """
    whole = plane(2).triangles.reshape(-1)
    native = ("lavapipe:glsl", "lavapipe:hlsl-dxc", "llvmpipe:gl330", "llvmpipe:gl450")
    for route, is_native in [*((name, True) for name in native), ("lavapipe:wgsl-naga", False)]:
        found = captured(studio, text, route, native_stages=is_native)
        assert found.count == len(whole)
        assert found.members["number"][:, 0].tolist() == whole.tolist()
        assert (found.members["corner"] == plane(2).channels["uv"][whole]).all()


@pytest.mark.parametrize("route", PLAIN)
def test_nothing_is_captured_of_no_primitives(studio: Studio, route: str) -> None:
    """Where there is nothing to draw, such as patches of level 0, a draw has no indices."""
    text = "material Dust { color = vec3(1) } pass Moved { capture corner : vec2 = uv }"
    profile = ROUTES[route].profile
    (material,) = burnish.compile(text, profile, pass_="Moved", native_stages=True).materials
    state = replace(state_of(material), triangles=np.zeros((0, 3), np.int64))
    found = capture(material, state, ROUTES[route], studio.runner, studio.toolchain)
    assert found.count == 0
    assert found.members["corner"].shape == (0, 2)


def test_what_is_captured_is_drawn_again(studio: Studio) -> None:
    """Captured triangles are a mesh: captured once more unchanged, they are the same."""
    text = """
    material Dust { attribute heat : float  color = vec3(1)  hot = @vertex (heat + 1) }
    pass Moved { capture position : vec3 = position  capture heat : float = hot }
    """
    profile = ROUTES["llvmpipe:gl450"].profile
    (material,) = burnish.compile(text, profile, pass_="Moved", native_stages=True).materials
    first = with_inputs(material.reflection, cube())
    before = first
    for step in range(3):
        state = set_up(material.instance(), before, Scene(), (4, 4))
        found = capture(material, state, ROUTES["llvmpipe:gl450"], studio.runner, studio.toolchain)
        before = found.mesh()
        assert found.count == before.triangles.size == 36
        corners = first.triangles.reshape(-1)
        assert (found.members["position"] == first.channels["position"][corners]).all()
        heat = np.float32(first.channels["heat"][corners]) + np.float32(step + 1)
        assert np.allclose(found.members["heat"], heat, atol=1e-6)


def test_vertices_without_a_position_are_no_mesh(studio: Studio) -> None:
    text = "material Dust { color = vec3(1) } pass Moved { capture number : float = uv.x }"
    with pytest.raises(MeshError, match="captured `position`"):
        captured(studio, text).mesh()


Change = Callable[[Any], Callable[..., Any]]
"""Makes something wrong of a function that is right."""


def _shifted(right: Any) -> Callable[..., Any]:
    """Each output is written where the one before it belongs."""

    def found(*given: Any) -> Any:
        stream = right(*given)
        offsets = [0, *(output.offset for output in stream.outputs)]
        pairs = zip(stream.outputs, offsets, strict=False)
        moved = tuple(replace(output, offset=offset) for output, offset in pairs)
        return replace(stream, outputs=moved)

    return found


def _one_place_on(right: Any) -> Callable[..., Any]:
    """A kernel writes the first two numbers of a vertex in each other's place."""

    def found(self: Any, expressions: Any, store: Any, value: Any) -> Any:
        exchanged = {0: 1, 1: 0}.get(store.offset, store.offset)
        return right(self, expressions, changed(store, offset=exchanged), value)

    return found


def _member_later(right: Any) -> Callable[..., Any]:
    return lambda words, row: right(words, changed(row, offset=row.offset ^ 4))


def _all_there(_right: Any) -> Callable[..., Any]:
    """Keeps also the vertices that no strip emits."""

    def found(state: SceneState, outcome: Outcome) -> Captured:
        capture = state.instance.reflection.capture
        assert capture is not None
        stride = capture.stride
        (data,) = outcome.elements.values()
        words = np.frombuffer(data, np.uint8).reshape(state.instance.extent(), -1)
        return Captured(len(words), words[:, :stride].tobytes())

    return found


def _never_turned(_right: Any) -> Callable[..., Any]:
    """The triangles of a strip all go around alike."""
    return lambda group: [t + n for t in range(group.listed_each // 3) for n in range(3)]


def _one_line(right: Any) -> Callable[..., Any]:
    """The segments of a line do not begin where the one before ends."""
    return lambda group: list(range(group.listed_each)) if group.shape == "line" else right(group)


def _next_corner(right: Any) -> Callable[..., Any]:
    return lambda lanes, corner, corners: right(lanes, corner, np.roll(corners, 1, axis=1))


def _converted(_right: Any) -> Callable[..., Any]:
    """Floats are written as whole numbers, and not as their bits."""
    return lambda shader, value: (
        value if value.type == UINT else shader.graph.node("native", UINT, (value,), "to_uint")
    )


def _always_there(_right: Any) -> Callable[..., Any]:
    """A patch has as many vertices as a patch can have at most."""
    return lambda self, _number: build.constant(self._shader.graph, BOOL, True)


def _no_end(_right: Any) -> Callable[..., Any]:
    """The triangles of a list are one strip."""
    return lambda _group: False


NOTICED: Mapping[str, tuple[str, str, str, Change]] = {
    "outputs where others belong": (
        "Plain", "lavapipe:hlsl-dxc", "runner.binding._stream_output", _shifted,
    ),
    "a member read elsewhere": (
        "Plain", "llvmpipe:gl330", "runner.capturing._member", _member_later,
    ),
    "a list as one strip": ("Tent", "lavapipe:glsl", "emit.strips._stands_alone", _no_end),
    "numbers in each other's place": (
        "Plain", "lavapipe:wgsl-naga", "emit.stage.StagePrinter._store", _one_place_on,
    ),
    "vertices that are not there": (
        "Sparks", "lavapipe:wgsl-naga", "runner.capturing._compacted", _all_there,
    ),
    "no bits of floats": (
        "Plain", "lavapipe:wgsl-naga", "..compiler.passes.split_stages._bits_of", _converted,
    ),
    "the reference does not turn": (
        "Tent", "lavapipe:glsl", "..compiler.reference.capture._listed", _never_turned,
    ),
    "the reference shares no ends of lines": (
        "Whiskers", "lavapipe:glsl", "..compiler.reference.capture._listed", _one_line,
    ),
    "the reference reads the next corner": (
        "Tent", "lavapipe:glsl", "..compiler.reference.capture._at_corner", _next_corner,
    ),
}  # fmt: skip
"""Planted errors that ``conform`` has to notice: a material, a route, what is changed, and how."""


def place(path: str) -> str:
    """The whole name of something in ``targets``, or in the folder beside it."""
    return path.replace("..", "burnish.") if path.startswith("..") else f"burnish.targets.{path}"


@pytest.mark.parametrize("error", NOTICED)
def test_planted_errors_are_noticed(
    studio: Studio, error: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    name, route, path, change = NOTICED[error]
    plant(monkeypatch, place(path), change)
    (material,) = burnish.compile(
        FILE, ROUTES[route].profile, material=name, pass_="Captured",
        native_stages="wgsl" not in route,
    ).materials  # fmt: skip
    (row,) = conform([(name, material)], [ROUTES[route]], studio.runner, studio.toolchain)
    assert row.status == "differs", row.problem


def plant(patch: pytest.MonkeyPatch, path: str, change: Change) -> None:
    """Replace a function by what ``change`` makes of it."""
    owner, _, name = path.rpartition(".")
    holder: Any = resolve_name(owner)
    patch.setattr(holder, name, change(getattr(holder, name)))


def _of_next(right: Any) -> Callable[..., Any]:
    return lambda row, state: np.roll(right(row, state), 1, axis=0)


def _first_of_all(_right: Any) -> Callable[..., Any]:
    return lambda self, _number: self._number(0)


def _never_empty(_right: Any) -> Callable[..., Any]:
    return lambda _self, _results: None


APART: Mapping[str, tuple[str, str, Change]] = {
    "a mesh that begins elsewhere": ("as they are", "runner.capturing._of_elements", _of_next),
    "every strip is the first": (
        "points", "..compiler.passes.lower_expansion.EmittedNumbers._strip", _first_of_all,
    ),
    "vertices that patches do not have": (
        "lines of patches", "..compiler.passes.patch_vertices.PatchVertices.is_there",
        _always_there,
    ),
    "conditions are forgotten": (
        "groups", "..compiler.passes.lower_expansion._Lowering.drawn", _never_empty,
    ),
}  # fmt: skip
"""Planted errors that only the comparison of both forms can notice, since the reference evaluates
what the lowering has made."""


@pytest.mark.parametrize("error", APART)
def test_the_comparison_of_both_forms_notices(
    studio: Studio, error: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    name, path, change = APART[error]
    native = captured(studio, TEXT.format(EXACT[name]), native_stages=True)
    plant(monkeypatch, place(path), change)
    lowered = captured(studio, TEXT.format(EXACT[name]))
    assert native.count != lowered.count or any(
        (values != lowered.members[member]).any() for member, values in native.members.items()
    )
