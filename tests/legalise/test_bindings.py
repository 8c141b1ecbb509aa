"""One binding model: groups have sets, and numbers in a set are used once."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

import burnish
from burnish.compiler.documents.backends import BindingRow
from burnish.support.frozen import changed
from burnish.targets.legalise.bindings import BindingSlot, assign_bindings
from tests.targets.kit import PROFILES, Selected
from tests.targets.programs import plastic

from .kit import staged

BY_SET = [selected for selected in PROFILES if selected.profile.numbering == "set"]
SEPARATE = [selected for selected in BY_SET if not selected.profile.samplers.combined]
COMBINED = [selected for selected in BY_SET if selected.profile.samplers.combined]


@pytest.mark.parametrize("selected", BY_SET, ids=str)
def test_blocks(selected: Selected) -> None:
    bindings = assign_bindings(plastic(), selected.profile)
    assert bindings.blocks == {
        "View": BindingSlot(0, 1),
        "Rig": BindingSlot(1, 0),
        "DerivedFromRig": BindingSlot(2, 4),
        "Material": BindingSlot(2, 0),
        "Draw": BindingSlot(3, 0),
    }


@pytest.mark.parametrize("selected", SEPARATE, ids=str)
def test_separate_samplers(selected: Selected) -> None:
    bindings = assign_bindings(plastic(), selected.profile)
    assert bindings.textures == {"albedo": BindingSlot(2, 5)}
    assert bindings.samplers == {"albedo": BindingSlot(2, 6)}


MANY = """
    material M {{
        map first : texture2d per draw
        {maps}
        clip_position = vec4(position + first.level(uv, 0).xyz, 1)
        color = {reads}
    }}
