"""Names stay the user's wherever the language lets them."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

import burnish
from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.program import Program
from burnish.compiler.ir.statements import Let, Region
from burnish.compiler.ir.types import FLOAT
from burnish.targets.description.reserved import Reserved
from burnish.targets.emit.namer import Namer

from .kit import PROFILES, Selected, can_have, printed
from .programs import Maker, block, odd, plastic, tiny

IDENTIFIER = st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,12}", fullmatch=True)
LEGAL = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
HARD = ["gl_Position", "a__b", "__", "_", "_x", "texture", "main", "float3", "vec3f", "fract", "9"]


def namer(*taken: str) -> Namer:
    return Namer(Reserved(frozenset({"texture"}), re.compile("gl_")), taken)


def test_suffixes() -> None:
    names = namer()
    assert [names.declare("texture") for _ in range(3)] == ["texture_", "texture_2", "texture_3"]
    assert [names.declare("a") for _ in range(2)] == ["a", "a_"]
    assert names.declare("gl_Position") == "user_gl_Position"
    assert names.declare("lamps.count") == "lamps_count"
    assert names.declare("a__b") == "a_b"


def test_names_of_a_block_can_be_used_again_after_it() -> None:
    names = namer("outer")
    names.enter()
    assert [names.declare("inner"), names.declare("outer")] == ["inner", "outer_"]
    names.leave()
    assert [names.declare("inner"), names.declare("outer")] == ["inner", "outer_"]


@pytest.mark.parametrize("selected", PROFILES, ids=str)
@given(wanted=st.lists(IDENTIFIER | st.sampled_from(HARD), max_size=20))
def test_names_are_legal_and_differ(selected: Selected, wanted: list[str]) -> None:
    reserved = selected.language.reserved()
    names = Namer(reserved)
    given_names = [names.declare(name) for name in wanted]
    assert len(set(given_names)) == len(given_names)
    for name in given_names:
        assert LEGAL.fullmatch(name) and "__" not in name and not reserved.refuses(name)


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_reserved_words_survive_as_something_else(selected: Selected) -> None:
    program = program_of_words(sorted(selected.language.reserved().words)[::8])
    emission = printed(program, selected)
    reserved = selected.language.reserved()
    for kind in (emission.names.blocks, emission.names.members, emission.names.textures):
        assert not any(map(reserved.refuses, kind.values()))


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_every_name_of_the_reflection_is_in_the_text(selected: Selected) -> None:
    for program in (plastic(), odd()):
        if not can_have(selected, program):
            continue
        emission = printed(program, selected)
        text = "".join(file.text for file in emission.files)
        names = emission.names
        blocks = {} if selected.profile.loose_uniforms else names.blocks
        tables = (blocks, names.members, names.textures, names.attributes, names.varyings)
        for table in tables:
            for name in table.values():
                assert re.search(rf"\b{name}\b", text), name


def program_of_words(words: list[str]) -> Program:
    """Each word is a member of a block and a local."""
    make = Maker()
    parameters = [Parameter(word, FLOAT, "material") for word in words]
    material = block("Material", "material", [(parameter, "") for parameter in parameters])
    total = make.number(0.0)
    lets = []
    for word, parameter in zip(words, parameters, strict=True):
        total = make.native("add", FLOAT, total, make.parameter(parameter))
        lets.append(Let(word, total))
    color = build.splat(make.graph, total, 4)
    return tiny(color, make, (material,), region=Region(tuple(lets)))


@pytest.mark.parametrize("target", ["glsl", "hlsl", "wgsl"])
def test_no_local_hides_a_function(target: str) -> None:
    """A compiler would refuse the calls behind it."""
    text = """
        material M {
            safe_pow = sin(uv.x) + uv.y
            color = vec3(safe_pow, pow(uv.x - 0.3, safe_pow), pow(uv.y - 0.2, safe_pow))
        }
    """
    (made,) = burnish.compile(text, target).materials
    written = made.text(target, "fragment")
    assert re.search(r"\bsafe_pow_ = sin\(", written)
    assert len(re.findall(r"\bsafe_pow\(", written)) == 3


def test_no_two_attributes_have_one_semantic() -> None:
    """Direct3D takes ``tint`` and ``Tint`` for one, and ``a``, ``a0`` and ``a00``, too."""
    names = ("tint", "Tint", "a", "a0", "a00", "a1", "A01", "b" * 70, "b" * 71, "B")
    declared = "".join(f"attribute {name} : float  " for name in names)
    text = f"material M {{ {declared} alpha = {' + '.join(names)} }}"
    (made,) = burnish.compile(text, "hlsl").materials
    rows = made.reflection.backends["hlsl:sm6"].vertex_inputs
    semantics = [rows[name].semantic or "" for name in names]
    assert semantics[:4] == ["TINT", "TINT_AT4_", "A", "A0_AT6_"]
    parted = [re.fullmatch(r"(.*?)([0-9]*)", semantic) for semantic in semantics]
    keys = {(part[1].upper(), int(part[2] or 0)) for part in parted if part}
    assert len(keys) == len(names)
    assert max(map(len, semantics)) <= 64
