"""Bindings in Rust: rustc accepts them without a warning, and their bytes are those of the runtime.

One program has the blocks of all examples. It reads numbers, and writes the bytes of each block.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from functools import cache
from typing import Any

import pytest

import burnish
from burnish.bindings import registry
from burnish.bindings.fields import Field, Numbers, Structure
from burnish.bindings.model import Block
from burnish.bindings.spelling import Spelling
from burnish.bindings.writing import deriving, spelling_of, written

from ..comparers.kit import tool
from ..suite.processes import run
from .calls import ROUNDS, every_builtin, operands
from .frame_calls import drawings, wrong
from .judging import assert_builtins, assert_bytes, assert_defaults
from .kit import PLASTIC, UNFIT, defaults, everything, samples, set_by_hosts
from .rust_frames import RECORDER, drawers
from .rust_frames import values as drawn_values

pytestmark = pytest.mark.xdist_group("bindings")

_STRICT = ("--edition", "2021", "-D", "warnings")
_HEAD = """\
mod builtins;
mod examples {
    include!("examples.rs");
}
mod plastic;
mod small;

use examples::*;

/// The 32 bits of each number, one in each line.
struct Numbers(std::io::Lines<std::io::StdinLock<'static>>);

impl Numbers {
    fn next(&mut self) -> u32 {
        let line = self.0.next().unwrap().unwrap();
        u32::from_str_radix(&line, 16).unwrap()
    }
    fn float(&mut self) -> f32 {
        f32::from_bits(self.next())
    }
    fn int(&mut self) -> i32 {
        self.next() as i32
    }
    fn uint(&mut self) -> u32 {
        self.next()
    }
}

fn tell(bytes: Vec<u8>) {
    let digits: Vec<String> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    println!("{}", digits.concat());
}
"""
_PLASTIC = """\
fn checked() {
    use plastic::{Point, StudioRig, PLASTIC};
    let mut rig = StudioRig::default();
    let before = rig;
    assert_eq!(rig.set_lamps(&[Point::DEFAULT; 9]), Err("`lamps` takes at most 8 elements"));
    assert_eq!(rig, before);
    let lamp = Point { place: [1.0, 2.0, 3.0], ..Point::DEFAULT };
    assert_eq!(rig.set_lamps(&[lamp; 2]), Ok(()));
    assert_eq!((rig.lamps_count, rig.lamps[1], rig.lamps[2]), (2, lamp, Point::DEFAULT));
    assert_eq!(rig.check(), Ok(()));
    rig.torch_inner = f32::NAN;
    assert_eq!(rig.check(), Err("`torch.inner` is declared in 0 to 1.5708"));
    rig = StudioRig { torch_axis: [0.0, 2.0, 0.0], ..before };
    assert_eq!(rig.check(), Err("`torch.axis` has to be of length 1"));

    let reflection = include_str!("Plastic.json");
    let stale = |text: &str| PLASTIC.check(text).unwrap_err().to_string();
    assert_eq!(PLASTIC.check(reflection), Ok(()));
    assert_eq!(
        stale(&reflection.replace(PLASTIC.layout_ids[1].1, "0")),
        "the binding is stale: a block has another layout; run `burnish bind` again"
    );
    assert_eq!(
        stale(&reflection.replacen(r#""name": "View""#, r#""name": "Fog""#, 1)),
        "the binding is stale: there are other blocks now; run `burnish bind` again"
    );
    assert_eq!(
        stale(&reflection.replace(PLASTIC.profiles[0].binding_id, "0")),
        concat!(
            "the binding is stale: ",
            "other things are bound or fed, or elsewhere; run `burnish bind` again"
        )
    );
    assert_eq!(
        [
            stale(&reflection.replacen("Studio", "Room", 1)),
            stale(&reflection.replace("wgsl:webgpu", "glsl")),
            stale("{}"),
        ],
        [UNFIT]
    );
    let texts = PLASTIC.profiles[0].texts;
    assert_eq!(texts[0].text, include_str!("Plastic.vert.wgsl"));
    assert_eq!(texts[1].text, include_str!("Plastic.frag.wgsl"));
}
"""

_PLASTIC = _PLASTIC.replace("[UNFIT]", json.dumps(UNFIT))
_SMALL = """\
/// The number of the coat.
enum Mode {
    add,  /// Their sum.
    mix
}
material Coated {
    param mode: Mode = Mode.mix
    param turn: mat3
    param tints: vec3[2]
    color = choose(mode, add = rgb(turn * vec3(1.0, 2.0, 3.0)), mix = rgb(tints[1]))
}
"""
_SMALL_CHECKED = """\
fn small() {
    use small::{columns, Bytes, CoatedMaterial, Mode, COATED};
    let mut coated = CoatedMaterial {
        turn: columns([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]]),
        tints: columns([[1.0, 2.0, 3.0]; 2]),
        ..CoatedMaterial::DEFAULT
    };
    assert_eq!(coated.turn[1], [4.0, 5.0, 6.0, 0.0]);
    assert_eq!((coated.mode, coated.bytes()[0], Mode::NAMES), (Mode::MIX, 1, ["add", "mix"]));
    let derived = |coated| small::derive_coated_material(&coated).bytes()[..12].to_vec();
    assert_eq!(derived(coated), Bytes::bytes(&[1.0_f32, 2.0, 3.0]));
    coated.mode = Mode::ADD;
    assert_eq!(derived(coated), Bytes::bytes(&[30.0_f32, 36.0, 42.0]));
    coated.mode = Mode(2);
    assert_eq!(coated.check(), Err("`mode` is one of 0 add, 1 mix"));

    let profile = |name: &str| COATED.profiles.iter().find(|each| each.name == name).unwrap();
    let numbered = profile("wgsl:webgpu").bindings;
    assert_eq!((numbered[1].name, numbered[1].group, numbered[1].binding), ("View", 0, 1));
    assert!(!numbered[0].is_read && numbered[1].is_read);
    let named = profile("glsl:es300").named;
    let read = numbered.iter().filter(|each| each.is_read);
    assert!(profile("glsl:es300").bindings.is_empty() && named.len() == read.count());
}
"""


@cache
def _spelling() -> Spelling:
    return spelling_of(everything(), registry.load("rust"))


def _reads(field: Field, place: str, spelling: Spelling) -> Iterator[str]:
    """The statements that read a field, or what is at its place."""
    if field.capacity:
        yield f"for i in 0..{field.capacity} {{"
        yield from _reads_value(field.type, f"{place}[i]", spelling)
        yield "}"
    else:
        yield from _reads_value(field.type, place, spelling)


def _reads_value(type_: Numbers | Structure, place: str, spelling: Spelling) -> Iterator[str]:
    if isinstance(type_, Structure):
        for field in type_.fields:
            yield from _reads(field, f"{place}.{spelling.member(field.word)}", spelling)
        return
    for column in range(type_.columns) or [None]:
        whole = place if column is None else f"{place}[{column}]"
        lanes = [""] if type_.lanes == 1 else [f"[{lane}]" for lane in range(type_.lanes)]
        yield from (f"{whole}{lane} = numbers.{type_.kind}();" for lane in lanes)


def _reader(block: Block, spelling: Spelling, module: str) -> str:
    name = spelling.type(block.name)
    lines = [f"fn read_{module}_{name}(numbers: &mut Numbers) -> {module}::{name} {{"]
    lines.append(f"let mut block = {module}::{name}::default();")
    for field in block.structure.fields:
        lines += _reads(field, f"block.{spelling.member(field.word)}", spelling)
    return "\n".join(["#[allow(nonstandard_style)]", *lines, "block", "}", ""])


def _program() -> str:
    """The program that reads all samples in their order, and then tells the defaults."""
    readers = [_reader(each, _spelling(), "examples") for each in set_by_hosts()]
    binding, _ = every_builtin()
    spelling = spelling_of(binding, registry.load("rust"))
    readers.append(_reader(binding.blocks[0], spelling, "builtins"))
    turns: list[str] = []
    known: dict[tuple[str, int, str], str] = {}
    for number, sample in enumerate(samples()):
        name = _spelling().type(sample.block.name)
        if sample.block.derivation is None:
            known[sample.material, sample.seed, sample.block.plain_name] = f"b{number}"
            turns.append(f"let b{number} = read_examples_{name}(numbers);")
            turns.append(f"tell(b{number}.bytes());")
        else:
            sources = [f"&{known[sample.material, sample.seed, each]}" for each in sample.sources]
            function = _spelling().function(deriving(sample.block))
            turns.append(f"tell({function}({', '.join(sources)}).bytes());")
    turns += [f"tell({_spelling().type(block.name)}::DEFAULT.bytes());" for block, _ in defaults()]
    turn = "tell(builtins::derive_results(&read_builtins_Operands(numbers)).bytes());"
    builtins = f"fn all_builtins(numbers: &mut Numbers) {{\nuse builtins::Bytes;\n{turn}\n}}\n"
    turns += ["all_builtins(numbers);"] * ROUNDS
    begin = "let numbers = &mut Numbers(std::io::stdin().lines());"
    turns.append("draw_all(numbers);")
    frames = RECORDER + drawers(_spelling(), _reads)
    main = "\n".join(["fn main() {", "checked();", "small();", begin, *turns, "}", ""])
    return _HEAD + _PLASTIC + _SMALL_CHECKED + "".join(readers) + builtins + frames + main


def _numbers(value: Any) -> Iterator[str]:
    if isinstance(value, tuple):
        for each in value:
            yield from _numbers(each)
    elif isinstance(value, float):
        yield struct.pack(">f", value).hex()
    else:
        yield f"{int(value) & 0xFFFFFFFF:x}"


def _input() -> str:
    given = (sample for sample in samples() if sample.block.derivation is None)
    values = [each.values for each in given] + [operands(seed) for seed in range(ROUNDS)]
    rows = (*(tuple(each.values()) for each in values), *drawn_values())
    return "\n".join(number for each in rows for number in _numbers(each))


@pytest.fixture(scope="module")
def lines(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """What the program tells: the bytes of all blocks, then the calls of each drawing."""
    folder = tmp_path_factory.mktemp("rust")
    language = registry.load("rust")
    texts = {
        "examples.rs": written(everything(), language),
        "builtins.rs": written(every_builtin()[0], language),
        "plastic.rs": burnish.bind(PLASTIC, "rust", "wgsl", embed=True),
        "main.rs": _program(),
    }
    (folder / "small.burnish").write_text(_SMALL, "utf-8")
    targets = ("wgsl", "glsl:es300")
    texts["small.rs"] = burnish.bind(folder / "small.burnish", "rust", targets)
    (material,) = burnish.compile(PLASTIC, "wgsl")
    texts |= {file.name: file.text for file in material.files}
    texts["Plastic.json"] = json.dumps(burnish.to_json(material.reflection))
    for name, text in texts.items():
        (folder / name).write_text(text, "utf-8")
    run([tool("rustc", "rustc"), *_STRICT, "main.rs"], cwd=folder, limit=600, check=True)
    return run([str(folder / "main")], text=_input(), check=True).stdout.splitlines()


@pytest.fixture(scope="module")
def told(lines: list[str]) -> list[bytes]:
    """The bytes of all blocks."""
    return [bytes.fromhex(line) for line in lines[: -len(drawings())]]


def test_values_have_the_bytes_of_the_runtime_and_so_have_derived_ones(told: list[bytes]) -> None:
    assert_bytes(told)


def test_blocks_begin_with_their_defaults(told: list[bytes]) -> None:
    assert_defaults(told)


def test_builtins_mean_what_they_do_in_the_reference(told: list[bytes]) -> None:
    assert_builtins(told)


def test_frames_are_drawn_as_burnish_draws_them(lines: list[str]) -> None:
    calls = map(json.loads, lines[-len(drawings()) :])
    found = zip(drawings(), calls, strict=True)
    assert not [text for each in found if (text := wrong(*each))]
