"""Functions mean what whole shaders do: drawn by a driver, judged by the bounds of their slots.

``called_shaders.py`` is the engine. ``python -m burnish.tests.functions.test_meaning`` draws all
examples, and with ``--random 100`` so many random programs; here are some of both.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain

from ..engines.files import materials
from ..fuzz.oracles import ALLOWED
from ..fuzz.programs import program
from .called_shaders import PROFILE, Called, broken, subjects

ROUTE = ROUTES["lavapipe:wgsl-naga"]
SIZE = (25, 19)
DRAWN = ("plastic", "water", "normal_map", "morphing", "gltf_material", "confetti", "metal_rough")
MOVED = """
import std.motion.{MeshPoint}
import std.tangents.{Bumped, Tangents}
material Bent : Surface + Tangents {
    param lean : float in 0..1 = 0.4
    rest = inherited.object_shape
    turned = vec3(0, lean, 0)
    object_shape = MeshPoint(
        rest.position + vec3(lean * rest.position.y, 0, 0), rest.normal + turned,
        rest.tangent - turned, rest.handedness, rest.motion
    )
    shown = normal
    along = tangent
    place = position
}
material Pushed {
    object_position = vertex_position + 0.1 * vertex_normal
    object_normal = vertex_normal + vec3(vertex_position).yzx
    object_tangent = vec3(0)
    shown = normal
    rest = vec3(object_position)
}
material Swept {
    rest = inherited.position
    position = @vertex (rest + vec3(0, 0.3 * rest.x * rest.x, 0))
    glancing = dot(normal, to_eye)
    heat : float = @vertex (vertex_position.x * vertex_uv.y)
    warm = heat * 2 + rest.y
}
material Lifted {
    position = inherited.position + vec3(0, 0.2, 0)
    glancing = dot(normal, to_eye)
    front = front_facing and uv.x < 0.7
}
"""


def rows(found: Sequence[tuple[str, Called]]) -> list[Row]:
    """What a driver draws, judged; nothing is kept from one run to the next."""
    with Runner([ROUTE], parallel=1, reuse=False) as runner, Toolchain(parallel=1) as toolchain:
        return conform(found, [ROUTE], runner, toolchain, size=SIZE, keep=False, brief=True)


def wrong(found: Sequence[Row]) -> list[str]:
    """What is out of bounds, or was not drawn."""
    return [
        "\n".join([f"{row.material}: {row.status}: {row.problem}", *details(row)])
        for row in found
        if row.status in ("differs", "failed")
    ]


def of_examples(names: Sequence[str]) -> Iterator[tuple[str, Called]]:
    """The subjects of examples, by ``file.material``; some have no functions."""
    for file, name in materials(names):
        text = file.read_text(encoding="utf-8")
        try:
            for label, subject in subjects(text, name, file.parent):
                yield f"{file.stem}.{label}", subject
        except CompileError as error:
            print(f"{file.stem}.{name}: not drawn: {str(error).splitlines()[0]}")


def is_refused(text: str) -> bool:
    """True if the whole program does not compile either."""
    try:
        burnish.compile(text, PROFILE)
    except CompileError:
        return True
    return False


def of_random(numbers: Iterable[int]) -> Iterator[tuple[str, Called]]:
    """The subjects of random programs; those that make vertices of their own have none."""
    for number in numbers:
        text = str(program(f"functions:{number}"))
        try:
            names = [each.name for each in burnish.functions(text, PROFILE)]
        except CompileError as error:
            codes = {found.rule.code for found in error.diagnostics if found.severity == "error"}
            assert codes <= {"B0904", "B0905", "B0906", "B0701"} | ALLOWED or is_refused(text), text
            names = []
        for name in names:
            for label, subject in subjects(text, name, Path()):
                yield f"{number}.{label}", subject


def test_functions_of_random_programs_are_inside_the_bounds() -> None:
    found = list(of_random(range(14)))
    assert len(found) > 5
    drawn = rows(found)
    assert not wrong(drawn)
    assert sum(row.status == "agrees" for row in drawn) > len(found) / 2


def test_functions_are_inside_the_bounds_of_slots(tmp_path: Path) -> None:
    names = ("Bent", "Pushed", "Swept", "Lifted")
    moved = [each for name in names for each in subjects(MOVED, name, tmp_path)]
    assert len(moved) == len(names)
    found = [*moved, *of_examples(DRAWN)]
    drawn = rows([*found, *((f"broken {label}", broken(each)) for label, each in moved)])
    assert not wrong(drawn[: len(found)])
    assert [row.status for row in drawn[len(found) :]] == ["differs"] * len(moved)


def main(arguments: Sequence[str]) -> int:
    """Print the rows, and what is wrong; returns the process's exit code."""
    is_random = arguments[:1] == ["--random"]
    found = of_random(range(int(arguments[1]))) if is_random else of_examples(arguments)
    told = rows(list(found))
    for row in told:
        print(f"{row.material}: {row.status}")
    print("\n".join(wrong(told)))
    return 1 if wrong(told) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
