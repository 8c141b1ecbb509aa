"""Blocks of the host's: what their members mean, and where they lie."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.compiler.documents.backends import BindingRow, BlockBindingRow
from burnish.compiler.ir.types import Array, Vector

from .kit import color, shader

BLOCK = """
extern block PerFrame per frame at group 0, binding 3 {
    places : vec3[2] at 48              /// Of what
    time   : float at 0 = 2
    tint   : rgb at 16 = #ff0000
    far    : float at 200 = 3
}
"""


def test_members_are_names_of_the_file() -> None:
    text = f"{BLOCK} fn late() -> float = 10 * time\nmaterial M {{ color = tint * late() + far }}"
    assert color(text) == pytest.approx((23, 3, 3))


def test_a_library_name_is_bound_by_an_equation() -> None:
    text = f"{BLOCK} material M {{ eye = places[1]  color = vec3(eye) }}"
    whole = shader(text)
    assert "eye" not in [info.leaf.name for info in whole.parameters]
    assert color(text, {"PerFrame.places": ((1, 2, 3), (4, 5, 6))}) == (4, 5, 6)


def test_a_slot_hides_a_member_of_its_name() -> None:
    assert color(f"{BLOCK} material M {{ time = 7  color = vec3(time) }}") == (7, 7, 7)


def test_a_members_parameter_is_called_after_its_block() -> None:
    """A material may have a parameter of the same name as the member."""
    text = f"{BLOCK} material M {{ param far : float = 1  color = vec3(far + scale) }} scale = 2"
    names = [info.leaf.name for info in shader(text).parameters]
    assert {"far", "PerFrame.far"} <= {*names}


def test_the_block_lies_as_it_is_declared() -> None:
    (compiled,) = burnish.compile(
        f"{BLOCK} material M {{ color = tint * uv.x + far * uv.y }}", ("glsl", "hlsl", "wgsl")
    )
    (block, *_) = compiled.reflection.blocks
    offsets = {row.parameter: row.offset for row in block.members if row.parameter}
    assert (block.name, block.extern, block.size) == ("PerFrame", True, 208)
    assert offsets == {
        "PerFrame.time": 0, "PerFrame.tint": 16, "PerFrame.places": 48, "PerFrame.far": 200,
    }  # fmt: skip
    end = 0
    for row in block.members:
        assert row.offset == end
        end += row.size
    for backend in compiled.reflection.backends.values():
        place = backend.blocks["PerFrame"]
        assert place.members == {name: name for name in ("time", "tint", "places", "far")}
        assert (place.group, place.binding) == (0, 3)


def test_wide_gaps_are_filled_by_rows() -> None:
    (compiled,) = burnish.compile(
        f"{BLOCK} material M {{ color = tint * uv.x + far * uv.y }}", ("wgsl",)
    )
    (block, *_) = compiled.reflection.blocks
    fillers = [row.type for row in block.members if row.parameter is None]
    assert fillers.count(str(Array(Vector("float", 4), 7))) == 1
    assert len(fillers) < 10


def test_our_own_blocks_and_textures_have_other_places() -> None:
    text = """
    extern block Material per frame at group 2, binding 6 { gain : float at 0 }
    extern block Two per view at group 0, binding 2 { zoom : float at 0 }
    material M {
        param tint : rgb per frame = #fff
        param far  : float = 2
        map albedo : texture2d
        color = tint * far * (gain + uv.x) * zoom * albedo(uv).rgb
    }
    """
    (compiled,) = burnish.compile(text, ("wgsl",))
    (backend,) = compiled.reflection.backends.values()
    rows: list[BindingRow | BlockBindingRow] = [
        *backend.blocks.values(), *backend.textures.values(), *backend.samplers.values()
    ]  # fmt: skip
    places = [(row.group, row.binding) for row in rows]
    assert len(set(places)) == len(places)
    assert {(2, 6), (0, 2)} <= set(places)
    assert len(compiled.reflection.blocks) == len(backend.blocks)


OCCUPIED = """
extern block PerView per view at group 0, binding 1 { zoom : float at 0 }
material M { color = vec3(zoom) }
"""


def test_a_place_that_is_occupied_is_told() -> None:
    with pytest.raises(burnish.CompileError) as failed:
        burnish.compile(OCCUPIED, ("wgsl", "glsl:gl450"))
    (found,) = failed.value.diagnostics
    assert (found.rule.code, found.message) == (
        "B0709",
        "`PerView` and `View` both have binding 1 of group 0 for wgsl:webgpu",
    )
    assert found.span is not None
    assert found.span.text == "PerView"
    burnish.compile(OCCUPIED, ("wgsl",), bindings={"first": {"view": 2}})


def test_a_place_is_free_where_the_group_has_no_block() -> None:
    text = OCCUPIED.replace("binding 1", "binding 0")
    (compiled,) = burnish.compile(text, ("wgsl",))
    (first, *_) = compiled.reflection.backends["wgsl:webgpu"].layouts
    assert [(entry.binding, entry.name) for entry in first.entries] == [(0, "PerView"), (1, "View")]


def test_members_are_imported_by_name(tmp_path: Path) -> None:
    (tmp_path / "engine.burnish").write_text(BLOCK, encoding="utf-8")
    file = tmp_path / "own.burnish"
    file.write_text('import "engine.burnish".{tint}\nmaterial M { color = tint }', encoding="utf-8")
    (compiled,) = burnish.compile(file, ("glsl",))
    assert [row.name for row in compiled.reflection.blocks if row.extern] == ["PerFrame"]


def test_what_depends_on_the_hosts_block_alone_is_still_hoisted() -> None:
    (compiled,) = burnish.compile(f"{BLOCK} material M {{ color = tint * sin(time) }}", ("wgsl",))
    (derived,) = compiled.reflection.derived
    assert (derived.group, derived.block) == ("frame", "DerivedFromFrame")


@pytest.mark.parametrize(
    ("text", "codes"),
    [
        ("extern block A at group 0, binding 0 { x : float at 0 = x }", ["B0406"]),
        ("extern block A at group 0, binding 0 { x : float at 0 }  x = 1", ["B0202"]),
        ("extern block A at group 0, binding 0 { x : texture2d at 0 }", ["B0301"]),
        ("extern block A at group 0, binding 0 { x : flaot at 0 }  y = x", ["B0201"]),
        ("extern block A at group 0, binding 0 { x : vec3 at 4 }  fn f() -> vec3 = x", ["B0440"]),
        ("extern block A at group 0, binding 0 {}  material M { color = A }", ["B0209"]),
        ("extern block A at group 0, binding 0 { x : vec3 at 0 }  material M { color = x(1) }",
         ["B0307"]),
    ],
)  # fmt: skip
def test_mistakes_around_blocks_are_told_once(text: str, codes: list[str]) -> None:
    assert [found.rule.code for found in burnish.check(text)] == codes


def test_two_blocks_of_one_name_cannot_meet(tmp_path: Path) -> None:
    (tmp_path / "engine.burnish").write_text(BLOCK, encoding="utf-8")
    file = tmp_path / "own.burnish"
    text = "extern block PerFrame at group 1, binding 0 { gain : float at 0 }"
    file.write_text(
        f'import "engine.burnish".{{tint}}\n{text}\nmaterial M {{ color = tint * gain }}',
        encoding="utf-8",
    )
    assert [found.rule.code for found in burnish.check(file)] == ["B0202"]
