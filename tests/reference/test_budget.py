"""The needs of a source are counted before the reference allocates or computes anything."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import pytest
from PIL import Image

import burnish
from burnish.compiler.budget import LIMITS, BudgetError, raised
from burnish.compiler.ir.shader import Shader
from burnish.compiler.reference import kernel
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.cost import check_operations, operations
from burnish.compiler.reference.kernel import computed
from burnish.compiler.reference.picture import PIXELS_AT_ONCE, RasterRules

from ..cli.kit import invoke

FRAME = """import std.frames.{{FullScreen}}
pass P : FullScreen {{
    map s : texture2d = white
    target color : rgba32f = s.load(ivec2(0, 0))
}}
frame F {{ {steps} output o = a{last}.color }}
"""
KERNEL = """kernel K {{
    param n : int in 0..2147483647 = {count}
    result a : {type}[n] = {value}
}}
"""
LOOP = """kernel K {{
    param n : int in 0..{bound} = {bound}
    result a : float[1000] = sum i in 0..n : (sum j in 0..n : sin(float(i * j + index)))
}}
"""


def _frame(count: int, size: int) -> str:
    steps = [f"a0 = P(screen, {size})"]
    steps += [f"a{n} = P(screen, {size}) with {{ s = a{n - 1}.color }}" for n in range(1, count)]
    return FRAME.format(steps="\n".join(steps), last=count - 1)


REFUSED = {
    "a frame with large textures": (
        _frame(3, 8192), "the frame `F` needs ", "--budget memory="
    ),
    "a step of a large picture": (_frame(8, 1536), "the step `a0` needs ", "--budget memory="),
    "a kernel with many elements": (
        KERNEL.format(count=300_000_000, type="float", value="1.0"),
        "what `K` writes needs 30 GB", "--budget memory=30G",
    ),
    "a kernel with large elements": (
        KERNEL.format(count=20_000_000, type="mat4", value="mat4(1)"),
        "what `K` writes needs 32 GB", "--budget memory=32G",
    ),
}  # fmt: skip
READER = "material M {{ buffer a : {type}[] per draw  color = vec3(float(a.count)) }}\n"


@pytest.mark.parametrize("case", REFUSED)
def test_what_needs_too_much_memory_is_refused(case: str, tmp_path: Path) -> None:
    source, told, way_out = REFUSED[case]
    if "kernel" in source:
        source += READER.format(type="mat4" if "mat4" in source else "float")
    file = tmp_path / "m.burnish"
    file.write_text(source)
    tracemalloc.start()
    result = invoke("render", file, "-o", tmp_path / "m.png", "--size", 16)
    _now, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert result.exit_code == 1
    assert result.stderr.startswith(f"error: {told}")
    assert f"`{way_out}" in result.stderr
    assert most < 300e6
    assert not (tmp_path / "m.png").exists()


def test_the_option_lets_it_pass(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(_frame(2, 64))
    output = tmp_path / "m.png"
    with raised({"memory": 1000}):
        assert invoke("render", file, "-o", output, "--size", 16).exit_code == 1
        allowed = invoke("render", file, "-o", output, "--size", 16, "--budget", "memory=1G")
    assert (allowed.exit_code, allowed.stderr) == (0, "")


def test_textures_that_the_reference_reads_are_counted(tmp_path: Path) -> None:
    """The reference keeps numbers for a picture's bytes, and four lanes for its only channel."""
    file, picture = tmp_path / "m.burnish", tmp_path / "a.png"
    Image.new("L", (2048, 2048)).save(picture)
    file.write_text("material M {{ {maps} color = {reads} }}".format(
        maps=" ".join(f"map t{n} : texture2d" for n in range(3)),
        reads=" + ".join(f"t{n}(uv).rgb" for n in range(3)),
    ))  # fmt: skip
    words = [f"--set=t{n}={picture}" for n in range(3)]
    result = invoke("render", file, "-o", tmp_path / "m.png", "--size", 16, *words)
    assert result.exit_code == 1
    assert result.stderr == (
        "error: what the reference reads of textures takes 1.68 GB, and the limit is 1 GB: "
        "`--budget memory=1678M` raises it\n"
    )


# --- loops ---------------------------------------------------------------------------------------


def _shader(source: str) -> Shader:
    return burnish.compile(source, ())["K"].shader


def _computed(shader: Shader, turns: int, errors: Errors | None) -> None:
    computed(shader, {"n": (turns,)}, {}, 1000, {"a": 1000}, errors, RasterRules(1, 1))


