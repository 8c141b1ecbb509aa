"""Kernels: what their results are, and what is said of wrong ones."""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.kernel import USUAL, invocations
from burnish.compiler.ir.node import reachable
from burnish.compiler.ir.stages import COMPUTED, EXTENT, IMAGE, STORE
from burnish.targets.description.profile import Limits

from .kit import shader

BOX = "struct Box { a : vec3  b : bvec2  c : float[5]  d : vec2[3] }\n"


def written(text: str) -> list[tuple[str, str, str]]:
    """The path, stride and offset, and type of each part of a kernel's results."""
    made = shader(text)
    found = []
    for result in made.results_of(STORE):
        store = result.store
        assert store is not None
        place = f"{store.stride}+{store.offset}"
        path = ".".join([store.buffer.name, *map(str, store.path)])
        found.append((path, place, str(result.value.type)))
    return found


def test_a_kernel_has_one_stage_and_an_extent() -> None:
    made = shader("kernel K { buffer b : float[]  result r : float[b.count] = b[index] }")
    assert made.chain == COMPUTED
    assert {result.stage for result in made.results} == set(COMPUTED)
    assert len(made.results_of(EXTENT)) == 1
    assert [info.leaf.name for info in made.written] == ["r"]
    assert [info.leaf.name for info in made.buffers] == ["b"]


def test_structures_are_written_part_by_part_as_they_are_stored() -> None:
    text = f"{BOX}kernel K {{ buffer b : Box[]  result r : Box[b.count] = b[index] }}"
    assert written(text) == [
        ("r.a", "1+0", "vec3"),
        ("r.b", "1+0", "uvec2"),
        ("r.c.0", "1+0", "vec4"),
        ("r.c.1", "1+0", "vec4"),
        ("r.d.0", "1+0", "vec4"),
        ("r.d.1", "1+0", "vec4"),
    ]


def test_vectors_of_three_lanes_and_columns_fill_four() -> None:
    text = "kernel K { result v : vec3[9] = vec3(1)  result m : mat3[9] = mat3(2) }"
    assert written(text) == [
        ("v", "1+0", "vec4"),
        ("m", "3+0", "vec4"),
        ("m", "3+1", "vec4"),
        ("m", "3+2", "vec4"),
    ]


@pytest.mark.parametrize(
    ("read", "clamps"),
    [
        ("b[index]", 0),
        ("b[index + 1]", 1),
        ("c[index]", 1),
        ("sum i in 0..b.count up to 4 : b[i]", 0),
    ],
)
def test_the_own_element_needs_no_check(read: str, clamps: int) -> None:
    buffers = "buffer b : float[]  buffer c : float[]"
    made = shader(f"kernel K {{ {buffers}  result r : float[b.count] = {read} }}")
    nodes = reachable(made.roots)
    assert sum(node.op == "call" and node.data == "min" for node in nodes) == clamps


def test_kernels_have_bases_and_mixins() -> None:
    text = """
    abstract kernel Base { param k : float = 2  value : float  result r : float[4] = k * value }
    mixin Own for kernel { value = float(index) }
    kernel K : Base + Own { k = 3 }
    """
    (made,) = burnish.compile(text, ("wgsl",)).materials
    assert made.reflection.extent is not None
    assert "3.0 * f32(index)" in made.text("wgsl", "compute")


def test_kernels_come_after_the_materials_of_a_file() -> None:
    text = "kernel K { result r : float[4] = 1 }\nmaterial M { color = vec3(1) }"
    result = burnish.compile(text, ("wgsl",))
    assert [each.name for each in result] == ["M", "K"]
    (alone,) = burnish.compile(text, ("wgsl",), material="K")
    assert alone.name == "K"


def test_the_host_computes_the_extent() -> None:
    members = "param n : int in 0..9 = 4  buffer b : float[]"
    text = f"kernel K {{ {members}  result r : float[n * b.count - 2] = 1 }}"
    instance = burnish.compile(text, ("wgsl",))["K"].instance()
    assert instance.extent() == 0
    instance.set("b", [1, 2, 3])
    assert instance.extent() == 10
    instance.set("n", 1)
    assert instance.extent() == 1


