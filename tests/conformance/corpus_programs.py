"""Programs that execute the cases of the corpus on a device.

The operands lie in textures of float32 and of integers: a row for each overload, a column for each
of its cases. Each program calls as many overloads as its render targets have lanes for, and draws a
single row of pixels, one for each case.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import burnish
from burnish.stdlib.builtins.overloads import Overload, Shape
from burnish.targets.conformance.corpus.operands import (
    OPERATIONS,
    SCALAR_CASES,
    CorpusCase,
    cases_of,
    chosen_overloads,
)
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.frames.states import draw_states
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.routes import Route
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import set_up
from burnish.targets.runner.textures.texture import Texture

from ..builtins.overloads import FLOAT_MAPS, INT_MAPS, LANES, call, first_map, lane_names
from .kit import Studio

Floats = NDArray[np.float64]

_SWIZZLES = ("", "x", "xy", "xyz", "xyzw")


@dataclass(frozen=True)
class Called:
    """An overload with its cases, and its row of the textures."""

    overload: Overload
    cases: list[CorpusCase]
    row: int

    @property
    def lanes(self) -> int:
        """The lanes of render targets that its result takes: two for an integer of 32 bits."""
        result = self.overload.result
        return result.lanes * (2 if result.kind in ("int", "uint") else 1)


def all_called(seed: int) -> list[Called]:
    """All overloads of the corpus."""
    found = [each for row in OPERATIONS.values() for each in chosen_overloads(row)]
    return [Called(each, cases_of(each, seed), row) for row, each in enumerate(found)]


def batches(called: Sequence[Called]) -> Iterator[list[Called]]:
    """The overloads in groups, of which each fits a program."""
    batch: list[Called] = []
    for each in called:
        if batch and sum(other.lanes for other in (*batch, each)) > LANES:
            yield batch
            batch = []
        batch.append(each)
    yield batch


def textures(called: Sequence[Called]) -> dict[str, Texture]:
    """The operands of all cases."""
    size = (len(called), SCALAR_CASES, 4)
    floats = np.zeros((FLOAT_MAPS, *size), "<f4")
    integers = np.zeros((INT_MAPS, *size), "<i4")
    for each in called:
        for column, case in enumerate(each.cases):
            pairs = zip(each.overload.operands, case.operands, strict=True)
            for k, (shape, lanes) in enumerate(pairs):
                first = first_map(each.overload, k)
                for start in range(0, shape.lanes, shape.width):
                    array = floats if shape.kind == "float" else integers
                    numbers = np.array(lanes[start : start + shape.width])
                    place = first + start // shape.width, each.row, column
                    array[place][: shape.width] = (
                        numbers if shape.kind == "float" else numbers.astype("<i8").astype("<i4")
                    )
    return {
        **{
            f"f{k}": Texture("rgba32float", SCALAR_CASES, len(called), (array.tobytes(),))
            for k, array in enumerate(floats)
        },
        **{
            f"i{k}": Texture("rgba32sint", SCALAR_CASES, len(called), (array.tobytes(),))
            for k, array in enumerate(integers)
        },
    }


def text_of(batch: Sequence[Called]) -> str:
    """The program that calls some overloads."""
    lines = ["burnish 1", "material Cells {"]
    lines += [f"    map f{k} : texture2d" for k in range(FLOAT_MAPS)]
    lines += [f"    map i{k} : itexture2d" for k in range(INT_MAPS)]
    numbers: list[str] = []
    for each in batch:
        operands = [_operand(each, k, shape) for k, shape in enumerate(each.overload.operands)]
        lines.append(f"    r{each.row} = {call(each.overload, operands)}")
        numbers += _numbers(f"r{each.row}", each.overload.result)
    lines += ["}", "pass Returned {", "    clip_position = vec4(vertex_position, 1)"]
    for target, start in enumerate(range(0, len(numbers), 4)):
        four = [*numbers[start : start + 4], "0", "0", "0"][:4]
        lines.append(f"    target t{target} : rgba32f = vec4({', '.join(four)})")
    return "\n".join([*lines, "}", ""])


def _operand(called: Called, operand: int, shape: Shape) -> str:
    """The text of an operand, read from the textures."""
    first = first_map(called.overload, operand)
    swizzle = _SWIZZLES[shape.width]
    letter = "f" if shape.kind == "float" else "i"
    place = f"load(ivec2(int(frag_coord.x), {called.row}), 0).{swizzle}"
    if shape.columns:
        return f"{shape}({', '.join(f'f{first + c}.{place}' for c in range(shape.columns))})"
    read = f"{letter}{first}.{place}"
    if shape.kind == "bool":
        return f"({read} == 1)"
    return f"{shape}({read})" if shape.kind == "uint" else read


def _numbers(name: str, shape: Shape) -> Iterator[str]:
    """The lanes of a result as floats; integers in halves of 16 bits."""
    for lane in lane_names(name, shape):
        if shape.kind == "float":
            yield lane
        elif shape.kind == "bool":
            yield f"float({lane})"
        else:
            yield from (f"float(uint({lane}) & 65535u)", f"float(uint({lane}) >> 16)")


def returned(
    batch: Sequence[Called], operands: dict[str, Texture], route: Route, studio: Studio
) -> Iterator[tuple[Called, list[Floats]]]:
    """For each overload the lanes of its result, with a number for each case.

    Integers come as numbers from 0 to 2^32 - 1, which are their bits.
    """
    (material,) = burnish.compile(text_of(batch), (route.profile,), pass_="Returned").materials
    instance = material.instance()
    for row in material.reflection.textures:
        instance.set(row.name, operands[row.name])
    state = set_up(instance, plane(1), Scene(), (SCALAR_CASES, 1))
    exact = Exact.of(material)
    codes = compile_one(route, material.files, studio.toolchain)
    made = pipeline(exact.reflection, route, codes)
    (outcome,) = draw_states(exact, [state], route, made, studio.runner, keep=False)
    lanes = [target[0, :, lane] for target in outcome.pictures for lane in range(4)]
    start = 0
    for each in batch:
        own = lanes[start : start + each.lanes]
        start += each.lanes
        if each.overload.result.kind in ("int", "uint"):
            own = [low + 65536.0 * high for low, high in zip(own[::2], own[1::2], strict=True)]
        yield each, own