"""


def many(count: int) -> str:
    """A material whose fragments read so many textures, every third by another sampler."""
    states = ("", " with { filter = nearest }", " with { wrap = clamp }")
    maps = " ".join(f"map t{i} : texture2d{states[i % 3]}" for i in range(count))
    return MANY.format(maps=maps, reads=" + ".join(f"t{i}(uv).rgb" for i in range(count)))


@pytest.mark.parametrize("selected", SEPARATE, ids=str)
def test_as_many_samplers_as_a_stage_has_are_not_shared(selected: Selected) -> None:
    bindings = assign_bindings(staged(many(16)).program, selected.profile)
    assert bindings.sampler_owners == {name: name for name in bindings.textures}
    assert len(set(bindings.samplers.values())) == 17


@pytest.mark.parametrize("selected", SEPARATE, ids=str)
def test_samplers_of_equal_state_are_shared_where_there_are_more(selected: Selected) -> None:
    """By the stages together: the sampler of the first texture stands in its own set."""
    program = staged(many(17)).program
    bindings = assign_bindings(program, selected.profile)
    owners = {f"t{i}": ("first", "t1", "t2")[i % 3] for i in range(17)}
    assert bindings.sampler_owners == {"first": "first", **owners}
    assert {bindings.samplers[f"t{i}"] for i in range(0, 17, 3)} == {bindings.samplers["first"]}
    places = {*bindings.textures.values(), *bindings.samplers.values()}
    assert len(places) == 18 + 3


def test_a_stage_declares_the_shared_sampler_of_a_texture_that_only_another_reads() -> None:
    (material,) = burnish.compile(many(17), ("hlsl",)).materials
    texts = {file.stage: file.text for file in material.files}
    assert "Texture2D<float4> first :" in texts["vertex"]
    assert "Texture2D<float4> first :" not in texts["fragment"]
    for text in texts.values():
        assert text.count("SamplerState first_sampler : register(s") == 1
    assert texts["fragment"].count("SamplerState ") == 3
    rows = material.reflection.backends["hlsl:sm6"].samplers
    assert rows["t0"] == rows["t3"] == rows["first"] != rows["t1"]


@pytest.mark.parametrize("selected", COMBINED, ids=str)
def test_combined_samplers(selected: Selected) -> None:
    bindings = assign_bindings(plastic(), selected.profile)
    assert bindings.textures == bindings.samplers == {"albedo": BindingSlot(2, 5)}


def test_each_kind_is_numbered_on_its_own_where_there_are_no_sets() -> None:
    profile = changed(SEPARATE[0].profile, numbering="kind")
    bindings = assign_bindings(plastic(), profile)
    numbers = {"View": 1, "Rig": 2, "Material": 3, "DerivedFromRig": 7, "Draw": 8}
    assert bindings.blocks == {name: BindingSlot(0, number) for name, number in numbers.items()}
    assert bindings.textures == bindings.samplers == {"albedo": BindingSlot(0, 0)}


def test_blocks_of_the_host_have_numbers_of_their_own_where_there_are_no_sets() -> None:
    text = """
    extern block Sky per frame at group 0, binding 4 { tint : vec3 at 0 }
    extern block Sea per frame at group 1, binding 4 { depth : float at 0 }
    material M {
        param gain : float = 1
        color = tint * uv.x + depth * uv.y + vec3(gain * uv.x * uv.y)
    }
    """
    program = staged(text).program
    bindings = assign_bindings(program, changed(SEPARATE[0].profile, numbering="kind"))
    assert [bindings.blocks[name] for name in ("Sky", "Sea")] == [
        BindingSlot(0, 0),
        BindingSlot(0, 1),
    ]
    assert {slot.set for slot in bindings.blocks.values()} == {0}
    assert len(set(bindings.blocks.values())) == len(bindings.blocks) > 2


@pytest.mark.parametrize("selected", BY_SET, ids=str)
def test_a_block_of_the_host_stays_where_it_is(selected: Selected) -> None:
    text = """
    extern block Sky per frame at group 2, binding 5 { tint : vec3 at 0 }
    material M {
        param gain : float = 1
        map grain : texture2d
        color = tint * uv.x * gain * grain(uv).rgb
    }
    """
    bindings = assign_bindings(staged(text).program, selected.profile)
    assert bindings.blocks["Sky"] == BindingSlot(2, 5)
    assert bindings.blocks["Material"] == BindingSlot(2, 0)
    assert bindings.textures == {"grain": BindingSlot(2, 6)}


@pytest.mark.parametrize("selected", BY_SET, ids=str)
def test_a_texture_that_is_only_loaded_has_no_sampler(selected: Selected) -> None:
    text = "material M { map grain : texture2d  color = grain.load(ivec2(uv), 0).rgb }"
    bindings = assign_bindings(staged(text).program, selected.profile)
    assert (bindings.textures, bindings.samplers) == ({"grain": BindingSlot(2, 5)}, {})


@pytest.mark.parametrize("selected", SEPARATE, ids=str)
def test_groups_of_the_users_share_a_set(selected: Selected) -> None:
    """WebGPU guarantees four sets, and no number in one is used twice."""
    text = """
    material M {
        param split : float per cascade = 1
        param row   : float per tile = 2
        map shadows : texture2d per cascade
        color = vec3(split * row * uv.x) * sin(split) * cos(row) + shadows(uv).rgb
    }
    """
    name = f"{selected.language.name}:{selected.profile.name}"
    (compiled,) = burnish.compile(text, (name,))
    (backend,) = compiled.reflection.backends.values()
    blocks = {name: (row.group, row.binding) for name, row in backend.blocks.items()}
    assert {name for name, (group, _) in blocks.items() if group == 2} == {
        "Cascade", "CascadeDerived", "Tile", "TileDerived",
    }  # fmt: skip
    every = [*blocks.values(), *_places(backend.textures), *_places(backend.samplers)]
    assert len(set(every)) == len(every)
    assert {group for group, _ in every} <= {0, 1, 2, 3}


def _places(rows: Mapping[str, BindingRow]) -> list[tuple[int | None, int | None]]:
    return [(row.group, row.binding) for row in rows.values()]
