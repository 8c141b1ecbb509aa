"""Storage buffers: what is read of them, and what is said of wrong ones."""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.node import reachable
from burnish.compiler.ir.operations import BUFFER
from burnish.compiler.reference.evaluate import evaluate
from burnish.compiler.reference.storage_buffers import BufferReader, Contents

from .kit import shader

PAIR = "struct Pair { a : vec3  b : float }\n"


def color(text: str, buffers: dict[str, bytes], **counts: int) -> tuple[float, ...]:
    """The colour of a material that reads buffers."""

    def leaves(node):  # type: ignore[no-untyped-def]
        if node.op == "buffer":
            leaf = BUFFER.data(node)
            return (BufferReader(Contents(buffers[leaf.name]), leaf, node.type),)
        if node.op == "parameter":
            return (counts.get(node.data.name.replace(".", "_"), 0),)
        return None

    made = shader(f"{text}\npass P {{ target c : rgba32f = vec4(color, 1) }}", pass_="P")
    (result,) = made.results_of("target")
    return tuple(float(lane) for lane in evaluate(result.value, leaves, np))[:3]


def floats(*numbers: float) -> bytes:
    return np.array(numbers, "<f4").tobytes()


def test_an_element_is_read_by_its_number() -> None:
    text = "material M { buffer w : float[]  color = vec3(w[0], w[1], w[2]) }"
    assert color(text, {"w": floats(1, 2, 3)}, w_count=3) == (1, 2, 3)


def test_beyond_the_ends_the_nearest_element_is_meant() -> None:
    text = "material M { buffer w : float[]  param m : int = -5  color = vec3(w[m], w[2], w[99]) }"
    assert color(text, {"w": floats(1, 2)}, w_count=2) == (1, 2, 2)


def test_of_no_elements_the_first_is_read() -> None:
    text = "material M { buffer w : float[]  color = vec3(w[0], w[7], float(w.count)) }"
    assert color(text, {"w": floats(0)}, w_count=0) == (0, 0, 0)


def test_a_loop_reads_all_elements() -> None:
    text = "material M { buffer w : float[]  color = vec3(sum i in 0..w.count up to 9 : w[i]) }"
    assert color(text, {"w": floats(1, 2, 4)}, w_count=3) == (7, 7, 7)


def test_structures_matrices_and_vectors_of_three_lanes_have_gaps() -> None:
    text = (
        f"{PAIR}material M {{ buffer p : Pair[]  buffer v : vec3[]  buffer m : mat2[]\n"
        "color = p[1].a * p[1].b + v[1] + vec3(m[1] * vec2(1, 2), 0) }"
    )
    contents = {
        "p": floats(0, 0, 0, 0, 1, 2, 3, 10),
        "v": floats(0, 0, 0, 9, 4, 5, 6, 9),
        "m": floats(*[0] * 8, 1, 0, 9, 9, 0, 1, 9, 9),
    }
    assert color(text, contents, p_count=2, v_count=2, m_count=2) == (15, 27, 36)


def test_functions_take_buffers() -> None:
    text = (
        "fn total(b: float[]) -> float = sum i in 0..b.count up to 4 : b[i]\n"
        "material M { buffer w : float[]  buffer x : float[]\n"
        "color = vec3(total(w), total(x), total(w) + total(x)) }"
    )
    contents = {"w": floats(1, 2), "x": floats(5)}
    assert color(text, contents, w_count=2, x_count=1) == (3, 5, 8)


def test_a_buffer_sets_what_a_base_leaves_open() -> None:
    text = (
        "abstract material Base { w : float[]  color = vec3(w[0]) }\n"
        "material M : Base { buffer w : float[] }"
    )
    assert color(text, {"w": floats(3)}, w_count=1) == (3, 3, 3)


