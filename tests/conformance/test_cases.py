"""The pictures by which materials are compared have in them what they say."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import burnish
from burnish.compiler.documents.reflection import Reflection
from burnish.targets.conformance.cases import SIZE, UNCOVERED, Case, series_of
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.patches import pattern

from ..examples.kit import FOLDER

Floats = NDArray[np.float64]


@cache
def reflection_of(name: str, material: str, pass_: str | None = None) -> Reflection:
    """An example's."""
    return burnish.compile(FOLDER / f"{name}.burnish", (), pass_=pass_)[material].reflection


@cache
def cases_of(name: str, material: str) -> dict[str, Case]:
    """An example's cases with exact targets, by name."""
    (series,) = (s for s in series_of(reflection_of(name, material)) if s.exact)
    return {case.name: case for case in series.cases}


def test_native_stages_draw_the_meshes_of_what_they_are_compared_with() -> None:
    """Without them a patch whose levels differ has many vertices, so that meshes have few."""
    (native,) = burnish.compile(
        FOLDER / "level_of_detail.burnish", (), native_stages=True
    ).materials
    lowered = reflection_of("level_of_detail", native.name)
    for own, like in zip(
        series_of(native.reflection, like=lowered), series_of(lowered), strict=True
    ):
        for case, other in zip(own.cases, like.cases, strict=True):
            patches = len(other.state.attributes["corner0.vertex_position"])
            assert len(case.state.triangles) == patches


def plastic(case: str) -> Case:
    return cases_of("plastic", "Plastic")[case]


def matrix(instance: Instance, name: str) -> Floats:
    """A matrix with its rows and columns as in mathematics."""
    return np.array(instance.get(name)).T


def clip_positions(case: Case) -> Floats:
    """The clip positions of the corners of all triangles, (triangles, 3, 4)."""
    instance = case.state.instance
    places = case.state.attributes["vertex_position"]
    whole = np.concatenate([places, np.ones((len(places), 1))], axis=1)
    to_clip = matrix(instance, "view_projection") @ matrix(instance, "object_to_world")
    positions: Floats = (whole @ to_clip.T)[case.state.triangles]
    return positions


def areas(case: Case) -> Floats:
    """Twice the signed area of the triangles before the eye, positive counter-clockwise."""
    corners = clip_positions(case)
    corners = corners[(corners[..., 3] > 0.1).all(axis=1)]
    places = corners[..., :2] / corners[..., 3:]
    (ax, ay), (bx, by), (cx, cy) = (places[:, i].T for i in range(3))
    found: Floats = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return found


def light_places(case: Case) -> list[Any]:
    instance = case.state.instance
    used = instance.get("lamps")[: instance.get("lamps.count")]
    return [*(lamp["place"] for lamp in used), instance.get("torch.place")]


@pytest.mark.parametrize("level", [8, 26, 53, 64])
def test_draws_of_finely_divided_patches_have_fewer_of_them(tmp_path: Path, level: int) -> None:
    """llvmpipe draws wrongly what has more than 65536 vertices of patches."""
    source = tmp_path / "round.burnish"
    source.write_text(
        "import std.tessellation.{PNTriangles}\n"
        f"material Round : Surface + PNTriangles {{ color = vec3(uv, 1)  detail = {level}.0 }}\n",
        encoding="utf-8",
    )
    lowered = burnish.compile(source, ())["Round"].reflection
    native = burnish.compile(source, (), native_stages=True)["Round"].reflection
    places, _ = pattern("triangle", "equal", (level, level, level), (level,))
    (series,) = series_of(native, like=lowered)
    for case in series.cases:
        patches = len(case.state.triangles)
        assert 12 <= patches <= 65536 / len(places), case.name


def test_names_are_told_apart() -> None:
    assert list(cases_of("plastic", "Plastic")) == ["defaults", "stretched", "behind", "inside"]


def test_pictures_are_not_square() -> None:
    assert SIZE[0] != SIZE[1]
    for case in cases_of("plastic", "Plastic").values():
        assert (case.state.width, case.state.height) == SIZE
        assert case.state.clear == (UNCOVERED,)