def test_loops_that_nobody_waits_for_are_refused() -> None:
    with pytest.raises(BudgetError) as told:
        _computed(_shader(LOOP.format(bound=1024)), 1024, None)
    assert str(told.value).startswith("`K` takes ")
    assert "operations, and the limit is 10,000,000,000 operations" in str(told.value)


FORMED = """kernel K {{
    param n : int in 0..{bound} = {bound}
    result a : float[1000] = sum i in 0..n :
        (iterate x from float(index) / 300 for j in 0..2 : sin(x) + float(i) / 7)
}}
"""
"""Each turn adds a state that has errors of its own, which later turns share."""


@pytest.mark.parametrize("errors", [None, Errors(("vulkan",))])
@pytest.mark.parametrize(
    ("loop", "few", "many"), [(LOOP, 4, 16), (FORMED, 60, 240)], ids=["sums", "forms"]
)
def test_memory_does_not_grow_with_the_turns_of_a_loop(
    loop: str, few: int, many: int, errors: Errors | None
) -> None:
    shader = _shader(loop.format(bound=256))
    peaks = []
    for turns in (few, many):
        tracemalloc.start()
        _computed(shader, turns, errors)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.2 * peaks[0] + 100_000


@pytest.mark.parametrize(
    ("value", "count"),
    [
        ("1.0", 1),
        ("float(n) * 2 + 1", 14),
        ("sum i in 0..10 : float(i * i)", 90),
        ("sum i in 0..10 : (sum j in 0..10 : float(i * j))", 900),
        ("sum i in 0..10 : sin(cos(sqrt(float(n) * 2)))", 50),
        ("sum i in 0..10 : determinant(mat4(float(i)))", 530),
        ("sum i in 0..10 : inverse(mat4(float(i)))[1].x", 1700),
    ],
)
def test_a_loop_counts_as_often_as_its_body_is_computed(value: str, count: int) -> None:
    """Values that do not depend on the loop's variable count once.

    There are a few nodes around the loop. Matrices count as often as they have numbers, or more
    often.
    """
    text = "kernel K {{\n param n : int in 0..9 = 1\n result a : float[8] = {}\n}}"
    shader = _shader(text.format(value))
    found = operations([result.value for result in shader.results])
    assert count <= found <= 3 * count + 20


def test_a_read_of_a_texture_counts_as_a_hundred_operations() -> None:
    text = "material M {{ map t : texture2d\n color = sum i in 0..10 : t({}).rgb }}"
    found = []
    for place in ("uv * float(i)", "uv * float(i) + t(uv * float(i)).xy"):
        shader = burnish.compile(text.format(place), ())["M"].shader
        found.append(operations([result.value for result in shader.results]))
    assert 1000 <= found[0] <= 2000
    assert 1000 <= found[1] - found[0] <= 1300


# --- parts ---------------------------------------------------------------------------------------

KERNELS = {
    "elements": "kernel K { result a : float[1000] = sin(float(index)) / 3 }",
    "groups": "kernel K { result a : float[1000] = group_sum(float(index)) + float(index) }",
    "scattered": """kernel K {
        runs over 1000
        scatter a : uint[16] add uint(index) at index & 15
    }""",
}


@pytest.fixture(params=KERNELS)
def kernel_shader(request: pytest.FixtureRequest) -> Shader:
    return _shader(KERNELS[request.param])


@pytest.mark.parametrize("errors", [None, Errors(("vulkan",))])
def test_parts_are_computed_as_the_whole(
    kernel_shader: Shader, errors: Errors | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = []
    for at_once in (1 << 15, 100):
        monkeypatch.setattr(kernel, "_AT_ONCE", at_once)
        lanes = computed(kernel_shader, {}, {}, 1000, {"a": 16}, errors, RasterRules(1, 1))
        found.append([
            [each.tolist() for each in (lane.value, lane.low, lane.high, lane.undecided)]
            for lane in lanes
        ])  # fmt: skip
    assert found[0] == found[1]


def test_examples_need_far_less_than_the_limit() -> None:
    """The most expensive one is a parallax, for as many pixels as are shaded at once."""
    folder = Path(__file__).parents[2] / "examples"
    for name in ("clouds", "plastic", "ray_tracer"):
        for material in burnish.compile(folder / f"{name}.burnish", ()).materials:
            taken = operations([result.value for result in material.shader.results])
            assert taken * (1 << 14) < LIMITS["operations"].most / 10


def test_an_example_with_thousands_of_lights_is_computed() -> None:
    """Few reach each place, but a loop counts as often as its bound says."""
    file = Path(__file__).parents[2] / "examples" / "street.burnish"
    for material in burnish.compile(file, ()).materials:
        roots = [result.value for result in material.shader.results]
        check_operations(roots, PIXELS_AT_ONCE, material.name)
