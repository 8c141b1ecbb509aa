"""Blocks lie where they are expected to, and where all three rule sets would put them."""

from __future__ import annotations

import pytest
from hypothesis import given

from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.program import Block
from burnish.compiler.ir.storage import byte_size, stored_type
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    INT,
    UINT,
    VEC2,
    VEC3,
    VEC4,
    Array,
    Matrix,
    Struct,
    TextureType,
    Type,
    Vector,
    square,
)
from burnish.compiler.layout import layout_blocks

from .declarations import parameters, types
from .oracles import D3D, STD140, WGSL, Rules, end_of, wgsl_uniform_violations


def block_of(*types_: Type) -> Block:
    """The one block of parameters ``a``, ``b``, … of these types."""
    names = "abcdefgh"
    made = [Parameter(names[i], type_, "material") for i, type_ in enumerate(types_)]
    (block,) = layout_blocks(made)
    return block


def rows(block: Block) -> list[tuple[int, str, str]]:
    return [(member.offset, str(member.type), member.name) for member in block.members]


def stored_members(block: Block) -> list[tuple[str, Type]]:
    return [(member.name, member.type) for member in block.members]


def test_a_gap_before_a_vector_is_a_member() -> None:
    assert rows(block_of(FLOAT, VEC2, FLOAT, VEC3, FLOAT)) == [
        (0, "float", "a"),
        (4, "float", "material_pad_0"),
        (8, "vec2", "b"),
        (16, "float", "c"),
        (20, "float", "material_pad_1"),
        (24, "float", "material_pad_2"),
        (28, "float", "material_pad_3"),
        (32, "vec3", "d"),
        (44, "float", "e"),
    ]


def test_a_vector_that_crosses_a_row_needs_no_filler() -> None:
    assert rows(block_of(VEC3, VEC3, VEC2, VEC4)) == [
        (0, "vec3", "a"),
        (16, "vec3", "b"),
        (32, "vec2", "c"),
        (48, "vec4", "d"),
    ]


def test_the_end_of_a_block_is_left_to_the_backends() -> None:
    block = block_of(VEC4, FLOAT)
    assert [name for _, _, name in rows(block)] == ["a", "b"]
    assert block.size == 32


def test_a_padding_leaves_declared_names_alone() -> None:
    (block,) = layout_blocks(
        [Parameter("draw_pad_0", FLOAT, "draw"), Parameter("b", VEC2, "draw")],
    )
    assert [member.name for member in block.members] == ["draw_pad_0", "draw_pad_1", "b"]


@pytest.mark.parametrize(
    ("declared", "stored", "size"),
    [
        (BOOL, "uint", 4),
        (INT, "int", 4),
        (Vector("bool", 3), "uvec3", 12),
        (square(2), "mat2x4", 32),
        (square(3), "mat3x4", 48),
        (square(4), "mat4", 64),
        (Matrix(2, 3), "mat2x4", 32),
        (Matrix(2, 4), "mat2x4", 32),
        (Matrix(3, 2), "mat3x4", 48),
        (Matrix(3, 4), "mat3x4", 48),
        (Matrix(4, 2), "mat4", 64),
        (Matrix(4, 3), "mat4", 64),
        (Array(FLOAT, 4), "vec4[1]", 16),
        (Array(FLOAT, 5), "vec4[2]", 32),
        (Array(INT, 3), "ivec4[1]", 16),
        (Array(BOOL, 9), "uvec4[3]", 48),
        (Array(VEC2, 3), "vec4[2]", 32),
        (Array(VEC3, 3), "vec4[3]", 48),
        (Array(Vector("bool", 2), 3), "uvec4[2]", 32),
        (Array(square(2), 3), "vec4[6]", 96),
        (Array(square(4), 2), "vec4[8]", 128),
        (Array(Matrix(2, 3), 2), "vec4[4]", 64),
        (Array(Matrix(4, 2), 3), "vec4[12]", 192),
    ],
    ids=str,
)
def test_stored_forms(declared: Type, stored: str, size: int) -> None:
    found = stored_type(declared)
    assert (str(found), byte_size(found)) == (stored, size)


