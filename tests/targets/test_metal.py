"""Metal, as far as it can be known without Apple's compiler.

clang has to accept every text (``test_accepted.py`` and the examples see to that), to refuse wrong
ones, and to place the members of blocks where the reflection says they are.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

import burnish
from burnish.api import entry_points as api
from burnish.compiler.ir.program import Block
from burnish.targets import registry
from burnish.targets.emit.names import Names
from burnish.targets.toolchain import CHECKERS, Job, Message, Toolchain

from ..cli.kit import invoke
from ..suite.verdicts import refused

METAL = "msl:metal2"
LABEL = "never compiled by Apple's compiler"
TREE = Path(__file__).parents[2]
LAID_OUT = (
    "examples/host_block", "examples/plastic", "tests/conformance/materials/storage",
    "tests/conformance/materials/tables", "tests/conformance/materials/values",
)  # fmt: skip

GOOD = """#include <metal_stdlib>
using namespace metal;

struct Material {
    alignas(16) packed_float3 tint;
    float gain;
};

struct FragmentInput {
    float3 normal [[user(location0)]];
};

float3 shaded(constant Material& material, float3 normal) {
    return float3(material.tint) * dot(normal, normal.zyx) * material.gain;
}

fragment float4 shade(FragmentInput input [[stage_in]], constant Material& material [[buffer(0)]]) {
    return float4(shaded(material, normalize(input.normal)), 1.0f);
}
"""

WRONG = [
    ("normalize(", "normalise(", "use of undeclared identifier 'normalise'"),
    ("normal.zyx", "normal.zyq", "no member named 'zyq'"),
    ("dot(normal, normal.zyx)", "dot(normal)", "no matching function for call to 'dot'"),
    ("dot(normal, normal.zyx)", "dot(normal, normal.xy)", "no matching function"),
    ("shaded(material, ", "shaded(", "no matching function for call to 'shaded'"),
    ("    return float3(", "    return float4(", "no matching"),
    ("fragment float4 shade", "fragment float3 shade", "no viable conversion"),
    ("float gain", "int3 gain", "invalid operands to binary expression"),
    ("* material.gain", "% material.gain", "invalid operands to binary expression"),
    ("material.tint", "material.taint", "no member named 'taint'"),
    ("[[buffer(0)]]", "[[bufer(0)]]", "there is no attribute 'bufer(0)'"),
    ("[[buffer(0)]]", "[[buffer]]", "there is no attribute 'buffer'"),
    ("[[stage_in]]", "[[stage_in(0)]]", "there is no attribute 'stage_in(0)'"),
    ("fragment float4 shade", "float4 shade", "there is no frag entry point named 'shade'"),
    ("return float4(", "uint whole = uint(1) * -1; return float4(", "signedness"),
]
"""A part of a good text, a wrong text in its place, and a part of the error about it."""


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


def messages(toolchain: Toolchain, text: str, entry: str = "shade") -> tuple[Message, ...]:
    [verdict] = toolchain.check([Job("clang-msl", "frag", text, entry)])
    assert (verdict.status == "accepted") == (not verdict.messages)
    return verdict.messages


def test_a_good_text_is_accepted(toolchain: Toolchain) -> None:
    assert not messages(toolchain, GOOD)


@pytest.mark.parametrize(("right", "wrong", "said"), WRONG, ids=[row[1] for row in WRONG])
def test_a_wrong_text_is_refused(right: str, wrong: str, said: str, toolchain: Toolchain) -> None:
    assert right in GOOD
    assert said in " ".join(each.text for each in messages(toolchain, GOOD.replace(right, wrong)))


def places(block: Block, names: Names) -> Iterator[str]:
    """Assertions that the members of a block lie where Burnish has laid them out."""
    owner = names.blocks[block.name]
    for member in block.members:
        name = names.member(block.name, member.name)
        yield f'static_assert(__builtin_offsetof({owner}, {name}) == {member.offset}, "{name}");'


@pytest.mark.parametrize("material", LAID_OUT)
def test_members_lie_where_the_reflection_says(material: str, toolchain: Toolchain) -> None:
    asked: list[Job] = []
    path = TREE / f"{material}.burnish"
    for rig, pass_ in api.variants(path):
        result = burnish.compile(path, METAL, rig=rig, pass_=pass_)
        for compiled in result:
            ((_legal, emission),) = compiled._place.graphs().emissions
            stage = compiled.staged.program.stage("fragment")
            asserted = [line for block in stage.blocks for line in places(block, emission.names)]
            text = "\n".join([compiled.text("msl", "fragment"), *asserted])
            asked.append(Job("clang-msl", "frag", text, "fs_main", f"{pass_} of {compiled.name}"))
    assert any("static_assert" in job.text for job in asked)
    found = refused(asked, toolchain)
    assert not found, "\n".join(each.report() for each in found)


def test_a_member_that_lies_elsewhere_is_seen(toolchain: Toolchain) -> None:
    text = GOOD + 'static_assert(__builtin_offsetof(Material, gain) == 16, "gain");\n'
    assert "static_assert failed" in messages(toolchain, text)[0].text


def test_it_is_written_only_where_it_is_named(tmp_path: Path) -> None:
    text = "material M { color = #808080 }"
    (plain,) = burnish.compile(text)
    assert "msl" not in {file.target for file in plain.files}
    assert "msl" not in registry.defaults()
    file = tmp_path / "m.burnish"
    file.write_text(text)
    invoke("compile", file, "-o", tmp_path / "out")
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "M.json",
        *(file.name for file in plain.files),
    }


def test_it_is_labelled_wherever_it_is_named(tmp_path: Path) -> None:
    (compiled,) = burnish.compile("material M { color = #808080 }", METAL)
    texts = [file.text for file in compiled.files]
    assert texts and all(LABEL[1:] in text for text in texts)
    assert LABEL in invoke("targets").output
    answer = json.loads(invoke("targets", "--format", "json").output)
    (row,) = [each for each in answer["result"]["targets"] if each["name"] == "msl"]
    assert LABEL in row["unproven"] and LABEL in row["profiles"][0]["doc"]
    file = tmp_path / "m.burnish"
    file.write_text("material M { color = #808080 }")
    unknown = invoke("compile", file, "-t", "spirv", "-o", tmp_path)
    assert f"msl ({LABEL}" in unknown.stderr
    written = invoke("compile", file, "-t", "msl,wgsl", "-o", tmp_path)
    (remark,) = [line for line in written.output.splitlines() if LABEL in line]
    assert remark.startswith("texts in Metal Shading Language: ")
    assert "clang-msl" in CHECKERS
