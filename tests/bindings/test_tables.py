"""Tables in C and C++: enumerations of the language, blending and stencil tests have types."""

from __future__ import annotations

from pathlib import Path
from typing import get_args

import pytest

import burnish
from burnish.bindings.c_family.words import words_of
from burnish.compiler.constraints import dashed
from burnish.compiler.documents.drawing import ADDRESS_MODES, TOPOLOGY_WORDS
from burnish.compiler.ir.blending import Factor, Operation
from burnish.compiler.ir.formats import DEPTH_WORDS, TARGET_WORDS, VertexFormat
from burnish.compiler.ir.render_state import COMPARE_WORDS, Cull, Fill, StencilOperation
from burnish.compiler.ir.types import DIMENSION_WORDS, Border

from ..suite.processes import run

WORDS = {
    "Compare": set(COMPARE_WORDS.values()),
    "Cull": set(get_args(Cull)),
    "Fill": set(get_args(Fill)),
    "Factor": set(dashed(get_args(Factor)).values()),
    "Operation": set(dashed(get_args(Operation)).values()),
    "StencilOperation": set(dashed(get_args(StencilOperation)).values()),
    "Topology": set(TOPOLOGY_WORDS.values()),
    "Wrap": set(ADDRESS_MODES.values()),
    "Border": set(get_args(Border)),
    "Dimension": set(DIMENSION_WORDS.values()),
    "Format": {*TARGET_WORDS.values(), *DEPTH_WORDS.values()},
    "VertexFormat": {"none", *get_args(VertexFormat)},
}


@pytest.mark.parametrize("name", WORDS)
def test_enumerations_have_the_words_of_documents(name: str) -> None:
    assert set(words_of(name).constants) == WORDS[name]


WORN = """
enum Wear { fresh, worn, new }
pass Ghost : Forward blend alpha {
    depth { write = false }
    stencil { compare = equal, pass = increment_wrap, reference = 3, read_mask = 7 }
}
material Odd : Surface {
    param wear : Wear = Wear.worn
    param other : Wear = Wear.new
    color = if wear == other then rgb(1) else rgb(0.5)
}
"""
CPP = """\
#include "odd.hpp"
using namespace burnish;
static_assert(odd::Wear::new_ == static_cast<odd::Wear>(2));
static_assert(odd::odd.targets[0].blend.is_enabled);
static_assert(odd::odd.targets[0].blend.color.destination == Factor::one_minus_src_alpha);
static_assert(odd::odd.targets[0].format == Format::rgba8unorm_srgb);
static_assert(odd::odd.stencil.is_enabled && odd::odd.stencil.read_mask == 7);
static_assert(odd::odd.stencil.back.pass == StencilOperation::increment_wrap);
static_assert(odd::odd.depth.compare == Compare::less && !odd::odd.depth.write);
int main() {
    odd::OddMaterial block;
    const bool begins = block.wear == odd::Wear::worn && odd::fault(block) == nullptr;
    block.other = static_cast<odd::Wear>(3);
    const std::string_view told = "`other` is one of 0 fresh, 1 worn, 2 new";
    return begins && odd::fault(block) == told ? 0 : 1;
}
"""
C = """\
#include "odd.h"
int main(void) {
    const burnish_Blend* blend = &odd_odd.targets[0].blend;
    assert(blend->is_enabled);
    assert(blend->color.destination == BURNISH_FACTOR_ONE_MINUS_SRC_ALPHA);
    assert(odd_odd.stencil.is_enabled && odd_odd.stencil.read_mask == 7);
    assert(odd_odd.stencil.back.pass == BURNISH_STENCIL_OPERATION_INCREMENT_WRAP);
    assert(odd_odd.depth.compare == BURNISH_COMPARE_LESS && !odd_odd.depth.write);
    odd_OddMaterial block = odd_default_odd_material();
    assert(block.wear == odd_Wear_worn && odd_fault_odd_material(&block) == NULL);
    block.other = 3;
    assert(strcmp(odd_fault_odd_material(&block), "`other` is one of 0 fresh, 1 worn, 2 new") == 0);
    return 0;
}
"""
PROGRAMS = {
    "cpp": (CPP, "hpp", ["g++", "-std=c++17"]),
    "c": (C, "h", ["clang", "-std=c11"]),
}


@pytest.mark.parametrize("language", PROGRAMS)
def test_enumerations_blending_and_stencil_tests_have_types(language: str, tmp_path: Path) -> None:
    program, ending, compiler = PROGRAMS[language]
    header = burnish.bind(WORN, language, "wgsl", pass_="Ghost", namespace="odd")
    (tmp_path / f"odd.{ending}").write_text(header, "utf-8")
    (tmp_path / f"main.{language}").write_text(program, "utf-8")
    strict = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-o", "main", f"main.{language}", "-lm"]
    run([*compiler, *strict], cwd=tmp_path, check=True)
    run([str(tmp_path / "main")], check=True)