def test_structs_end_at_a_row_and_define_inner_ones_first() -> None:
    inner = Struct("Cone", (("angle", FLOAT),))
    outer = Struct("Lamp", (("on", BOOL), ("place", VEC3), ("cone", inner), ("k", VEC2)))
    block = block_of(FLOAT, Array(outer, 2), inner)
    assert [struct.name for struct in block.structs] == ["Cone", "Lamp"]
    assert [str(type_) for _, type_ in block.structs[0].members] == ["float"] * 4
    assert [(name, str(type_)) for name, type_ in block.structs[1].members] == [
        ("on", "uint"),
        *((f"pad_{i}", "float") for i in range(3)),
        ("place", "vec3"),
        ("pad_3", "float"),
        ("cone", "Cone"),
        ("k", "vec2"),
        ("pad_4", "float"),
        ("pad_5", "float"),
    ]
    assert [(offset, name) for offset, _, name in rows(block) if "pad" not in name] == [
        (0, "a"),
        (16, "b"),
        (16 + 2 * 64, "c"),
    ]


def test_groups_come_in_order_each_with_its_derived_block() -> None:
    blocks = layout_blocks(
        [
            Parameter("w", FLOAT, "weather"),
            Parameter("m", FLOAT, "material"),
            Parameter("cos_outer", FLOAT, "rig", derived=True),
            Parameter("t", FLOAT, "frame"),
            Parameter("sun.direction", VEC3, "rig"),
            Parameter("wet", FLOAT, "weather"),
        ],
        docs={"m": "How much."},
    )
    assert [block.name for block in blocks] == [
        "Frame",
        "Rig",
        "DerivedFromRig",
        "Material",
        "Weather",
    ]
    assert blocks[1].members[0].name == "sun_direction"
    assert blocks[3].members[0].doc == "How much."
    assert [member.name for member in blocks[4].members[:2]] == ["w", "wet"]


@pytest.mark.parametrize(
    "impossible", [TextureType(), Array(Array(FLOAT, 2), 2), Array(TextureType(), 2)]
)
def test_what_a_block_cannot_hold_is_an_error(impossible: Type) -> None:
    with pytest.raises(TypeError, match="cannot be kept in a uniform block"):
        stored_type(impossible)


@given(parameters)
def test_members_lie_in_order_without_overlap(declared: list[Parameter]) -> None:
    (block,) = layout_blocks(declared)
    end = 0
    for member in block.members:
        assert end <= member.offset < end + 16
        assert member.size == byte_size(member.type)
        end = member.offset + member.size
    assert block.size == -(-end // 16) * 16
    assert block.members[-1].parameter is not None
    assert [m.parameter for m in block.members if m.parameter] == declared
    assert len({member.name for member in block.members}) == len(block.members)


@given(parameters)
def test_every_struct_fills_whole_rows(declared: list[Parameter]) -> None:
    (block,) = layout_blocks(declared)
    for struct in block.structs:
        assert byte_size(struct) % 16 == 0
        assert len(dict(struct.members)) == len(struct.members)


@given(parameters)
def test_paddings_are_scalars_and_fewer_than_a_row(declared: list[Parameter]) -> None:
    (block,) = layout_blocks(declared)
    run = 0
    for member in block.members:
        run = 0 if member.parameter else run + 1
        assert run < 4
        assert member.parameter or member.type == FLOAT


@pytest.mark.parametrize("rules", [STD140, D3D, WGSL], ids=["std140", "d3d", "wgsl"])
@given(declared=parameters)
def test_all_rule_sets_agree(rules: Rules, declared: list[Parameter]) -> None:
    (block,) = layout_blocks(declared)
    members = stored_members(block)
    natural = rules.offsets(members)
    assert {m.name: m.offset for m in block.members} == {name: natural[name] for name, _ in members}
    assert natural == STD140.offsets(members)
    assert -(-end_of(members, rules) // 16) * 16 == block.size


@given(parameters)
def test_wgsl_accepts_the_block_as_a_uniform(declared: list[Parameter]) -> None:
    (block,) = layout_blocks(declared)
    assert wgsl_uniform_violations(stored_members(block)) == []


@given(types)
def test_storing_what_is_stored_changes_nothing(declared: Type) -> None:
    stored = stored_type(declared)
    assert stored_type(stored) == stored


def test_uint_is_stored_as_declared() -> None:
    assert stored_type(UINT) == UINT
