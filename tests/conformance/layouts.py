"""Programs that show every lane of their parameters, one pixel for each vector or column.

Tests draw them to check byte layouts. Elements are read by computed indices, so that a wrong stride
is as visible as a wrong offset.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count
from random import Random

from burnish.compiler.ir.groups import STANDARD_GROUPS
from burnish.compiler.ir.types import Array, Scalar, ScalarKind, Struct, Type, Vector

from ..layout.declarations import ELEMENTS, KINDS
from .declarations import (
    PLAIN,
    Declarations,
    Unit,
    Value,
    choice,
    size_of,
    units_of,
    value_of,
)

GROUPS = (*STANDARD_GROUPS, "weather")
LARGEST = 24
"""The largest number of pixels for all parameters: drivers take seconds to compile more."""
PASS = "Values"
INT = Scalar("int")
SEVERAL = 3
"""The number of lights in an array; if it is counted at run time, the maximum."""

Lights = Mapping[str, Sequence[Mapping[str, Value]]]


@dataclass(frozen=True, slots=True)
class Layout:
    """A program, the values of its parameters, and the expected picture."""

    text: str
    values: Mapping[str, Value]
    units: Sequence[Unit]
    """The expected contents, pixel by pixel."""


def random_layout(seed: int, largest: int = LARGEST) -> Layout:
    """Random parameters of all groups, and lights with members: a single one and an array.

    The parameters take up to ``largest`` pixels; those of lights take some more.
    """
    chance = Random(seed)
    declarations = Declarations(chance)
    types = _types(declarations, largest, depth=2)
    light = _types(declarations, largest // 6, depth=1)
    groups = [chance.choice(GROUPS) for _ in types]
    return _layout(chance, list(zip(types, groups, strict=True)), light, declarations.structs)


def _types(declarations: Declarations, largest: int, depth: int) -> list[Type]:
    """Random types that together take at most ``largest`` pixels; larger ones are left out."""
    types: list[Type] = []
    for _ in range(max(largest // 3, 2)):
        drawn = declarations.type(depth)
        if sum(map(size_of, [*types, drawn])) <= largest:
            types.append(drawn)
    return types or [INT]


def every_type() -> Layout:
    """All types but arrays and structures, distributed over the groups."""
    return _listed(PLAIN)


def every_element() -> Layout:
    """Arrays of all types that are stored differently, with one element and with several."""
    return _listed([Array(element, count) for element in ELEMENTS for count in (1, 3)])


def every_neighbour() -> Layout:
    """All pairs of vector sizes as neighbours, between which gaps arise: in blocks and in
    structures."""
    types = [_lanes(KINDS[i % len(KINDS)], size) for i, size in enumerate(NEIGHBOURS)]
    inside = Struct("Inside", tuple((f"m{i}", type_) for i, type_ in enumerate(types)))
    parameters = [*types, Scalar("float"), Array(inside, 2)]
    placed = [(type_, "material") for type_ in parameters]
    return _layout(Random(0), placed, types, [inside])


NEIGHBOURS = (1, 1, 2, 1, 3, 1, 4, 2, 2, 3, 2, 4, 3, 3, 4, 4, 1)
"""Numbers of lanes in an order in which each pair of neighbours occurs."""


def _lanes(kind: ScalarKind, size: int) -> Type:
    return Scalar(kind) if size == 1 else Vector(kind, size)


def _listed(types: Sequence[Type]) -> Layout:
    placed = [(type_, GROUPS[i % len(GROUPS)]) for i, type_ in enumerate(types)]
    return _layout(Random(0), placed, [INT], [])


def _layout(
    chance: Random,
    parameters: Sequence[tuple[Type, str]],
    light: Sequence[Type],
    structs: Sequence[Struct],
) -> Layout:
    values = {f"p{i}": value_of(chance, type_) for i, (type_, _) in enumerate(parameters)}
    counted = chance.random() < 0.5
    probe = Struct("Probe", (("id", INT), *((f"m{i}", type_) for i, type_ in enumerate(light))))
    lights = _lights(chance, probe, counted)
    units = [
        unit
        for i, (type_, _) in enumerate(parameters)
        for unit in units_of(f"p{i}", type_, values[f"p{i}"])
    ]
    shown = [*units, *_light_units(probe, lights)]
    everything = {**values, **lights, "alone": lights["alone"][0]}
    return Layout(_text(parameters, probe, structs, len(units), counted), everything, shown)


def _lights(chance: Random, probe: Struct, counted: bool) -> Lights:
    """Values for the lights of the rig, in its order; each light has its own id."""
    counts = {"alone": 1, "several": chance.randint(0, SEVERAL) if counted else SEVERAL}
    ids = count()
    return {
        name: [{**value_of(chance, probe), "id": next(ids)} for _ in range(number)]
        for name, number in counts.items()
    }


def _light_units(probe: Struct, lights: Lights) -> Iterator[Unit]:
    for name, each in lights.items():
        for i, light in enumerate(each):
            yield from units_of(f"{name}[{i}]", probe, light)


def _text(
    parameters: Sequence[tuple[Type, str]],
    probe: Struct,
    structs: Sequence[Struct],
    units: int,
    counted: bool,
) -> str:
    """The text of a program; its parameters take ``units`` pixels, and the lights the next ones."""
    slots: list[str] = []

    def named(expression: str) -> str:
        slots.append(expression)
        return f"n{len(slots) - 1}"

    places = [(type_, f"p{i}") for i, (type_, _) in enumerate(parameters)]
    shown = choice(places, "number", named)
    light = choice([(type_, f"light.{name}") for name, type_ in probe.members], "number", _inline)
    each = size_of(probe)
    lines = [
        *(_braced(f"struct {struct.name}", _fields(struct)) for struct in structs),
        _braced(
            "light Probe : Light",
            [f"param {line}" for line in _fields(probe)] + ["to_light = vec3(0, 0, 1)"],
        ),
        _braced("rig Lit", ["alone : Probe", f"several : Probe[{'<= ' * counted}{SEVERAL}]"]),
        # A product, since lavapipe 22.3.6 makes constants of the uniforms that loops branch on, and
        # with some layouts that kills it.
        f"term probed(wanted: int, number: int) per light = float(light.id == wanted) * {light}",
        _braced(
            "material Shown",
            [
                *(
                    f"param p{i} : {type_} per {group}"
                    for i, (type_, group) in enumerate(parameters)
                ),
                "number = int(frag_coord.x)",
                f"beyond = number - {units}",
                *(f"n{i} = {expression}" for i, expression in enumerate(slots)),
                f"shown = if number < {units} then {shown}"
                f" else probed(beyond / {each}, beyond mod {each})",
            ],
        ),
        _braced(
            f"pass {PASS}",
            ["clip_position = vec4(vertex_position, 1)", "target value : rgba32f = material.shown"],
        ),
    ]
    return "\n".join(lines)


def _inline(expression: str) -> str:
    """The expression unchanged: a term has no slots that could give it a name."""
    return f"({expression})"


def _fields(struct: Struct) -> list[str]:
    return [f"{name} : {type_}" for name, type_ in struct.members]


def _braced(head: str, lines: Sequence[str]) -> str:
    return "\n    ".join([f"{head} {{", *lines]) + "\n}"