def test_defaults_are_among_them() -> None:
    given = plastic("defaults").state.instance
    assert given.get("power") == 48.0 and given.get("albedo") is None
    assert plastic("stretched").state.instance.get("power") != 48.0


def test_no_lights_and_all_lights() -> None:
    counts = {name: case.state.instance.get("lamps.count")
              for name, case in cases_of("plastic", "Plastic").items()}  # fmt: skip
    assert counts["behind"] == 0
    assert counts["stretched"] == 8
    assert 0 < counts["defaults"] < 8


def test_scale_is_not_uniform() -> None:
    linear = matrix(plastic("stretched").state.instance, "object_to_world")[:3, :3]
    scales = np.linalg.svd(linear, compute_uv=False)
    assert scales[0] > 1.3 * scales[1] > 1.3 * scales[2]
    assert np.linalg.det(linear) > 0
    assert abs(linear - linear.T).max() > 0.1


def test_lights_are_inside_the_mesh() -> None:
    case = plastic("stretched")
    vertices = case.state.attributes["vertex_position"]
    world = vertices @ matrix(case.state.instance, "object_to_world")[:3, :3].T
    reach = np.linalg.norm(world, axis=1).max()
    for place in light_places(case):
        assert np.linalg.norm(place) < reach / 2


def test_back_faces_are_seen() -> None:
    assert (areas(plastic("behind")) < 0).all()
    assert (areas(plastic("inside")) < 0).any()
    assert (areas(plastic("defaults")) > 0).any()


def test_walls_are_cut_by_near_and_far_plane_and_stand_behind_the_eye() -> None:
    _, _, z, w = np.moveaxis(clip_positions(plastic("inside")), -1, 0)
    assert ((z < 0).any(axis=1) & (z > 0).any(axis=1)).any()
    assert ((z > w) & (w > 0)).any()
    assert (w < 0).any()


def test_the_rest_is_between_the_planes() -> None:
    for name in ("defaults", "stretched", "behind"):
        _, _, z, w = np.moveaxis(clip_positions(plastic(name)), -1, 0)
        assert ((z > 0) & (z < w)).all()


@pytest.mark.parametrize(
    ("name", "material"),
    [
        ("plastic", "Plastic"),
        ("properties", "Mapped"),
        ("own_light", "Screen"),
        ("gold", "TarnishedGold"),
    ],
)
def test_every_texture_has_a_picture(name: str, material: str) -> None:
    for case in ("stretched", "behind", "inside"):
        instance = cases_of(name, material)[case].state.instance
        for row in instance.reflection.textures:
            texels = instance.textures()[row.name].linear()[0]
            assert len(texels) > 1 and np.ptp(texels) > 0.2


def test_seeds_change_values_but_not_the_defaults() -> None:
    reflection = reflection_of("plastic", "Plastic")
    (first,), (second,) = series_of(reflection, 0), series_of(reflection, 1)
    before, after = ([case.state.draw() for case in s.cases] for s in (first, second))
    assert before[0] == after[0]
    assert all(a != b for a, b in zip(before[1:], after[1:], strict=True))


def test_what_blends_is_drawn_both_ways() -> None:
    exact, declared = series_of(reflection_of("blending", "Glass", "Transparent"))
    assert exact.exact and not declared.exact
    assert UNCOVERED not in declared.cases[0].state.clear
    (only,) = series_of(reflection_of("blending", "Glass", "Forward"))
    assert only.exact


def test_several_samples_are_drawn_and_single_ones() -> None:
    text = "material Grey { color = vec3(0.5) }\npass Smooth : Forward { raster { samples = 4 } }"
    (grey,) = burnish.compile(text, (), pass_="Smooth").materials
    exact, declared = series_of(grey.reflection)
    assert [exact.exact, declared.exact] == [True, False]
    drawn = [each.shader.render_state for each in (Exact.of(grey), grey)]
    assert [state.samples for state in drawn] == [1, 4]