def test_lights_and_passes_have_buffers() -> None:
    text = """
    light Bulbs : Light { buffer tints : vec3[]  to_light = vec3(0, 0, 1)  diffuse = tints[1] }
    rig R { bulbs : Bulbs }
    term plain() per light = light.diffuse
    material M { buffer gains : float[]  color = plain() * gains[0] }
    pass P { buffer gains : float[]  target c : rgba8 = vec4(color * gains[0], 1) }
    """
    (made,) = burnish.compile(text, targets=("wgsl",), rig="R", pass_="P").materials
    rows = {row.name: row for row in made.reflection.buffers}
    assert list(rows) == ["P.gains", "gains", "bulbs.tints"]
    assert [row.group for row in rows.values()] == ["frame", "material", "rig"]
    assert [row.count for row in rows.values()] == [
        "P.gains.count", "gains.count", "bulbs.tints.count",
    ]  # fmt: skip


def test_only_the_index_of_a_loop_over_the_buffer_is_not_clamped() -> None:
    def mins(loop: str) -> int:
        made = shader(
            f"material M {{ buffer w : float[] buffer x : float[] color = vec3({loop}) }}"
        )
        nodes = reachable(made.roots)
        return sum(node.op == "call" and node.data == "min" for node in nodes)

    assert mins("sum i in 0..w.count up to 9 : w[i]") == 0
    assert mins("sum i in 0..w.count up to 9 : x[i]") == 1
    assert mins("sum i in 1..w.count up to 9 : w[i]") == 1
    assert mins("sum i in 0..9 : w[i]") == 1


WRONG = [
    (
        "buffer w : float  color = vec3(1)",
        "expected a type like `T[]`, found float",
        "a buffer has any number of elements: write `float[]`",
    ),
    (
        "buffer w : vec3[4]  color = vec3(1)",
        "expected a type like `T[]`, found vec3[4]",
        "a buffer that is read has as many elements as the host binds: write `vec3[]`",
    ),
    (
        "buffer w : texture2d[]  color = vec3(1)",
        "expected a type of values, found texture2d",
        "layers of one texture are a `texture2d_array`",
    ),
    (
        "param w : float[]  color = vec3(1)",
        "expected a value, found float[]",
        "declare a storage buffer with `buffer w : float[]`, or write how many elements there are: "
        "`[4]`",
    ),
    (
        "buffer w : float[]  color = w * vec3(2)",
        "no `*` between float[] and vec3",
        "elements of a buffer are read by their number: `name[i]`",
    ),
    (
        "buffer w : float[]  x : float = w  color = vec3(x)",
        "expected float, found float[]",
        "elements of a buffer are read by their number: `name[i]`",
    ),
    (
        "buffer w : float[]  color = vec3(w.length)",
        "`length`",
        "elements are read by their number, `b[i]`, and `b.count` is how many there are",
    ),
    (
        "buffer w : float[]  color = vec3(w[uv.x])",
        "expected int, found float",
        "write `int(uv.x)`",
    ),
    (
        "buffer w : float[]  color = vec3((if uv.x > 0 then w else w)[0])",
        "expected a value, found float[]",
        "choose between what is read, not between buffers",
    ),
    (
        "buffer w : float[]  color = vec3([w, w][0][0])",
        "expected a value, found float[]",
        "buffers cannot be elements: gather what is read of them",
    ),
    (
        "buffer w : float[]  color = vec3(sum i in 0..w.count : w[i])",
        "",
        "give the parameter a range, `in 0..16`, or write `up to 16` behind the bounds",
    ),
]


@pytest.mark.parametrize(("members", "message", "hint"), WRONG, ids=[row[0] for row in WRONG])
def test_wrong_uses_are_reported(members: str, message: str, hint: str) -> None:
    with pytest.raises(CompileError) as error:
        shader(f"material M {{ {members} }}")
    (found,) = error.value.diagnostics
    assert message in found.message
    assert hint == str(found.hint)


def test_a_structure_has_no_member_of_any_length() -> None:
    with pytest.raises(CompileError) as error:
        shader("struct S { w : float[] }\nmaterial M { param s : S  color = vec3(1) }")
    assert "any number of elements is a `buffer`" in str(error.value.diagnostics[0].hint)
