"""Bindings in C++: g++ accepts them without a warning, and their bytes are those of the runtime.

One program has the blocks of all examples. It reads numbers, and writes the bytes of each block.
"""

from __future__ import annotations

import json
import subprocess
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

from . import cpp_frames
from .calls import ROUNDS, every_builtin
from .frame_calls import drawings, wrong
from .given import numbers
from .judging import assert_builtins, assert_bytes, assert_defaults
from .kit import ELSEWHERE, PLASTIC, UNFIT, defaults, everything, reflections, samples, set_by_hosts

pytestmark = pytest.mark.xdist_group("bindings")

_FLAGS = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O0")
_HEAD = """\
#include "builtins.hpp"
#include "examples.hpp"
#include <cstdio>
#include <cstdlib>
using namespace burnish::examples;
static float next_float() {
    double x = 0;
    if (std::scanf("%la", &x) != 1) std::exit(2);
    return float(x);
}
static long long next_whole() {
    long long x = 0;
    if (std::scanf("%lld", &x) != 1) std::exit(2);
    return x;
}
template <class T, class N> static void take(T& place, N number) {
    place = static_cast<T>(number);
}
template <class T> static T tell(const T& block) {
    const unsigned char* bytes = reinterpret_cast<const unsigned char*>(&block);
    for (std::size_t i = 0; i < sizeof(T); ++i) std::printf("%02x", bytes[i]);
    std::printf("\\n");
    return block;
}
"""


@cache
def _spelling() -> Spelling:
    return spelling_of(everything(), registry.load("cpp"))


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
    read = "next_float()" if type_.kind == "float" else "next_whole()"
    for column in range(type_.columns) or [None]:
        whole = place if column is None else f"{place}[{column}]"
        lanes = [""] if type_.lanes == 1 else [f".{lane}" for lane in "xyzw"[: type_.lanes]]
        yield from (f"take({whole}{lane}, {read});" for lane in lanes)


def _reader(block: Block, spelling: Spelling, namespace: str = "") -> str:
    name = spelling.type(block.name)
    lines = [f"static {namespace}{name} read_{name}() {{", f"{namespace}{name} block;"]
    for field in block.structure.fields:
        lines += _reads(field, f"block.{spelling.member(field.word)}", spelling)
    return "\n".join([*lines, "return block;", "}", ""])


def _program() -> str:
    """The program that reads all samples in their order, and then tells the defaults."""
    readers = [_reader(each, _spelling()) for each in set_by_hosts()]
    binding, _ = every_builtin()
    spelling = spelling_of(binding, registry.load("cpp"))
    readers.append(_reader(binding.blocks[0], spelling, "burnish::builtins::"))
    turns: list[str] = []
    known: dict[tuple[str, int, str], str] = {}
    for number, sample in enumerate(samples()):
        name = _spelling().type(sample.block.name)
        if sample.block.derivation is None:
            known[sample.material, sample.seed, sample.block.plain_name] = f"b{number}"
            turns.append(f"[[maybe_unused]] const {name} b{number} = tell(read_{name}());")
        else:
            sources = [known[sample.material, sample.seed, each] for each in sample.sources]
            function = _spelling().function(deriving(sample.block))
            turns.append(f"tell({function}({', '.join(sources)}));")
    turns += [f"tell({_spelling().type(block.name)}{{}});" for block, _ in defaults()]
    turn = "tell(burnish::builtins::derive_results(read_Operands()));"
    turns += [turn] * ROUNDS
    turns += cpp_frames.turns(_spelling(), _reads)
    parts = (_HEAD, *readers, cpp_frames.recorder(_spelling()), "int main() {\n")
    return "".join(parts) + "\n".join(turns) + "\n}\n"


@pytest.fixture(scope="module")
def lines(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """What the program tells: the bytes of all blocks, then the calls of all frames."""
    folder = tmp_path_factory.mktemp("cpp")
    header = written(everything(), registry.load("cpp"))
    (folder / "examples.hpp").write_text(header, "utf-8")
    builtins = written(every_builtin()[0], registry.load("cpp"))
    (folder / "builtins.hpp").write_text(builtins, "utf-8")
    (folder / "main.cpp").write_text(_program(), "utf-8")
    _run(["g++", *_FLAGS, "main.cpp", "-o", "main"], folder)
    given = "\n".join([numbers(), *cpp_frames.numbers()])
    return _run([str(folder / "main")], folder, given).splitlines()


@pytest.fixture(scope="module")
def told(lines: list[str]) -> list[bytes]:
    """The bytes of all blocks."""
    return [bytes.fromhex(line) for line in lines[: lines.index(cpp_frames.MARK)]]


def _run(command: list[str], folder: Path, text: str = "") -> str:
    done = subprocess.run(
        command, cwd=folder, input=text, capture_output=True, text=True, timeout=600, check=False
    )
    assert done.returncode == 0, done.stderr[:4000]
    return done.stdout


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


_STALE = """\
#include "plastic.hpp"
#include <cstdio>
#include <iostream>
#include <string>
int main() {
    for (std::string text; std::getline(std::cin, text);) {
        const char* told = burnish::stale(burnish::plastic::plastic, text);
        std::puts(told ? told : "fits");
    }
}
"""


def test_a_stale_binding_is_told(tmp_path: Path) -> None:
    header = burnish.bind(PLASTIC, "cpp", "wgsl")
    (tmp_path / "plastic.hpp").write_text(header, "utf-8")
    (tmp_path / "main.cpp").write_text(_STALE, "utf-8")
    _run(["g++", *_FLAGS, "main.cpp", "-o", "main"], tmp_path)
    given = "\n".join(map(json.dumps, reflections()))
    assert _run([str(tmp_path / "main")], tmp_path, given).splitlines() == [
        "fits",
        "the binding is stale: a block has another layout; run `burnish bind` again",
        "the binding is stale: there are other blocks now; run `burnish bind` again",
        *[f"the binding is stale: {ELSEWHERE}"] * 2,
        *UNFIT,
    ]
