"""The binding of all examples, with values for each of its blocks and the bytes of the runtime.

Bindings share blocks, so each block is asked for once, with the values of the first material that
has it. All languages read the same samples.
"""

from __future__ import annotations

import json
import math
import random
import struct
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import burnish
from burnish.api.compiled import CompiledFrame, CompileResult
from burnish.bindings.gathering import Compiled, CompiledPlan, gathered
from burnish.bindings.model import Binding, Block, Frame, Material
from burnish.targets.runner.instances.blocks import write
from burnish.targets.runner.instances.shapes import Elements, Members, Numbers, Shape, shape_of
from burnish.targets.runner.instances.values import filled

EXAMPLES = Path(__file__).parents[2] / "examples"
PLASTIC = EXAMPLES / "plastic.burnish"
SEEDS = (1, 2, 3)
"""Samples of each block. Those of the last one are edges: zeros, and the ends of ranges."""


class Sample(NamedTuple):
    """Values of a block, and its bytes."""

    block: Block
    values: dict[str, Any]
    """The values of fields by their words; none of a derived block."""
    sources: dict[str, Block]
    """Of a derived block those that it is computed from, by the names in the reflection."""
    expected: bytes
    seed: int
    material: str


@cache
def everything() -> Binding:
    """The binding of all examples that have materials or frames."""
    found: list[Compiled] = []
    plans = []
    for result in _compiled():
        for frame in result.frames:
            first = len(found)
            numbers = {each.name: first + number for number, each in enumerate(result)}
            shaders = tuple(numbers[each.name] for each in frame.shaders)
            plans.append(CompiledPlan(plan=frame.plan, shaders=shaders))
        found += [Compiled(reflection=each.reflection, texts={}) for each in result]
    return gathered(found, plans, ("examples",), "examples")


@cache
def _compiled() -> tuple[CompileResult, ...]:
    paths = sorted((*EXAMPLES.glob("*.burnish"), *EXAMPLES.glob("frames/*.burnish")))
    # A file with several rigs wants to be told one.
    one = [path for path in paths if "rig Noon" not in path.read_text("utf-8")]
    return tuple(burnish.compile(path, "wgsl", keep_graphs=False) for path in one)


def set_by_hosts() -> list[Block]:
    """The blocks of materials that hosts set; those of frames have no samples."""
    return [each for each in everything().blocks if each.derivation is None and not each.about]


def compiled_frames() -> tuple[tuple[Frame, CompiledFrame], ...]:
    """The frames of all examples."""
    compiled = [frame for result in _compiled() for frame in result.frames]
    return tuple(zip(everything().frames, compiled, strict=True))


@cache
def samples() -> tuple[Sample, ...]:
    """The samples of all blocks: those that a host sets before those that are computed."""
    binding = everything()
    return tuple(
        sample
        for seed in SEEDS
        for material in binding.materials
        for sample in _of_material(material, seed)
        if sample.block.name in _asked(material)
    )


def _asked(material: Material) -> set[str]:
    """The blocks that are asked for with a material's values, and those that they are computed of.

    They are those that no material before has.
    """
    own = [each for each in material.blocks if _first_with(each.name) == material.name]
    return {each.name for each in own} | {source.name for each in own for source in each.sources}


@cache
def _owners() -> dict[str, str]:
    found: dict[str, str] = {}
    for material in everything().materials:
        for block in material.blocks:
            found.setdefault(block.name, material.name)
    return found


def _first_with(block: str) -> str:
    return _owners()[block]


def _of_material(material: Material, seed: int) -> Iterator[Sample]:
    if not _asked(material):
        return
    instance = burnish.Instance(material.reflection)
    chance = random.Random(f"{material.name} {seed}")
    rows = material.reflection.parameters
    values = {row.name: _value(shape_of(row), chance, seed) for row in rows}
    # Counts of buffers among them, which `set` leaves to the buffers.
    instance._values |= values
    blocks = instance.blocks()
    for block in material.blocks:
        found = {}
        if block.derivation is None:
            found = {field.word: values[field.name] for field in block.structure.fields}
            expected = blocks.get(block.plain_name) or _loose(block, found)
        else:
            expected = blocks[block.plain_name]
        sources = {each.plain_name: material.block(each.plain_name) for each in block.sources}
        yield Sample(block, found, sources, expected, seed, material.name)


def _loose(block: Block, values: dict[str, Any]) -> bytes:
    """The bytes of a block that no shader reads, whose offsets the binding has chosen."""
    (rows,) = [
        {row.name: row for row in material.reflection.parameters}
        for material in everything().materials
        if material.name == _first_with(block.name)
    ]
    found = bytearray(block.structure.size)
    for field in block.structure.fields:
        write(found, field.offset, shape_of(rows[field.name]), values[field.word])
    return bytes(found)


