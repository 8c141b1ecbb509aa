"""Bindings in C: gcc and clang accept them without a warning, and their bytes are the runtime's.

One program has the blocks of all examples. It reads numbers, and writes the bytes of each block.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

import burnish
from burnish.bindings import registry
from burnish.bindings.fields import Field, Numbers, Structure
from burnish.bindings.model import Block
from burnish.bindings.spelling import Spelling
from burnish.bindings.writing import deriving, spelling_of, written

from ..suite.processes import run
from . import c_frames, cpp_frames
from .calls import ROUNDS, every_builtin
from .frame_calls import drawings, wrong
from .given import numbers
from .judging import assert_builtins, assert_bytes, assert_defaults
from .kit import ELSEWHERE, PLASTIC, UNFIT, defaults, everything, reflections, samples

pytestmark = pytest.mark.xdist_group("bindings")

_STRICT = ("-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O0")
_HEAD = """\
#include "builtins.h"
#include "examples.h"
#include <stdio.h>
#include <stdlib.h>
static float next_float(void) {
    double x = 0;
    if (scanf("%la", &x) != 1) exit(2);
    return (float)x;
}
static long long next_whole(void) {
    long long x = 0;
    if (scanf("%lld", &x) != 1) exit(2);
    return x;
}
static void tell(const void* block, size_t size) {
    for (size_t i = 0; i < size; ++i) printf("%02x", ((const unsigned char*)block)[i]);
    printf("\\n");
}
"""


@cache
def _spelling() -> Spelling:
    return spelling_of(everything(), registry.load("c"))


def _reads(field: Field, place: str, spelling: Spelling) -> Iterator[str]:
    """The statements that read a field, or what is at its place."""
    if field.capacity:
        yield f"for (int i = 0; i < {field.capacity}; ++i) {{"
        yield from _reads_value(field.type, f"{place}[i]", spelling)
        yield "}"
    else:
        yield from _reads_value(field.type, place, spelling)


def _reads_value(type_: Numbers | Structure, place: str, spelling: Spelling) -> Iterator[str]:
    if isinstance(type_, Structure):
        for field in type_.fields:
            yield from _reads(field, f"{place}.{spelling.member(field.word)}", spelling)
        return
    read = {
        "float": "next_float()",
        "int": "(int32_t)next_whole()",
        "uint": "(uint32_t)next_whole()",
    }
    for column in range(type_.columns) or [None]:
        whole = place if column is None else f"{place}[{column}]"
        lanes = range(type_.lanes) if type_.stored_lanes > 1 else [None]
        for lane in lanes:
            yield f"{whole}{'' if lane is None else f'[{lane}]'} = {read[type_.kind]};"


def _reader(block: Block, spelling: Spelling) -> str:
    name = spelling.type(block.name)
    made = f"{name} block = {spelling.function(f'default.{block.name}')}();"
    lines = [f"static {name} read_{name}(void) {{", made]
    for field in block.structure.fields:
        lines += _reads(field, f"block.{spelling.member(field.word)}", spelling)
    return "\n".join([*lines, "return block;", "}", ""])


def _told(name: str, value: str, kept: str = "told") -> str:
    return f"const {name} {kept} = {value}; tell(&{kept}, sizeof {kept});"


def _program() -> str:
    """The program that reads all samples in their order, and then tells the defaults."""
    spelling = _spelling()
    readers = [_reader(each, spelling) for each, _ in defaults()]
    binding, _ = every_builtin()
    builtins = spelling_of(binding, registry.load("c"))
    readers.append(_reader(binding.blocks[0], builtins))
    turns: list[str] = []
    known: dict[tuple[str, int, str], str] = {}
    for number, sample in enumerate(samples()):
        name = spelling.type(sample.block.name)
        if sample.block.derivation is None:
            known[sample.material, sample.seed, sample.block.plain_name] = f"b{number}"
            turns.append(_told(name, f"read_{name}()", f"b{number}"))
        else:
            sources = [f"&{known[sample.material, sample.seed, each]}" for each in sample.sources]
            call = f"{spelling.function(deriving(sample.block))}({', '.join(sources)})"
            turns.append(f"{{ {_told(name, call)} }}")
    for block, _ in defaults():
        call = f"{spelling.function(f'default.{block.name}')}()"
        turns.append(f"{{ {_told(spelling.type(block.name), call)} }}")
    call = "const builtins_Operands read = read_builtins_Operands();"
    turns += [
        f"{{ {call} {_told('builtins_Results', 'builtins_derive_results(&read)')} }}"
    ] * ROUNDS
    turns += c_frames.turns(spelling, _reads)
    parts = (_HEAD, *readers, c_frames.recorder(spelling), "int main(void) {\n")
    return "".join(parts) + "\n".join(turns) + "\n}\n"


@pytest.fixture(scope="module", params=["gcc", "clang"])
def lines(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """What the program tells: the bytes of all blocks, then the calls of all frames."""
    folder = tmp_path_factory.mktemp("c")
    language = registry.load("c")
    (folder / "examples.h").write_text(written(everything(), language), "utf-8")
    (folder / "builtins.h").write_text(written(every_builtin()[0], language), "utf-8")
    (folder / "main.c").write_text(_program(), "utf-8")
    return _compiled(request.param, folder, "\n".join([numbers(), *cpp_frames.numbers()]))


@pytest.fixture(scope="module")
def told(lines: list[str]) -> list[bytes]:
    """The bytes of all blocks."""
    return [bytes.fromhex(line) for line in lines[: lines.index(cpp_frames.MARK)]]


def _compiled(compiler: str, folder: Path, text: str) -> list[str]:
    """What a program prints once a compiler has accepted it."""
    command = [compiler, *_STRICT, "main.c", "-o", "main", "-lm"]
    run(command, cwd=folder, limit=600, check=True)
    return run([str(folder / "main")], text=text, check=True).stdout.splitlines()


def test_values_have_the_bytes_of_the_runtime_and_so_have_derived_ones(told: list[bytes]) -> None:
    assert_bytes(told)


def test_blocks_begin_with_their_defaults(told: list[bytes]) -> None:
    assert_defaults(told)


def test_builtins_mean_what_they_do_in_the_reference(told: list[bytes]) -> None:
    assert_builtins(told)


def test_frames_are_drawn_as_burnish_draws_them(lines: list[str]) -> None:
    drawn = cpp_frames.calls(lines[lines.index(cpp_frames.MARK) :])
    pairs = zip(drawings(), drawn, strict=True)
    assert not [reason for each in pairs if (reason := wrong(*each))]


_PLASTIC = """\
#include "plastic.h"
#include <stdio.h>
static void say(const char* told) { puts(told ? told : "fits"); }
int main(void) {
    static char text[1 << 20];
    while (fgets(text, sizeof text, stdin)) say(burnish_stale(&plastic_plastic, text));
    plastic_StudioRig rig = plastic_default_studio_rig();
    say(plastic_fault_studio_rig(&rig));
    rig.torch_axis[1] = 2.0f;
    say(plastic_fault_studio_rig(&rig));
    const plastic_Point lamps[9] = {plastic_default_point()};
    printf("%d", plastic_set_studio_rig_lamps(&rig, lamps, 9));
    printf(" %d\\n", rig.lamps_count);
    printf("%d", plastic_set_studio_rig_lamps(&rig, lamps, 2));
    printf(" %d\\n", rig.lamps_count);
    plastic_PlasticBlocks blocks = plastic_default_plastic_blocks();
    const float eye[3] = {1.0f, 2.0f, 3.0f};
    printf("%d", plastic_plastic.set_role(&blocks, "eye", eye, sizeof eye));
    printf("%d", plastic_plastic.set_role(&blocks, "eye", eye, sizeof eye[0]));
    printf("%d", plastic_plastic.set_role(&blocks, "place", eye, sizeof eye));
    plastic_plastic.derive_blocks(&blocks);
    const void* found = plastic_plastic.find_block(&blocks, "Studio.DerivedFromRig");
    printf(" %g %d", (double)blocks.view.eye[1], found == &blocks.derived_from_rig);
    printf("%d\\n", plastic_plastic.find_block(&blocks, "Fog") == NULL);
    const burnish_Text* vertex = &plastic_plastic.profiles[0].texts[0];
    for (int i = 0; i < vertex->part_count; ++i) fputs(vertex->parts[i], stdout);
    return 0;
}
"""


def test_stale_bindings_faults_counts_and_embedded_texts(tmp_path: Path) -> None:
    header = burnish.bind(PLASTIC, "c", "wgsl", embed=True)
    (tmp_path / "plastic.h").write_text(header, "utf-8")
    (tmp_path / "main.c").write_text(_PLASTIC, "utf-8")
    given = "\n".join(map(json.dumps, reflections()))
    lines = _compiled("gcc", tmp_path, given)
    assert lines[:13] == [
        "fits",
        "the binding is stale: a block has another layout; run `burnish bind` again",
        "the binding is stale: there are other blocks now; run `burnish bind` again",
        *[f"the binding is stale: {ELSEWHERE}"] * 2,
        *UNFIT,
        "fits",
        "`torch.axis` has to be of length 1",
        "0 0",
        "1 2",
        "100 2 11",
    ]
    (material,) = burnish.compile(PLASTIC, "wgsl")
    assert lines[13:] == material.text("wgsl", "vertex").splitlines()
