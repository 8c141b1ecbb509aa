"""Sources that ask for very much end in a sentence, and take little memory and time until then.

Each command runs in a process of its own, whose memory is measured, with that of all that it has
started.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from ..suite.processes import run

MOST = 10**6
"""Kibibytes that a command may have in memory at the same time, as each of its children."""
SECONDS = 60.0
"""The time in seconds after which a command counts as hanging. It takes a few seconds."""
MEASURED = """
import resource
from pathlib import Path
from burnish.commands.cli import main
try:
    main()
finally:
    from burnish.tests.suite.memory import most_memory
    children = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    Path("peak").write_text(str(max(most_memory() // 1024, children)))
"""
"""Runs a command, and writes down the peak of it and of its children."""

FRAME = """import std.frames.{FullScreen}
pass P : FullScreen {
    map below : texture2d = white
    target color : rgba32f = 0.5 * below.load(ivec2(0, 0))
}
"""
LARGE_STEP = (
    FRAME
    + """frame F {
    a = P(screen, 12000)
    b = P(screen, 4) with { below = a.color }
    output o = b.color
}
"""
)
LARGE_OUTPUT = FRAME + "frame F { a = P(screen, 4096)  output o = a.color }"
MOVING = FRAME + "frame F { a = P(screen, 1024)  output o = a.color }"
DEEP = """
struct A { a : float[1000] }
struct B { b : A[250] }
struct C { c : B[1000] }
material M { param p : C  color = vec3(p.c[1].b[2].a[3]) }
"""
LOOPS = """
fn inner(x: float) -> float = sum i in 0..4096 : (sum j in 0..4096 : sin(x * float(i * j)))
material M { color = vec3(sum k in 0..4096 : inner(uv.x + float(k))) }
"""
IMAGE = """kernel K {
    result r : image2d<rgba8>[ivec2(16384, 16000)] = vec4(float(texel.x) / 16384)
}
"""


@dataclass(frozen=True)
class Hostile:
    """A source, and what is to be done with it."""

    source: str
    command: str
    """All words behind ``burnish``; the file is ``m.burnish``."""
    told: str
    """The beginning of the error, or its text behind the name of a material."""


RENDER = "render m.burnish -o m.png --size 16"
CONFORM = "conform m.burnish --routes lavapipe:glsl"
CASES = {
    "a large step": Hostile(
        LARGE_STEP, RENDER, "the frame `F` needs "
    ),
    "a large step by a route": Hostile(
        LARGE_STEP, f"{RENDER} --on lavapipe:glsl",
        "the frame `F` needs ",
    ),
    "a large output by a route": Hostile(
        LARGE_OUTPUT, f"{RENDER} --on lavapipe:glsl",
        "the frame `F` needs ",
    ),
    "a large step that is compared": Hostile(
        LARGE_STEP, CONFORM, "the frame `F` needs "
    ),
    "thousands of large pictures": Hostile(
        MOVING, f"{RENDER} --frames 10000", "10000 pictures need 83.9 GB, and "
    ),
    "thousands of large pictures by a route": Hostile(
        MOVING, f"{RENDER} --frames 10000 --on lavapipe:glsl",
        "10000 pictures of the frame `F` need 839 GB, and ",
    ),
    "a deep type": Hostile(
        DEEP, RENDER, "a value of type `B[1000]` has 250,000,000 numbers, and 262,144 are possible"
    ),
    "loops in loops": Hostile(LOOPS, RENDER, "`M` takes "),
    "loops in loops by a route": Hostile(LOOPS, f"{RENDER} --on lavapipe:glsl", "`M` takes "),
    "loops in loops that are compared": Hostile(LOOPS, CONFORM, "`M` takes "),
    "a large image": Hostile(IMAGE, CONFORM, "the buffers and textures of K take "),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_it_is_refused_at_once(case: str, tmp_path: Path) -> None:
    hostile = CASES[case]
    (tmp_path / "m.burnish").write_text(hostile.source)
    command = [sys.executable, "-c", MEASURED, *hostile.command.split()]
    done = run(command, cwd=tmp_path, limit=SECONDS)
    assert done.returncode == 1, done
    assert hostile.told in done.stderr
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "m.png").exists()
    assert int((tmp_path / "peak").read_text()) < MOST


def test_one_that_is_refused_does_not_keep_others_from_being_compared(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(LOOPS + "material Up { color = 0.5 + 0.5 * normal }")
    done = run([sys.executable, "-m", "burnish", *CONFORM.split()], cwd=tmp_path, limit=SECONDS)
    assert done.returncode == 1
    assert done.stdout.splitlines()[-1] == "1 agrees, 1 failed"
    assert done.stderr.splitlines()[0].endswith("m.burnish: M, lavapipe:glsl: failed")


def test_many_pictures_are_kept_as_images(tmp_path: Path) -> None:
    """Pictures are kept with 8 bits; the reference's numbers would take 32 times as much memory."""
    (tmp_path / "m.burnish").write_text(MOVING.replace("1024", "512"))
    words = ["render", "m.burnish", "-o", "m.gif", "--size", "16", "--frames", "24"]
    done = run([sys.executable, "-c", MEASURED, *words], cwd=tmp_path, limit=SECONDS)
    assert done.returncode == 0, done
    assert int((tmp_path / "peak").read_text()) < MOST / 3