def defaults() -> Iterator[tuple[Block, bytes]]:
    """Each block that a host sets, and the bytes of its defaults; zeros where there are none."""
    binding = everything()
    for block in binding.blocks:
        if block.derivation is None and not block.about:
            (material,) = [m for m in binding.materials if m.name == _first_with(block.name)]
            rows = {row.name: row for row in material.reflection.parameters}
            instance = burnish.Instance(material.reflection)
            found = bytearray(block.structure.size)
            for field in block.structure.fields:
                shape = shape_of(rows[field.name])
                write(found, field.offset, shape, filled(shape, instance._values[field.name]))
            yield block, bytes(found)


def _value(shape: Shape, chance: random.Random, seed: int) -> Any:
    match shape:
        case Elements():
            return tuple(_value(shape.element, chance, seed) for _ in range(shape.count))
        case Members():
            return tuple(_value(member.shape, chance, seed) for member in shape.members)
        case Numbers():
            columns = [_lanes(shape, chance, seed) for _ in range(shape.columns or 1)]
            return tuple(columns) if shape.columns else columns[0]


def _lanes(shape: Numbers, chance: random.Random, seed: int) -> tuple[Any, ...]:
    if shape.kind == "float" and shape.lanes > 1 and shape.meaning in ("direction", "normal"):
        lanes = [chance.gauss(0, 1) for _ in range(shape.lanes)]
        return tuple(_single(lane / math.hypot(*lanes)) for lane in lanes)
    return tuple(_lane(shape, chance, seed) for _ in range(shape.lanes))


def _lane(shape: Numbers, chance: random.Random, seed: int) -> Any:
    if shape.kind == "bool":
        return chance.random() < 0.5
    low, high = shape.range or ((0, 9) if shape.kind != "float" else (-3.0, 3.0))
    is_edge = seed == SEEDS[-1]
    if shape.kind != "float":
        low, high = math.ceil(max(low, -100)), math.floor(min(high, 100))
        return chance.choice((low, high)) if is_edge else chance.randint(low, high)
    inside = max(low, min(0.0, high))
    wish = chance.choice((low, high, inside)) if is_edge else chance.uniform(low, high)
    return _single(wish)


def _single(value: float) -> float:
    (found,) = struct.unpack("<f", struct.pack("<f", value))
    return float(found)


def difference(expected: bytes, found: bytes) -> str:
    """What differs between the bytes of a block: empty, or numbers that are no neighbours.

    The runtime and a host may have other libraries of mathematics, whose last bits differ.
    """
    if len(expected) != len(found):
        return f"{len(found)} bytes instead of {len(expected)}"
    for at in range(0, len(expected), 4):
        one, other = expected[at : at + 4], found[at : at + 4]
        if one != other and not _neighbours(one, other):
            pair = (*struct.unpack("<f", other), *struct.unpack("<f", one))
            return f"at {at}: {pair[0]!r} instead of {pair[1]!r}"
    return ""


def _neighbours(one: bytes, other: bytes) -> bool:
    numbers = [struct.unpack("<i", each)[0] for each in (one, other)]
    return abs(numbers[0] - numbers[1]) <= 1 and all(abs(n) > 0x00800000 for n in numbers)


def reflections() -> list[Any]:
    """The reflection of plastic, and what may have become of it since a binding was made.

    A block has another layout; there is another block; the view is bound elsewhere; the texture is
    another one; it is the reflection of another rig, or has other targets; it is none.
    """
    (plain,) = burnish.compile(PLASTIC, "wgsl")
    (moved,) = burnish.compile(PLASTIC, "wgsl", bindings={"first": {"view": 4}})
    text = PLASTIC.read_text("utf-8").replace("albedo", "wood")
    (other,) = burnish.compile(text, "wgsl")
    (renamed,) = burnish.compile(PLASTIC.read_text("utf-8").replace("Studio", "Room"), "wgsl")
    (elsewhere,) = burnish.compile(PLASTIC, "glsl")
    materials = (plain, plain, plain, moved, other, renamed, elsewhere)
    found = [json.loads(json.dumps(burnish.to_json(each.reflection))) for each in materials]
    next(row for row in found[1]["blocks"] if row["name"] == "Rig")["layout_id"] = "0"
    found[2]["blocks"].append({"name": "Fog", "layout_id": "1"})
    return [*found, {}]


ELSEWHERE = "other things are bound or fed, or elsewhere; run `burnish bind` again"
"""What is told of two others."""
UNFIT = [
    "the reflection is of another material, pass or rig; if that is meant, run `burnish bind` "
    "again",
    "the reflection has none of the binding's targets: give `burnish bind` those of "
    "`burnish compile`",
    "that is no reflection: it has no `blocks`",
]
"""What is told of the last three, by languages that search the text."""
UNFIT_BY_NAME = [
    "the reflection is of `Plastic`, `Forward`, `Room`, and the binding of `Plastic`, `Forward`, "
    "`Studio`; if that is meant, run `burnish bind` again",
    "the binding has no tables for `glsl:vulkan`: give `burnish bind` the targets of "
    "`burnish compile`",
    "that is no reflection, as `burnish compile` writes it",
]
"""The same, by languages that read documents."""
