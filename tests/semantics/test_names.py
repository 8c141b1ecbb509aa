"""The declarations that names mean: hygiene of libraries, constants, imports."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.reference.namespace import Lanes

from .kit import Painted, color, lanes, number

Files = Callable[..., Path]


@pytest.fixture
def files(tmp_path: Path) -> Files:
    """Writes files, the last one being the one to compile."""

    def write(**texts: str) -> Path:
        for name, text in texts.items():
            path = tmp_path / f"{name.replace('__', '/')}.burnish"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return path

    return write


LIGHTS = "import std.lights\nimport std.terms\nrig R { sun : Directional  lamp : Spot[2] }\n"
SHADED = "color = ambient(#804020) + lambert(#804020) + phong(vec3(1), 8) + blinn_phong(vec3(1), 4)"
LAMP: Lanes = ((1.0,) * 3, (1.0,) * 3, (0.0, 2.0, 3.0), (0.0, 0.0, -1.0), (0.2,), (0.4,))
GIVEN: dict[str, Lanes] = {
    "lamp": (LAMP, LAMP),
    "sun.direction": (0.0, -0.6, -0.8),
}


def shaded(members: str, head: str = "") -> Lanes:
    return color(f"{LIGHTS}{head}\nmaterial M {{ {members}\n{SHADED} }}", GIVEN)


@pytest.mark.parametrize(
    "members",
    [
        "pi = 0.0  reflect = 0.0  dot = 1.0  saturate = 2.0  normalize = 3.0",
        "k = 0.0  power = 0.0  surface = 0.0  to_light = vec3(0)  turn = 1.0",
        "light = vec3(0)  falloff = 0.0  diffuse = vec3(0)  specular = vec3(0)",
        "direction = vec3(0)  place = vec3(0)  inner = 1.0  outer = 1.0  axis = vec3(1)",
        "lambert = vec3(0)  phong = vec3(0)  ambient = vec3(0)  mirrored = vec3(0)",
        "map pow : texture2d  map max : texture2d  map smoothstep : texture2d",
        "param cos : float = 0  param lit : float = 0  map reflect : texture2d",
        "sun = vec3(0)  lamp = vec3(0)  i = 7  vec3 = 0.0",
        "map normalize : texture2d  map nonzero : texture2d",
    ],
)
def test_slots_of_a_material_do_not_change_the_library(members: str) -> None:
    assert shaded(members) == shaded("")


@pytest.mark.parametrize(
    "head",
    [
        "fn dot(a: vec3, b: vec3) = 0.0\nfn saturate(x: float) = 0.0",
        "fn reflect(a: vec3, b: vec3) = a\nfn mirrored(a: vec3, b: float) = 0.0",
        "fn cos(x: float) = 0.0\nfn smoothstep(a: float, b: float, c: float) = 0.0",
        "normal = vec3(0)\nposition = vec3(0)\nto_eye = vec3(0)\nambient_light = vec3(0)\npi = 3",
        "struct Light { x : float }\nspace world",
    ],
)
def test_declarations_of_a_file_do_not_change_the_library(head: str) -> None:
    assert shaded("", head) == shaded("")


def test_the_nearest_declaration_counts() -> None:
    head = "k = 1.0\npi = 2.0\nfn of(k: float) = k * 10\nfn file() = k"
    assert number("k", "k = 3.0", head) == 3
    assert number("file()", "k = 3.0", head) == 1
    assert number("of(5)", "k = 3.0", head) == 50
    assert number("sum k in 0..3 : k", "k = 3.0", head) == 3
    assert number("pi", "", head) == 2
    assert number("pi") == pytest.approx(3.14159265)


def test_a_term_reads_its_file_before_the_surface() -> None:
    head = "gloss = 5.0\nterm mine() = vec3(gloss, alpha, uv.x)"
    assert lanes("mine()", "gloss = 7.0  alpha = 0.5", head) == (5, 0.5, 0.25)


def test_a_texture_of_the_record_is_read_before_a_function_is_called() -> None:
    red: Lanes = (Painted(lambda _u, _v: (1, 0, 0, 1)),)
    assert lanes("sin(uv).rgb", "map sin : texture2d", sin=red) == (1, 0, 0)


def test_words_of_the_grammar_are_names() -> None:
    members = "light = 1.0  map = 2.0  per = 3.0  param param : float = 4  target = 5.0  in = 6.0"
    assert number("light + map + per + param + target + in", members) == 21
    assert number("sum", "sum = 1.5") == 1.5


CONSTANTS: dict[str, float] = {
    "third": 6,
    "wide.y": 0.5,
    "turn": 3.14159265,
    "table(1)": 20,
    "whole + uv.x": 3.25,
}


@pytest.mark.parametrize(("text", "expected"), CONSTANTS.items(), ids=CONSTANTS)
def test_constants_of_a_file(text: str, expected: float) -> None:
    head = """
        third = second * first
        second = first + 1
        first = 2
        wide : vec2 = 0.5
        turn : angle = 180deg
        whole : float = 3
        fn table(i: int) = float(10 * i * first)
    """
    assert number(text, "", head) == pytest.approx(expected)


# --- imports -------------------------------------------------------------------------------------


def test_forms_of_imports(files: Files) -> None:
    main = files(
        beside="a = 1.0\nb = 2.0",
        folder__deep='c = 10.0\nimport "near.burnish"\nd = e * 2',
        folder__near="e = 50.0",
        main="""
            import "beside.burnish".{a}
            import folder.deep
            import std.transforms.{scaling}
            material M { color = vec3(a, c + d, scaling(vec3(7))[1].y) }
        """,
    )
    assert color(main) == (1, 110, 7)


def test_only_what_is_asked_for_is_imported(files: Files) -> None:
    main = files(
        beside="a = 1.0\nb = 2.0",
        main='import "beside.burnish".{a}\nmaterial M { color = vec3(b) }',
    )
    with pytest.raises(CompileError, match="unknown name `b`"):
        color(main)


def test_what_a_file_imports_it_does_not_hand_on(files: Files) -> None:
    main = files(
        far="a = 1.0",
        near='import "far.burnish"\nb = a',
        main='import "near.burnish"\nmaterial M { color = vec3(a) }',
    )
    with pytest.raises(CompileError, match="unknown name `a`"):
        color(main)


TWO = {"left": "a = 1.0\nb = 2.0", "right": "a = 10.0\nc = 30.0"}
BOTH = 'import "left.burnish"\nimport "right.burnish"\n'
CHOICES: dict[str, Lanes] = {
    BOTH + "material M { color = vec3(b, c, 0) }": (2, 30, 0),
    BOTH + "material M { a = 7.0  color = vec3(a) }": (7, 7, 7),
    BOTH + "a = 5.0\nmaterial M { color = vec3(a) }": (5, 5, 5),
    BOTH + 'import "right.burnish".{a}\nmaterial M { color = vec3(a) }': (10, 10, 10),
    'import "left.burnish".{a}\n' + BOTH + "material M { color = vec3(a) }": (1, 1, 1),
    BOTH + 'import "left.burnish"\nmaterial M { color = vec3(b) }': (2, 2, 2),
}


@pytest.mark.parametrize(("text", "expected"), CHOICES.items(), ids=range(len(CHOICES)))
def test_names_of_several_files(files: Files, text: str, expected: Lanes) -> None:
    assert color(files(**TWO, main=text)) == expected


def test_a_name_of_several_files_is_doubtful_where_it_is_used(files: Files) -> None:
    with pytest.raises(CompileError, match="`a` is imported from several files"):
        color(files(**TWO, main=BOTH + "material M { color = vec3(a) }"))


def test_a_base_of_another_file_keeps_its_own_names(files: Files) -> None:
    main = files(
        base="k = 2.0\nfn f(x: float) = x * k\n"
        "abstract material Base { level : float  color = vec3(f(level)) }",
        main='import "base.burnish".{Base}\nk = 100.0\nfn f(x: float) = 0.0\n'
        "material M : Base { level = k }",
    )
    assert color(main) == (200, 200, 200)


BASE = """
shade = 0.25
fn paint(p: vec2) -> vec4 = vec4(0.5)
abstract material Base {
    tone = shade
    coat = paint(uv).x
}
"""


def test_names_of_a_derived_material_do_not_change_its_base() -> None:
    """A base's text means what it meant before somebody derived from it."""
    derived = "shade = 1.0  map paint : texture2d"
    text = BASE + f"material M : Base {{ {derived}  color = vec3(tone, coat, shade) }}"
    assert color(text) == (0.25, 0.5, 1.0)


def test_what_a_mixin_needs_is_found_in_the_material() -> None:
    text = "mixin Tinted { color = vec3(tint) }\nmaterial M : Surface + Tinted { tint = 0.5 }"
    assert color(text) == (0.5, 0.5, 0.5)
