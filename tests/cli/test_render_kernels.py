"""``burnish render`` of files with kernels: materials are drawn with what the kernels write."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from .kit import invoke
from .test_render import draw, middle

TEXT = """\
kernel Begin {
    runs over 3
    result heights : float[3] = 0.25 * float(index + 1)
}

kernel Step {
    param growth : float = 2
    buffer heights : float[]
    result next : float[heights.count] = growth * heights[index]
}

material Bar {
    buffer next : float[]
    color = vec3(next[0], next[1], if next.count == 3 then 0 else 1)
}
"""


def linear(picture: tuple[int, ...]) -> list[float]:
    """The linear light of a colour of a picture."""
    shares = [value / 255 for value in picture]
    return [round(s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4, 2) for s in shares]


def test_a_buffer_has_what_a_kernel_writes(tmp_path: Path) -> None:
    assert linear(middle(draw(TEXT, tmp_path))) == [0.5, 1, 0]


def test_values_of_kernels_are_set_too(tmp_path: Path) -> None:
    assert linear(middle(draw(TEXT, tmp_path, "--set", "growth=1"))) == [0.25, 0.5, 0]


def test_a_named_material_finds_the_kernels(tmp_path: Path) -> None:
    assert linear(middle(draw(TEXT, tmp_path, "--material", "Bar"))) == [0.5, 1, 0]


def test_steps(tmp_path: Path) -> None:
    """0.25 and 0.5, halved three times."""
    options = ("--set", "growth=0.5", "--steps", 3, "--again", "heights=next")
    assert linear(middle(draw(TEXT, tmp_path, *options))) == [0.03, 0.06, 0]


def test_routes_draw_the_same(tmp_path: Path) -> None:
    expected = draw(TEXT, tmp_path)
    assert (draw(TEXT, tmp_path, "--on", "lavapipe:glsl") == expected).all()


def test_two_of_a_state_change_places(tmp_path: Path) -> None:
    """Verlet integration: what was now is before in the next step, from the same moment."""
    text = """\
kernel Begin {
    runs over 1
    result now    : float[1] = 0.5
    result before : float[1] = 0.25
}
kernel Step {
    buffer now    : float[]
    buffer before : float[]
    result after : float[1] = 2 * now[0] - before[0]
}
material Bar {
    buffer after  : float[]
    buffer before : float[]
    color = vec3(after[0], before[0], 0)
}
"""
    options = ("--steps", 2, "--again", "before=now", "--again", "now=after")
    assert linear(middle(draw(text, tmp_path, *options))) == [1, 0.5, 0]


def test_elements_of_a_file(tmp_path: Path) -> None:
    (tmp_path / "e.json").write_text(json.dumps([0.5, 0.25, 1]))
    text = "material Bar { buffer next : float[] color = vec3(next[0], next[1], next[2]) }"
    found = draw(text, tmp_path, "--set", f"next={tmp_path / 'e.json'}")
    assert linear(middle(found)) == [0.5, 0.25, 1]


def test_elements_that_nobody_sets(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material Bar { buffer next : float[] color = vec3(next[0]) }")
    result = invoke("render", file, "-o", tmp_path / "m.png", "--size", 4)
    assert (result.exit_code, result.stderr) == (
        0, "note: `next` of Bar has no elements: a kernel with `result next : …` in the same file "
        "makes some, or --set next=FILE.json\n",
    )  # fmt: skip


def of(*parts: str) -> str:
    return "\n".join(parts)


WRITER = "kernel A { runs over 1 result next : float[1] = 1 }"
READER = "material Bar { buffer next : float[] color = vec3(next[0]) }"
WRONG = {
    "no material": (
        WRITER, (),
        "A is a kernel over buffers, which draws nothing\n  = help: a material in the same file "
        "that reads `buffer next : float[]` is drawn with what A writes\n",
    ),
    "two that write the same": (
        of(WRITER, WRITER.replace("A", "B"), READER), (), "A and B both write `next`\n",
    ),
    "another type": (
        of(WRITER.replace("float[1] = 1", "vec2[1] = vec2(1)"), READER), (),
        "`next` of Bar is float[], and A writes vec2[]\n",
    ),
    "a circle": (
        of("kernel A { buffer other : float[] result next : float[1] = other[0] }",
           "kernel B { buffer next : float[] result other : float[1] = next[0] }", READER), (),
        "kernels wait for each other's results: A → B → A\n",
    ),
    "again, of nothing": (
        of(WRITER, READER), ("--again", "nexd=next"), "no kernel writes `nexd`; there are `next`\n",
    ),
    "again, of another type": (
        of(WRITER, "kernel B { runs over 1 result other : vec2[1] = vec2(1) }", READER),
        ("--again", "next=other"),
        "`next` is float[], and cannot become `other`, which is vec2[]\n",
    ),
    "no file": (READER, ("--set", "next=no.json"),
                "cannot read `no.json` for `next`: No such file or directory\n"),
    "no file but a device": (READER, ("--set", "next=/dev/zero"),
                             "cannot read `/dev/zero` for `next`: it is not a file\n"),
    "no JSON": (READER, ("--set", "next=m.burnish"),
                "cannot take `next` from `m.burnish`: it is no JSON: Expecting value: line 1 "
                "column 1 (char 0)\n"),
    "no list": (READER, ("--set", "next=object.json"),
                "cannot take `next` from `object.json`: it holds no list of elements\n"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_what_does_not_go_together(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text, options, message = WRONG[name]
    monkeypatch.chdir(tmp_path)
    Path("m.burnish").write_text(text)
    Path("object.json").write_text("{}")
    result = invoke("render", "m.burnish", "-o", "m.png", "--size", 4, *options)
    assert (result.exit_code, result.stderr) == (1, f"error: {message}")
    assert not Path("m.png").exists()


def test_the_elements_of_a_buffer_have_limits(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A file of holes takes no space, but a terabyte of memory; short texts make long lists."""
    monkeypatch.chdir(tmp_path)
    Path("m.burnish").write_text(READER)
    Path("many.json").write_text(f"[{'[],' * 7_000_000}1]")
    with Path("holes.json").open("wb") as holes:
        holes.truncate(10**12)
    said = {
        "holes.json": "`holes.json` for `next` has 1,000 GB, and the limit is 256 MB: "
        "`--budget file=1000G` raises it",
        "many.json": "the elements of `many.json` take 1.01 GB, and the limit is 1 GB: "
        "`--budget memory=1009M` raises it",
    }
    for name, message in said.items():
        result = invoke("render", "m.burnish", "-o", "m.png", "--size", 4, "--set", f"next={name}")
        assert (result.exit_code, result.stderr) == (1, f"error: {message}\n")
        assert not Path("m.png").exists()