WRONG = [
    ("param x : float = 1", "B0510", "`K` computes nothing"),
    ("result r : float = 1", "B0511", "`r` does not tell its number of elements"),
    ("result r : float[] = 1", "B0511", "`r` does not tell its number of elements"),
    (
        "buffer b : int[]  result r : float[b[0]] = 1",
        "B0512",
        "the number of elements of `r` is not known to the host",
    ),
    (
        "result r : float[index] = 1",
        "B0201",
        "unknown name `index`",
    ),
    (
        "result r : float[4] = 1  result s : float[5] = 1",
        "B0513",
        "`s` has another number of elements than `r`",
    ),
    (
        "runs over 4  result r : float[5] = 1",
        "B0513",
        "`r` has another number of elements than `runs over` says",
    ),
    (
        "buffer b : S[]  result r : S[b.count] = b[index]",
        "B0514",
        "a kernel cannot write elements of the type S",
    ),
    (
        "result r : texture2d[4] = 1",
        "B0514",
        "a kernel cannot write elements of the type texture2d",
    ),
    ("result r : float[4] = ddx(float(index))", "B0515", "`ddx` is not available in a kernel"),
    (
        "map t : texture2d  result r : vec4[4] = t(vec2(0.5))",
        "B0515",
        "`sample` is not available in a kernel",
    ),
    (
        "result i : image2d<rgba8>[ivec2(4)] = vec4(1)  result r : float[4] = 1",
        "B0550",
        "`r` is a buffer, and the first result is an image",
    ),
    (
        "result r : float[4] = 1  result i : image2d<rgba8>[ivec2(4)] = vec4(1)",
        "B0550",
        "`i` is an image, and the first result is a buffer",
    ),
    (
        "result i : image2d[ivec2(4)] = vec4(1)",
        "B0551",
        "`i` does not say of which format its texels are",
    ),
    ("result i : image2d<rgba9>[ivec2(4)] = vec4(1)", "B0201", "unknown format `rgba9`"),
    ("result i : image2d<rgba8> = vec4(1)", "B0511", "`i` does not tell its size"),
    ("result i : image2d<rgba8>[4.0] = vec4(1)", "B0301", "expected ivec2, found float"),
    (
        "result i : image2d<rgba8>[texel] = vec4(1)",
        "B0201",
        "unknown name `texel`",
    ),
    (
        "map t : texture2d  result i : image2d<rgba8>[ivec2(t.load(ivec2(0)).xy)] = vec4(1)",
        "B0512",
        "the size of `i` is not known to the host",
    ),
    (
        "result i : image2d<r8>[ivec2(4)] = 1  result j : image2d<r8>[ivec2(5)] = 1",
        "B0513",
        "`j` has another size than `i`",
    ),
    (
        "result i : image2d<rgba8>[ivec2(4)] = vec2(1)",
        "B0301",
        "expected vec4 for rgba8, found vec2",
    ),
    (
        "result i : image2d<r8>[ivec2(4)] = ddx(float(texel.x))",
        "B0515",
        "`ddx` is not available in a kernel",
    ),
    ("result i : image2d<r8>[ivec2(4)] = uv.x", "B0201", "unknown name `uv`"),
    ("result i : image2d<r8>[ivec2(4)] = float(index)", "B0201", "unknown name `index`"),
    ("param p : image2d<r8>  result r : float[4] = 1", "B0201", "unknown type `image2d`"),
    ("result r : float[4] = vec2(1)", "B0301", "expected float, found vec2"),
    ("result r : float[4] = frag_coord.x", "B0201", "unknown name `frag_coord`"),
    ("result r : float[4] = 1  result r : float[4] = 2", "B0202", "`r` is declared twice"),
    (
        "target r : rgba8 = vec4(1)  result s : float[4] = 1",
        "B0213",
        "`target` does not belong in a kernel",
    ),
    (
        "attribute r : vec4  result s : float[4] = 1",
        "B0213",
        "`attribute` does not belong in a kernel",
    ),
]


@pytest.mark.parametrize(("members", "code", "message"), WRONG, ids=[row[0] for row in WRONG])
def test_wrong_kernels_are_reported(members: str, code: str, message: str) -> None:
    with pytest.raises(CompileError) as error:
        shader(f"struct S {{ m : mat3 }}\nkernel K {{ {members} }}")
    (found, *_) = error.value.diagnostics
    assert (found.rule.code, found.message) == (code, message)


def test_an_image_has_a_texel_for_each_invocation_and_a_size() -> None:
    made = shader(
        "kernel K { map t : texture2d  result i : image2d<rg16f>[t.size()] = vec2(texel.yx) }"
    )
    (image,) = made.results_of(IMAGE)
    assert made.chain == COMPUTED and image.stage in COMPUTED
    assert (image.name, str(image.value.type)) == ("i", "vec2")
    assert image.state is not None and image.state.format == "rg16f"
    assert [str(each.value.type) for each in made.results_of(EXTENT)] == ["ivec2"]


def test_the_host_computes_the_size() -> None:
    members = "map t : texture2d  param n : int in 0..9 = 4"
    text = f"kernel K {{ {members}  result i : image2d<r8>[t.size() * n - ivec2(0, 3)] = 1 }}"
    instance = burnish.compile(text, ("wgsl",))["K"].instance()
    assert instance.image_size() == (4, 1)
    instance.set("t", burnish.Texture.of_array(np.zeros((5, 7, 4), np.uint8)))
    instance.set("n", 1)
    assert instance.image_size() == (7, 2)
    instance.set("n", 0)
    assert instance.image_size() == (0, 0)


def test_a_kernel_of_the_other_kind_has_another_place() -> None:
    with pytest.raises(CompileError) as error:
        shader("kernel K { result i : image2d<r8>[ivec2(4)] = float(index) }")
    (found,) = error.value.diagnostics
    assert str(found.hint) == "this kernel has `texel`, of type ivec2"


def test_an_image_is_no_parameter() -> None:
    with pytest.raises(CompileError) as error:
        shader("kernel K { param p : image2d<rgba8>  result r : float[4] = 1 }")
    (found,) = error.value.diagnostics
    assert found.message == "unknown type `image2d`"
    assert "what is read is a texture, `map name : texture2d`" in str(found.hint)


def test_a_material_has_no_results() -> None:
    with pytest.raises(CompileError) as error:
        shader("material M { result r : float[4] = 1  color = vec3(1) }")
    assert str(error.value.diagnostics[0].hint) == "`result` belongs in a kernel"


@pytest.mark.parametrize(
    ("said", "size"),
    [("", (64, 1, 1)), ("work_group of 32", (32, 1, 1)), ("work_group of 2 * 8", (16, 1, 1))],
)
def test_work_groups_have_the_size_that_is_said(said: str, size: tuple[int, int, int]) -> None:
    assert shader(f"kernel K {{ {said}  result r : float[4] = 1 }}").work_group == size


def test_the_nearest_size_of_work_groups_counts() -> None:
    text = """
    abstract kernel Base { work_group of 32  result r : float[4] = 1 }
    mixin Large for kernel { work_group of 128 }
    kernel K : Base + Large { }
    """
    assert shader(text).work_group == (128, 1, 1)


def test_every_profile_takes_work_groups_of_the_usual_size() -> None:
    assert all(count <= Limits().work_group for count in map(invocations, USUAL.values()))
