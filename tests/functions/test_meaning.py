"""Functions mean what whole shaders do: drawn by a driver, judged by the bounds of their slots.

``called_shaders.py`` is the engine. ``python -m burnish.tests.functions.test_meaning`` draws all
examples, and with ``--random 100`` so many random programs; here are some of both.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import pytest

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
from .called_languages import GLSL, LANGUAGES, WGSL, CallingLanguage
from .called_shaders import Called, broken, subjects

ROUTE_OF = {
    WGSL.profile: ROUTES["lavapipe:wgsl-naga"],
    GLSL.profile: ROUTES["lavapipe:glsl"],
}
"""The route that draws each language, by the profile."""
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


def rows(found: Sequence[tuple[str, Called]], language: CallingLanguage) -> list[Row]:
    """What a driver draws, judged; nothing is kept from one run to the next."""
    routes = [ROUTE_OF[language.profile]]
    with Runner(routes, parallel=1, reuse=False) as runner, Toolchain(parallel=1) as toolchain:
        return conform(found, routes, runner, toolchain, size=SIZE, keep=False, brief=True)


def wrong(found: Sequence[Row]) -> list[str]:
    """What is out of bounds, or was not drawn."""
    return [
        "\n".join([f"{row.material}: {row.status}: {row.problem}", *details(row)])
        for row in found
        if row.status in ("differs", "failed")
    ]


def of_examples(names: Sequence[str], language: CallingLanguage) -> Iterator[tuple[str, Called]]:
    """The subjects of examples, by ``file.material``; some have no functions."""
    for file, name in materials(names):
        text = file.read_text(encoding="utf-8")
        try:
            for label, subject in subjects(text, name, file.parent, language=language):
                yield f"{file.stem}.{label}", subject
        except CompileError as error:
            print(f"{file.stem}.{name}: not drawn: {str(error).splitlines()[0]}")


def is_refused(text: str) -> bool:
    """True if the whole program does not compile either."""
    try:
        burnish.compile(text, WGSL.profile)
    except CompileError:
        return True
    return False


def of_random(numbers: Iterable[int], language: CallingLanguage) -> Iterator[tuple[str, Called]]:
    """The subjects of random programs; those that make vertices of their own have none."""
    for number in numbers:
        text = str(program(f"functions:{number}"))
        try:
            names = [each.name for each in burnish.functions(text, language.profile)]
        except CompileError as error:
            codes = {found.rule.code for found in error.diagnostics if found.severity == "error"}
            assert codes <= {"B0904", "B0905", "B0906", "B0701"} | ALLOWED or is_refused(text), text
            names = []
        for name in names:
            for label, subject in subjects(text, name, Path(), language=language):
                yield f"{number}.{label}", subject


RANDOM = {WGSL.profile: range(14), GLSL.profile: range(14, 28)}
"""The random programs that are drawn: others in each language."""


@pytest.mark.parametrize("profile", LANGUAGES)
def test_functions_of_random_programs_are_inside_the_bounds(profile: str) -> None:
    found = list(of_random(RANDOM[profile], LANGUAGES[profile]))
    assert len(found) > 5
    drawn = rows(found, LANGUAGES[profile])
    assert not wrong(drawn)
    assert sum(row.status == "agrees" for row in drawn) > len(found) / 2


@pytest.mark.parametrize("profile", LANGUAGES)
def test_functions_are_inside_the_bounds_of_slots(profile: str, tmp_path: Path) -> None:
    language = LANGUAGES[profile]
    names = ("Bent", "Pushed", "Swept", "Lifted")
    moved = [each for name in names for each in subjects(MOVED, name, tmp_path, language=language)]
    assert len(moved) == len(names)
    found = [*moved, *of_examples(DRAWN, language)]
    mistaken = [(f"broken {label}", broken(each)) for label, each in moved]
    drawn = rows([*found, *mistaken], language)
    assert not wrong(drawn[: len(found)])
    assert [row.status for row in drawn[len(found) :]] == ["differs"] * len(moved)


def main(arguments: Sequence[str]) -> int:
    """Print the rows, and what is wrong; returns the process's exit code."""
    code = 0
    for language in LANGUAGES.values():
        if arguments[:1] == ["--random"]:
            found = of_random(range(int(arguments[1])), language)
        else:
            found = of_examples(arguments, language)
        told = rows(list(found), language)
        for row in told:
            print(f"{language.profile}: {row.material}: {row.status}")
        print("\n".join(wrong(told)))
        code |= bool(wrong(told))
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
